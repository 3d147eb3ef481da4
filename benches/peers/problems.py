"""The triads, their equations in the forms that the systems take, and what an answer is worth."""

from __future__ import annotations

import cmath
import math
import random
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TypeVar

Result = TypeVar("Result")

# Runs of each triad by each system; the shortest counts, the others were interrupted.
RUNS = 3

# theta, z, w: e^(i phi), x + iy, x - iy, independent complex numbers.
Solution = tuple[complex, complex, complex]

# Two solutions closer than this, relative, are one. Loose: trackers stop at half the digits; residuals tell the rest.
SAME = 1e-6


@dataclass
class Leg:
    """An RR leg: pivots on base and platform, and their distance."""

    a: complex
    b: complex
    length: float


@dataclass
class Rows:
    """The loop equations less the first, seen from the first leg, lengths over the size.

    u v = square; each row holds the coefficients of tau u, theta v, u, v, theta, tau, 1; theta tau = 1.
    """

    square: float
    rows: list[list[complex]]


@dataclass
class Answer:
    """What one system made of all triads, in their order."""

    system: str
    seconds: list[float] = field(default_factory=list)
    solutions: list[list[Solution]] = field(default_factory=list)
    real_only: bool = False
    certified: str = "no"
    note: str = ""


def best_of(solve: Callable[[], Result]) -> tuple[float, Result]:
    """The shortest time of RUNS, in seconds, and the result."""
    best, result = math.inf, None
    for _ in range(RUNS):
        start = time.perf_counter()
        result = solve()
        best = min(best, time.perf_counter() - start)
    return best, result


def planted(count: int, seed: int) -> list[list[Leg]]:
    """Random RR-RR-RR triads that close in at least one pose; the distribution of benches/certify.rs."""
    rng = random.Random(seed)

    def point() -> complex:
        return complex(rng.uniform(-5, 5), rng.uniform(-5, 5))

    def triad() -> list[Leg]:
        at, turn = point(), cmath.exp(1j * rng.uniform(-math.pi, math.pi))
        pivots = [(point(), point()) for _ in range(3)]
        return [Leg(a, b, abs(at + turn * b - a)) for a, b in pivots]

    return [triad() for _ in range(count)]


def size(legs: list[Leg]) -> float:
    """The largest length of a triad."""
    first = legs[0]
    return max(max(abs(leg.a - first.a), abs(leg.b - first.b), leg.length) for leg in legs)


def rows(legs: list[Leg]) -> Rows:
    """The equations in isotropic coordinates; u = z + theta b1 - a1, v likewise, over the size."""
    first, scale = legs[0], size(legs)
    radius = first.length / scale
    out = []
    for leg in legs[1:]:
        alpha, beta, length = (leg.a - first.a) / scale, (leg.b - first.b) / scale, leg.length / scale
        constant = abs(alpha) ** 2 + abs(beta) ** 2 - (length - radius) * (length + radius)
        cross = -beta * alpha.conjugate()
        out.append([beta.conjugate(), beta, -alpha.conjugate(), -alpha, cross, cross.conjugate(), complex(constant)])
    return Rows(radius * radius, out)


def from_uv(legs: list[Leg], theta: complex, u: complex, v: complex) -> Solution:
    """A solution of the rows in the frames and lengths of the triad."""
    first, scale = legs[0], size(legs)
    z = u * scale + first.a - theta * first.b
    w = v * scale + first.a.conjugate() - first.b.conjugate() / theta
    return theta, z, w


def residual(legs: list[Leg], solution: Solution) -> float:
    """Largest defect of a loop equation over the sizes of its terms."""
    theta, z, w = solution
    worst = 0.0
    for leg in legs:
        p = z + theta * leg.b - leg.a
        q = w + leg.b.conjugate() / theta - leg.a.conjugate()
        terms = (abs(z) + abs(theta * leg.b) + abs(leg.a)) * (abs(w) + abs(leg.b / theta) + abs(leg.a))
        worst = max(worst, abs(p * q - leg.length**2) / (terms + leg.length**2))
    return worst


def same(legs: list[Leg], first: Solution, second: Solution) -> bool:
    """Whether two solutions are one, to the digits of SAME."""
    scale = size(legs)
    scales = (1.0, scale, scale)
    return all(abs(x - y) <= SAME * (s + abs(x)) for x, y, s in zip(first, second, scales, strict=True))


def is_real(solution: Solution) -> bool:
    """Whether a solution of the reference route, whose real ones are exact, is a pose."""
    theta, z, w = solution
    return abs(abs(theta) - 1) < 1e-12 and abs(z - w.conjugate()) < 1e-12 * (1 + abs(z))
