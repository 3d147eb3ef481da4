"""Systems of numerical algebraic geometry: PHCpack, Macaulay2, Bertini 2.

They are given the rows, whose coefficients fill a linear space with six solutions almost everywhere. So a straight line between the
coefficients of one generic complex member, solved once, and those of a triad is a coefficient-parameter homotopy of six paths.
"""

from __future__ import annotations

import random
import re
import shutil
import statistics
import subprocess
import tempfile
from pathlib import Path

from .problems import RUNS, SAME, Answer, Leg, Rows, Solution, best_of, from_uv, residual, rows

# Monomials of a row, in the order of its coefficients.
MONOMIALS = ["ta*u", "th*v", "u", "v", "th", "ta"]


def generic(seed: int) -> Rows:
    """Random complex coefficients on the rows of a triad."""
    rng = random.Random(seed)

    def number() -> complex:
        return complex(rng.gauss(0, 1), rng.gauss(0, 1))

    return Rows(number(), [[number() for _ in range(7)] for _ in range(2)])


def program(name: str, package: str) -> str:
    """The path of a program."""
    path = shutil.which(name)
    if path is None:
        raise FileNotFoundError(f"{name} is not installed (Debian package {package})")
    return path


# ── PHCpack ──


def phc_text(equations: Rows) -> str:
    """The rows as PHCpack reads them."""

    def number(c: complex) -> str:
        c = complex(c)
        return f"({c.real:+.17e}{c.imag:+.17e}*i)"

    lines = [f"u*v - {number(equations.square)};"]
    for row in equations.rows:
        terms = [f"{number(c)}*{m}" for c, m in zip(row[:6], MONOMIALS, strict=True)]
        lines.append(" + ".join([*terms, number(row[6])]) + ";")
    return "\n".join(["4", *lines, "th*ta - 1;"]) + "\n"


def phc_text_natural(legs: list[Leg]) -> str:
    """The loop equations in x, y, cos, sin as PHCpack reads them, as one would write them down first."""
    lines = []
    for leg in legs:
        a, b = leg.a, leg.b
        along = f"(x + {b.real:.17e}*c - {b.imag:.17e}*s - {a.real:.17e})^2".replace("+ -", "- ").replace("- -", "+ ")
        across = f"(y + {b.real:.17e}*s + {b.imag:.17e}*c - {a.imag:.17e})^2".replace("+ -", "- ").replace("- -", "+ ")
        lines.append(f"{along} + {across} - {leg.length**2:.17e};")
    return "\n".join(["4", *lines, "c^2 + s^2 - 1;"]) + "\n"


NUMBER = r"([-+]?\d\.\d+E[-+]\d+)"


def phcpack_answers(triads: list[list[Leg]]) -> list[Answer]:
    """`phc -b` on two forms of the equations, a process for each triad; less the median time of a process that solves x^2 = 1."""
    phc = program("phc", "phcpack")
    with tempfile.TemporaryDirectory() as folder:
        place, result = Path(folder) / "in", Path(folder) / "out"

        def run(text: str) -> tuple[float, str]:
            place.write_text(text)

            def process() -> None:
                # It refuses to write over a file. -0: one seed, so that runs can be repeated.
                result.unlink(missing_ok=True)
                subprocess.run([phc, "-b", "-0", place, result], check=True, capture_output=True)

            seconds, _ = best_of(process)
            return seconds, result.read_text()

        start_up = statistics.median(run("1\nx^2 - 1;\n")[0] for _ in range(20))
        version = subprocess.run([phc, "--version"], check=False, capture_output=True, text=True).stdout
        number = re.search(r"v?(\d+\.\d+\.\d+)", version)
        name = f"PHCpack {number[1] if number else ''}".strip()
        taken_off = f"start-up of {1e3 * start_up:.0f} ms taken off"

        def rows_text(legs: list[Leg]) -> str:
            return phc_text(rows(legs))

        def from_rows(legs: list[Leg], values: dict[str, complex]) -> Solution | None:
            if not {"th", "u", "v"} <= values.keys() or values["th"] == 0:
                return None
            return from_uv(legs, values["th"], values["u"], values["v"])

        def from_natural(_: list[Leg], values: dict[str, complex]) -> Solution | None:
            if not {"x", "y", "c", "s"} <= values.keys():
                return None
            return values["c"] + 1j * values["s"], values["x"] + 1j * values["y"], values["x"] - 1j * values["y"]

        answers = []
        for text_of, solution_of, form in (
            (rows_text, from_rows, "the four bilinear rows, which suit it best"),
            (phc_text_natural, from_natural, "the loop equations in `x, y, cos, sin`"),
        ):
            out = Answer(name, note=f"`phc -b` on {form}; {taken_off}")
            for legs in triads:
                seconds, text = run(text_of(legs))
                out.seconds.append(seconds - start_up)
                # Repeated refinements append their lists: the last list of solutions is the answer.
                text = text[text.rfind("THE SOLUTIONS") :]
                found = []
                for part in re.split(r"\nsolution \d+ :", text)[1:]:
                    pairs = re.findall(rf" (\w+) : +{NUMBER} +{NUMBER}", part)
                    values = {name: complex(float(real), float(imaginary)) for name, real, imaginary in pairs}
                    solution = solution_of(legs, values)
                    # Ends of paths to infinity are listed, too.
                    if solution is not None and solution[0] != 0 and residual(legs, solution) < SAME:
                        found.append(solution)
                out.solutions.append(found)
            answers.append(out)
    return answers


# ── Macaulay2 ──

MACAULAY2 = """
needsPackage "NumericalAlgebraicGeometry"
setRandomSeed 4
line = (kind, seconds, points) -> (
    << kind << " " << toExternalString seconds;
    scan(points, p -> scan(coordinates p, c -> << " " << toExternalString realPart c << " " << toExternalString imaginaryPart c));
    << endl);
-- Coefficients: square, then seven of each row.
R = CC[th,ta,u,v]
system = c -> (
    row := k -> c#k*u*ta + c#(k+1)*v*th + c#(k+2)*u + c#(k+3)*v + c#(k+4)*th + c#(k+5)*ta + c#(k+6);
    {u*v - c#0, row 1, row 8, th*ta - 1})
-- The same, compiled with its coefficients as parameters.
(x1,x2,x3,x4) = (inputGate symbol x1, inputGate symbol x2, inputGate symbol x3, inputGate symbol x4)
p = apply(15, i -> inputGate (symbol p)_i)
gates = (row := k -> p#k*x3*x2 + p#(k+1)*x4*x1 + p#(k+2)*x3 + p#(k+3)*x4 + p#(k+4)*x1 + p#(k+5)*x2 + p#(k+6);
    transpose gateMatrix{{x3*x4 - p#0, row 1, row 8, x1*x2 - 1}})
segment = parametricSegmentHomotopy gateSystem(gateMatrix{p}, gateMatrix{{x1,x2,x3,x4}}, gates)
first' = START
start = system first'
known = select(solveSystem start, s -> status s === Regular)
assert(#known == 6)
solve' = c -> (
    target := system c;
    timings := apply(RUNS, i -> elapsedTiming track(start, target, known, Software => M2engine));
    line("track", min apply(timings, t -> t#0), select(timings#0#1, s -> member(status s, {Regular, Singular})));
    homotopy := specialize(segment, transpose matrix{join(first', c)});
    timings = apply(RUNS, i -> elapsedTiming trackHomotopy(homotopy, known));
    line("trackHomotopy", min apply(timings, t -> t#0), select(timings#0#1, s -> member(status s, {Regular, Singular}))))
"""


def macaulay2_text(equations: Rows) -> str:
    """The coefficients of the rows as a list in Macaulay2."""

    def number(x: float) -> str:
        mantissa, exponent = f"{x:.17e}".split("e")
        return f"{mantissa}p53e{int(exponent)}"

    coefficients = map(complex, [equations.square, *equations.rows[0], *equations.rows[1]])
    return "{" + ",".join(f"toCC({number(c.real)},{number(c.imag)})" for c in coefficients) + "}"


def macaulay2_answers(triads: list[list[Leg]]) -> list[Answer]:
    """`track` and the compiled `trackHomotopy`, timed inside the process."""
    program_path = program("M2", "macaulay2")
    version = subprocess.run([program_path, "--version"], check=True, capture_output=True, text=True).stdout.strip()
    script = MACAULAY2.replace("START", macaulay2_text(generic(7))).replace("RUNS", str(RUNS))
    script += "".join(f"solve' {macaulay2_text(rows(legs))}\n" for legs in triads)
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder) / "peers.m2"
        place.write_text(script)
        run = subprocess.run([program_path, "--script", place], check=False, capture_output=True, text=True)
    if run.returncode:
        raise RuntimeError(run.stderr.strip().splitlines()[0] if run.stderr else "Macaulay2 failed")
    out = [
        Answer(f"Macaulay2 {version}", note="`track`, coefficient-parameter homotopy, 6 paths, engine; timed inside the process"),
        Answer(
            f"Macaulay2 {version}, compiled", note="`trackHomotopy` of a `parametricSegmentHomotopy`, 6 paths; timed inside the process"
        ),
    ]
    by_kind = {"track": out[0], "trackHomotopy": out[1]}
    for text in run.stdout.splitlines():
        kind, *numbers = text.split()
        if kind not in by_kind:
            continue
        values = [float(re.sub(r"p\d+", "", number)) for number in numbers]
        points = [values[1 + 8 * k : 9 + 8 * k] for k in range((len(values) - 1) // 8)]
        by_kind[kind].seconds.append(values[0])
        by_kind[kind].solutions.append([(complex(*p[0:2]), complex(*p[4:6]), complex(*p[6:8])) for p in points])
    for answer in out:
        answer.solutions = [[from_uv(legs, *s) for s in found] for legs, found in zip(triads, answer.solutions, strict=True)]
    return out


# ── Bertini 2 ──


def bertini_answers(triads: list[list[Leg]]) -> list[Answer]:
    """`HomotopySolver` along a straight line of coefficients, in doubles and in adaptive precision."""
    import bertini
    from bertini.nag_algorithm import straight_line_homotopy

    # It would write down every solve, and look answers up instead of computing them.
    bertini.recording(False)
    th, ta, u, v = (bertini.Variable(name) for name in ("th", "ta", "u", "v"))

    def number(c: complex) -> object:
        c = complex(c)
        return bertini.complex_mp(repr(c.real), repr(c.imag))

    def system(equations: Rows) -> object:
        out = bertini.System()
        out.add_variable_group(bertini.VariableGroup([th, ta, u, v]))
        out.add_function(u * v - number(equations.square))
        for row in equations.rows:
            c = [number(x) for x in row]
            out.add_function(c[0] * u * ta + c[1] * v * th + c[2] * u + c[3] * v + c[4] * th + c[5] * ta + c[6])
        out.add_function(th * ta - 1)
        return out

    start = system(generic(7))
    first = bertini.ZeroDimSolver(start)
    first.solve()
    known = first.finite_solutions()
    if len(known) != 6:
        raise RuntimeError(f"the generic member has {len(known)} solutions, not 6")
    answers = []
    for precision in ("double", "adaptive"):
        version = getattr(bertini, "__version__", "2")
        note = "`HomotopySolver`, coefficient-parameter homotopy, 6 paths, power series endgame; set-up not in the time"
        out = Answer(f"Bertini 2 (bertini2 {version}), {precision}", note=note)
        for legs in triads:
            homotopy = straight_line_homotopy(system(rows(legs)), start, gamma=1)
            # A solver solves once; setting it up is not in the time.
            solvers = [bertini.HomotopySolver(homotopy, known, mptype=precision) for _ in range(RUNS)]
            waiting = iter(solvers)
            seconds, _ = best_of(lambda waiting=waiting: next(waiting).solve())
            solver = solvers[-1]
            out.seconds.append(seconds)
            found = [[complex(x) for x in point] for point in solver.finite_solutions()]
            out.solutions.append([from_uv(legs, p[0], p[2], p[3]) for p in found])
        answers.append(out)
    return answers
