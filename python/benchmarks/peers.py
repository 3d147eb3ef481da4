"""One 3-RPR, every way a Python user has to put it together: time, and how many of its six modes each finds.

Run:  python benchmarks/peers.py          (needs scipy and sympy beside the package)

The roads: this package; numpy.roots on the same eliminant, which has to be had from somewhere first; scipy.optimize.fsolve on the three closures from 100 starts; sympy's
Groebner basis, then numeric roots. A pose counts as found where it closes to 1e-8 of the mechanism's size and no other found one is within 1e-6.
"""

from __future__ import annotations

import platform
import time
from collections.abc import Callable
from pathlib import Path
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

import assur

MODEL = Path(__file__).resolve().parents[2] / "examples" / "3-rpr.toml"
INPUTS = np.array([14.98, 15.38, 12.0])
#: Starts of fsolve, as many as a patient user tries.
STARTS = 100
#: A pose closes, relative to the size; two poses are one.
CLOSES, SAME = 1e-8, 1e-6
ROWS = 1_000_000

Poses = NDArray[np.float64]
T = TypeVar("T")


def main() -> None:
    robot = assur.Manipulator.from_file(MODEL)
    legs = robot.to_dict()["leg"]
    a = np.array([leg["base"]["at"] for leg in legs])
    b = np.array([leg["platform"]["at"] for leg in legs])
    size = float(np.abs(b).max())
    roads: list[tuple[str, Callable[[], Poses], int]] = [
        ("assur, forward", lambda: robot.forward(INPUTS).poses, 50),
        ("assur, forward with proofs", lambda: robot.certify(INPUTS).poses, 20),
        ("numpy.roots on that eliminant", lambda: by_roots(robot, a, b), 200),
        (f"scipy.optimize.fsolve, {STARTS} starts", lambda: by_fsolve(a, b), 3),
        ("sympy, Groebner basis", lambda: by_sympy(a, b), 1),
    ]
    print(f"{platform.processor() or platform.machine()}, Python {platform.python_version()}, numpy {np.__version__}\n")
    print("| road | modes found | of | time |\n|---|---|---|---|")
    for name, road, times in roads:
        best, found = measured(road, times)
        print(f"| {name} | {distinct(found, a, b, size)} | 6 | {shown(best)} |")
    assert distinct(robot.forward_batch(INPUTS[np.newaxis])[0], a, b, size) == 6
    rows = INPUTS * np.random.default_rng(1).uniform(0.9, 1.1, size=(ROWS, 3))
    best, batch = measured(lambda: robot.forward(rows), 3)
    print(f"\nforward on ({ROWS}, 3): {shown(best)}, {int(batch.counts.sum())} modes, {best / ROWS * 1e9:.0f} ns a row")


def measured(road: Callable[[], T], times: int) -> tuple[float, T]:
    best, found = np.inf, road()
    for _ in range(times):
        start = time.perf_counter()
        found = road()
        best = min(best, time.perf_counter() - start)
    return best, found


def closures(pose: Poses, a: Poses, b: Poses) -> Poses:
    x, y, phi = pose
    turn = np.array([[np.cos(phi), -np.sin(phi)], [np.sin(phi), np.cos(phi)]])
    legs = np.array([x, y]) + b @ turn.T - a
    return np.asarray(np.hypot(legs[:, 0], legs[:, 1]) - INPUTS)


def distinct(poses: Poses, a: Poses, b: Poses, size: float) -> int:
    kept: list[Poses] = []
    for pose in poses:
        closes = np.abs(closures(pose, a, b)).max() < CLOSES * size
        if closes and all(np.abs(np.exp(1j * (pose[2] - other[2])) - 1) + np.abs(pose[:2] - other[:2]).max() / size > SAME for other in kept):
            kept.append(pose)
    return len(kept)


def lifted(phi: float, a: Poses, b: Poses) -> Poses:
    """The position for an orientation: the two differences of the closures are linear in it."""
    turn = np.array([[np.cos(phi), -np.sin(phi)], [np.sin(phi), np.cos(phi)]])
    c = b @ turn.T - a
    matrix = 2 * (c[1:] - c[0])
    right = (INPUTS[1:] ** 2 - (c[1:] ** 2).sum(axis=1)) - (INPUTS[0] ** 2 - (c[0] ** 2).sum())
    return np.array([*np.linalg.solve(matrix, right), phi])


def by_roots(robot: assur.Manipulator, a: Poses, b: Poses, *, cache: dict[str, Poses] = {}) -> Poses:
    # The eliminant is given to it; what it costs to have one is not in the time.
    if "coefficients" not in cache:
        polynomial = robot.forward(INPUTS).polynomial
        assert polynomial is not None
        cache["coefficients"] = polynomial.coefficients
    roots = np.roots(cache["coefficients"][::-1])
    return np.array([lifted(float(np.angle(root)), a, b) for root in roots if abs(abs(root) - 1) < 1e-6])


def by_fsolve(a: Poses, b: Poses) -> Poses:
    from scipy.optimize import fsolve

    rng = np.random.default_rng(0)
    starts = rng.uniform([-20, -20, -np.pi], [20, 20, np.pi], size=(STARTS, 3))
    found = [fsolve(closures, start, args=(a, b), full_output=True) for start in starts]
    return np.array([x for x, _, code, _ in found if code == 1]).reshape(-1, 3)


def by_sympy(a: Poses, b: Poses) -> Poses:
    import sympy
    from sympy.core.cache import clear_cache

    clear_cache()  # or the second run only remembers the first
    x, y, c, s = sympy.symbols("x y c s")
    exact = [[sympy.Rational(float(value)).limit_denominator(10**4) for value in row] for row in np.hstack([a, b])]
    lengths = [sympy.Rational(str(value)) for value in INPUTS]
    equations = [
        (x + c * bx - s * by - ax) ** 2 + (y + s * bx + c * by - ay) ** 2 - length**2
        for (ax, ay, bx, by), length in zip(exact, lengths, strict=True)
    ]
    basis = sympy.groebner([*equations, c**2 + s**2 - 1], x, y, c, s, order="lex")
    last = sympy.Poly(basis.exprs[-1], s)
    poses = []
    for root in last.nroots(n=30, maxsteps=200):
        if abs(sympy.im(root)) > 1e-20:
            continue
        sine = float(sympy.re(root))
        for cosine in (np.sqrt(max(0.0, 1 - sine**2)), -np.sqrt(max(0.0, 1 - sine**2))):
            pose = lifted(float(np.arctan2(sine, cosine)), a, b)
            poses.append(polished(pose, a, b))
    return np.array(poses)


def polished(pose: Poses, a: Poses, b: Poses) -> Poses:
    # The basis is of numbers rounded to 1e-4; what it found belongs to the mechanism only after a few steps of Newton.
    from scipy.optimize import fsolve

    x, _, code, _ = fsolve(closures, pose, args=(a, b), full_output=True, xtol=1e-14)
    return np.asarray(x if code == 1 and np.abs(x - pose).max() < 0.1 else pose)


def shown(seconds: float) -> str:
    for unit, scale in (("s", 1.0), ("ms", 1e3), ("µs", 1e6)):
        if seconds * scale >= 1:
            return f"{seconds * scale:.3g} {unit}"
    return f"{seconds * 1e9:.3g} ns"


if __name__ == "__main__":
    main()
