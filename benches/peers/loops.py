"""Measures other systems beside assur on coupler curves and larger Assur groups, on the same random problems, in one run.

    python3 benches/peers/loops.py               # table to standard output; half a minute

Two coupler curves: Macaulay2's `track`, from a product of linear forms with the 18 solutions of two equations of degree (3, 3), to the two
sextics. Trusses of seven and nine links: LAPACK's zggev through scipy on the Dixon pencil that assur forms as well. What a peer is given ready
made, equations or pencil, is not in its time. numpy and scipy go to the virtual environment in target/peers; Macaulay2 is the Debian
package and left out where it is not installed.
"""

from __future__ import annotations

import itertools
import json
import math
import os
import random
import shutil
import statistics
import subprocess
import sys
import time
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
HOME = ROOT / "target" / "peers"
PYTHON = HOME / "bin" / "python"
COUPLERS, TRUSSES, RUNS = 2, 1, 1
SEED = 18

# Edges, the hidden link that gives the smallest regular pencil with link 0 as ground, and the number of assemblies.
KINDS = {
    "7#0": ("04 14 25 35 45 06 16 26 36", 1, 18),
    "9#26": ("03 14 25 06 16 26 27 37 47 18 38 58", 1, 58),
}

MACAULAY2 = """
needsPackage "NumericalAlgebraicGeometry"
setRandomSeed 4
R = CC[z,w]
form = c -> sum(4, i -> sum(4, j -> ((c#i#j#0) + ii*(c#i#j#1)) * z^i * w^j))
one = {P1, P2}
start = {(z^3 - P1#0)*(w^3 - P1#1), (z^3 - P2#0)*(w^3 - P2#1)}
cube = c -> apply(3, k -> (c^(1/3)) * exp(2*pi*ii*k/3))
points = flatten apply(cube(P1#0), x -> apply(cube(P2#1), y -> {x, y})) | flatten apply(cube(P2#0), x -> apply(cube(P1#1), y -> {x, y}))
scan(PROBLEMS, c -> (
    target = {form(c#0), form(c#1)};
    best = infinity;
    for k from 1 to RUNS do (t = elapsedTiming(found = track(start, target, points, gamma => exp(0.7*ii))); best = min(best, t#0));
    << toExternalString best << " " << #select(found, p -> status p === Regular) << endl))
"""


def problems() -> dict:
    """Random four-bars in pairs and random drawings of the trusses."""
    rng = random.Random(SEED)

    def point() -> list[float]:
        return [rng.uniform(-3, 3), rng.uniform(-3, 3)]

    def four_bar() -> dict:
        return {"a": point(), "b": point(), "p": point(), "q": point(), "r": rng.uniform(1, 4), "s": rng.uniform(1, 4)}

    trusses = []
    for kind, (edges, _, _) in KINDS.items():
        pairs = [[int(c) for c in edge] for edge in edges.split()]
        trusses += [
            {"kind": kind, "links": int(kind[0]), "edges": pairs, "joint_xy": [point() for _ in pairs]} for _ in range(TRUSSES)
        ]
    return {"couplers": [[four_bar(), four_bar()] for _ in range(COUPLERS)], "trusses": trusses}


def ours(given: dict) -> list[dict]:
    """The answers of assur, by the example `peers_loops`."""
    place = HOME / "loops.json"
    place.write_text(json.dumps(given))
    command = os.environ.get("ASSUR_PEERS_LOOPS", "").split() or ["cargo", "run", "--quiet", "--release", "--example", "peers_loops", "--"]
    lines = subprocess.run([*command, str(place)], cwd=ROOT, check=True, capture_output=True, text=True).stdout.splitlines()
    return [json.loads(line) for line in lines]


def macaulay2(equations: list) -> list[tuple[float, int]]:
    """Seconds and solutions of `track` for each pair of sextics."""

    def braces(value: object) -> str:
        return "{" + ",".join(map(braces, value)) + "}" if isinstance(value, list) else f"{value:.17e}".replace("e", "p53e", 1)

    numbers = [[[0.6, 0.8], [-0.28, 0.96]], [[0.8, -0.6], [-0.96, -0.28]]]
    constants = ["{" + ",".join(f"{re:+.2f}+ii*({im:+.2f})" for re, im in row) + "}" for row in numbers]
    text = MACAULAY2.replace("one = {P1, P2}\n", "").replace("P1", constants[0]).replace("P2", constants[1])
    text = text.replace("PROBLEMS", braces(equations)).replace("RUNS", str(RUNS))
    place = HOME / "loops.m2"
    place.write_text(text)
    done = subprocess.run(["M2", "--script", str(place)], check=True, capture_output=True, text=True)
    rows = [line.split() for line in done.stdout.splitlines() if line.strip()]
    return [(float(seconds.split("p")[0]), int(count)) for seconds, count in rows]


def loops(truss: dict) -> list[list[complex]]:
    """Rows of the closure equations around independent loops of the drawing, one column a link."""
    links, edges = truss["links"], truss["edges"]
    at = [complex(*xy) for xy in truss["joint_xy"]]
    parent: dict[int, tuple[int, int]] = {}
    order = [0]
    for link in order:
        for joint, edge in enumerate(edges):
            if link in edge:
                other = edge[0] + edge[1] - link
                if other != 0 and other not in parent:
                    parent[other] = (link, joint)
                    order.append(other)

    def up(link: int) -> list[tuple[int, int]]:
        way = []
        while link:
            link, joint = parent[link]
            way.append((link, joint))
        return way

    tree = {joint for _, joint in parent.values()}
    rows = []
    for joint, (a, b) in enumerate(edges):
        if joint in tree:
            continue
        # From the ground out to one end of the joint, and back from the other.
        row = [0j] * links

        def walk(end: int, sign: int, row: list[complex] = row, joint: int = joint) -> None:
            enters, link = joint, end
            for upper, through in up(end):
                row[link] += sign * (at[enters] - at[through])
                link, enters = upper, through
            row[0] += sign * at[enters]

        walk(a, 1)
        walk(b, -1)
        rows.append(row)
    return rows


def lapack(truss: dict, hidden: int) -> tuple[float, int]:
    """Seconds of the generalised eigenproblem, and how many of its pairs solve the loops."""
    import numpy as np
    import scipy.linalg

    rows = np.array(loops(truss))
    rows = rows / np.abs(rows).max()
    size = len(rows)
    others = [k for k in range(1, truss["links"]) if k != hidden]
    count = len(others)
    c, d = rows, rows.conj()

    def minor(m: np.ndarray, first: int, rest: tuple[int, ...]) -> complex:
        return np.linalg.det(m[:, [first, *(others[k] for k in rest)]])

    lower, upper = (list(itertools.combinations(range(count), k)) for k in (size - 1, size))
    place = {chosen: k for k, chosen in enumerate(lower + upper)}
    m0, m1 = (np.zeros((len(place), len(place)), complex) for _ in range(2))
    for chosen, row in place.items():
        rest = tuple(k for k in range(count) if k not in chosen)
        if len(chosen) == size - 1:
            m0[row, row], m1[row, row] = minor(c, 0, chosen), minor(c, hidden, chosen)
            for j in rest:
                m0[row, place[tuple(sorted((*chosen, j)))]] = minor(c, others[j], chosen)
        else:
            m1[row, row], m0[row, row] = minor(d, 0, rest), minor(d, hidden, rest)
            for j in chosen:
                m1[row, place[tuple(k for k in chosen if k != j)]] = minor(d, others[j], rest)
    best = math.inf
    for _ in range(RUNS):
        start = time.perf_counter()
        (alpha, beta), vectors = scipy.linalg.eig(-m0, m1, homogeneous_eigvals=True)
        best = min(best, time.perf_counter() - start)
    found = 0
    for a, b, vector in zip(alpha, beta, vectors.T, strict=True):
        if abs(a) < 1e-12 * abs(b) or abs(b) < 1e-12 * abs(a):
            continue
        theta = np.ones(truss["links"], complex)
        theta[hidden] = a / b
        for j, link in enumerate(others):
            without = max((s for s in lower if j not in s), key=lambda s: abs(vector[place[s]]))
            theta[link] = vector[place[tuple(sorted((*without, j)))]] / vector[place[without]]
        terms = np.concatenate([rows * theta, rows.conj() / theta])
        found += bool((np.abs(terms.sum(axis=1)) < 1e-6 * np.abs(terms).sum(axis=1)).all())
    return best, found


def shown(seconds: list[float]) -> str:
    """The median, readable."""
    median = statistics.median(seconds)
    return f"{1e6 * median:.0f} µs" if median < 1e-3 else f"{1e3 * median:.2f} ms"


def main() -> None:
    """Measures and prints the table."""
    given = problems()
    answers = ours(given)
    table = []
    couplers = [answer for answer in answers if answer["kind"] == "coupler"]
    table.append(("coupler-coupler, 18", "assur", couplers, COUPLERS * 18))
    if shutil.which("M2"):
        rows = macaulay2([answer["equations"] for answer in couplers])
        table.append(("coupler-coupler, 18", "Macaulay2 `track`", [{"seconds": s, "count": n} for s, n in rows], COUPLERS * 18))
    for kind, (_, hidden, count) in KINDS.items():
        table.append((f"truss {kind}, {count}", "assur", [a for a in answers if a["kind"] == kind], TRUSSES * count))
        rows = [lapack(truss, hidden) for truss in given["trusses"] if truss["kind"] == kind]
        peer = "LAPACK zggev, eigenproblem alone"
        table.append((f"truss {kind}, {count}", peer, [{"seconds": s, "count": n} for s, n in rows], TRUSSES * count))
    print("| problem | system | median | solutions found |\n|---|---|---|---|")
    for problem, system, rows, wanted in table:
        print(f"| {problem} | {system} | {shown([r['seconds'] for r in rows])} | {sum(r['count'] for r in rows)} of {wanted} |")
    print(f"\nload {os.getloadavg()[0]:.1f}", file=sys.stderr)


if __name__ == "__main__":
    if Path(sys.prefix) != HOME:
        HOME.mkdir(parents=True, exist_ok=True)
        if not PYTHON.exists():
            venv.create(HOME, with_pip=True)
        subprocess.run([PYTHON, "-m", "pip", "install", "--quiet", "numpy", "scipy"], check=True)
        one_thread = {name: "1" for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")}
        os.execve(PYTHON, [str(PYTHON), __file__, *sys.argv[1:]], os.environ | one_thread)
    main()
