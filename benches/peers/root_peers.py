"""Systems that find the roots of one polynomial: numpy, FLINT, MPSolve.

They are given the eliminant: T(theta) as a sextic, from the rows by products of polynomials; u and v follow from the two rows
by Cramer's rule. Elimination and back-substitution are in the time.
"""

from __future__ import annotations

import ctypes
import ctypes.util
import itertools
from collections.abc import Callable, Sequence

from .problems import Answer, Leg, Rows, Solution, best_of, from_uv, rows


class Dense:
    """A polynomial as a list of coefficients, ascending: at this size quicker than any array."""

    __slots__ = ("coefficients",)

    def __init__(self, coefficients: Sequence[complex]) -> None:
        self.coefficients = coefficients

    def __mul__(self, other: Dense) -> Dense:
        out = [0j] * (len(self.coefficients) + len(other.coefficients) - 1)
        for i, c in enumerate(self.coefficients):
            for j, d in enumerate(other.coefficients):
                out[i + j] += c * d
        return Dense(out)

    def __sub__(self, other: Dense) -> Dense:
        pairs = itertools.zip_longest(self.coefficients, other.coefficients, fillvalue=0j)
        return Dense([c - d for c, d in pairs])

    def __call__(self, x: complex) -> complex:
        """Value at x."""
        value = 0j
        for c in reversed(self.coefficients):
            value = value * x + c
        return value


def sextic(equations: Rows, poly: Callable, constant: Callable) -> tuple:
    """T, and the numerators and denominator of u and v, as polynomials in theta; ascending coefficients.

    T has powers 1 to 7 of theta: the others cancel identically.
    """
    (p, q) = equations.rows
    # Row times theta: (c0 + c2 theta) u + (c1 theta^2 + c3 theta) v + c5 + c6 theta + c4 theta^2.
    a, b, c = zip(*[(poly([r[0], r[2]]), poly([0, r[3], r[1]]), poly([r[5], r[6], r[4]])) for r in (p, q)], strict=True)
    u, v, d = b[0] * c[1] - b[1] * c[0], c[0] * a[1] - c[1] * a[0], a[0] * b[1] - a[1] * b[0]
    return u * v - constant(equations.square) * d * d, u, v, d


def by_roots(legs: list[Leg], roots: Callable[[Sequence[complex]], list[complex]]) -> list[Solution]:
    """Elimination, roots, back-substitution in floating point."""
    t, u, v, d = sextic(rows(legs), Dense, lambda x: Dense([x]))
    return [(theta, u(theta) / d(theta), v(theta) / d(theta)) for theta in roots(t.coefficients[1:8])]


def numpy_answer(triads: list[list[Leg]]) -> Answer:
    """Companion matrix by numpy.roots."""
    import numpy

    def roots(coefficients: Sequence[complex]) -> list[complex]:
        return numpy.roots(coefficients[::-1]).tolist()

    out = Answer(f"numpy {numpy.__version__}", note="`roots` of the sextic in theta (companion matrix), back-substitution in Python")
    for legs in triads:
        seconds, found = best_of(lambda legs=legs: by_roots(legs, roots))
        out.seconds.append(seconds)
        out.solutions.append([from_uv(legs, *s) for s in found])
    return out


def flint_answer(triads: list[list[Leg]]) -> Answer:
    """Certified roots in ball arithmetic; the balls hold the solutions of the triad whose numbers are the given ones."""
    import flint
    from flint import acb, acb_poly, arb, ctx

    ctx.prec = 106
    out = Answer(
        f"python-flint {flint.__version__}",
        certified="every solution enclosed",
        note=f"`acb_poly.roots` of the sextic in theta, {ctx.prec} bits, back-substitution in balls",
    )

    def ball(z: complex) -> acb:
        return acb(z.real, z.imag)

    def conjugate(z: acb) -> acb:
        return acb(z.real, -z.imag)

    def solve(legs: list[Leg]) -> list[tuple[acb, acb, acb]]:
        # The rows again, every operation in balls, lengths as given.
        first, equations = legs[0], []
        for leg in legs[1:]:
            alpha, beta = ball(leg.a) - ball(first.a), ball(leg.b) - ball(first.b)
            lengths = (arb(leg.length) - arb(first.length)) * (arb(leg.length) + arb(first.length))
            constant = alpha * conjugate(alpha) + beta * conjugate(beta) - acb(lengths)
            cross = -beta * conjugate(alpha)
            equations.append([conjugate(beta), beta, -conjugate(alpha), -alpha, cross, conjugate(cross), constant])
        square = acb(arb(first.length) * arb(first.length))
        t, u, v, d = sextic(Rows(square, equations), acb_poly, lambda x: acb_poly([x]))
        roots = acb_poly([t[k] for k in range(1, 8)]).roots(tol=1e-16)
        return [(theta, u(theta) / d(theta), v(theta) / d(theta)) for theta in roots]

    for legs in triads:
        seconds, found = best_of(lambda legs=legs: solve(legs))
        out.seconds.append(seconds)
        first = legs[0]
        out.solutions.append([])
        for theta, u, v in found:
            z = u + ball(first.a) - theta * ball(first.b)
            w = v + conjugate(ball(first.a)) - conjugate(ball(first.b)) / theta
            out.solutions[-1].append((complex(theta), complex(z), complex(w)))
    return out


class MpSolve:
    """The few functions of libmps that one polynomial needs."""

    # enum mps_algorithm, mps_output_goal: Ehrlich-Aberth on secular equations; roots approximated to the digits asked for.
    SECULAR = 1
    APPROXIMATE = 1

    def __init__(self) -> None:
        name = ctypes.util.find_library("mps")
        if name is None:
            raise FileNotFoundError("libmps is not installed (Debian package libmps3)")
        self.lib = ctypes.CDLL(name)
        pointer = ctypes.c_void_p
        for function, result, arguments in [
            ("mps_context_new", pointer, []),
            ("mps_context_free", None, [pointer]),
            ("mps_monomial_poly_new", pointer, [pointer, ctypes.c_long]),
            ("mps_monomial_poly_set_coefficient_d", None, [pointer, pointer, ctypes.c_long, ctypes.c_double, ctypes.c_double]),
            ("mps_context_set_input_poly", None, [pointer, pointer]),
            ("mps_context_select_algorithm", None, [pointer, ctypes.c_int]),
            ("mps_context_set_output_goal", None, [pointer, ctypes.c_int]),
            ("mps_context_set_output_prec", None, [pointer, ctypes.c_long]),
            ("mps_mpsolve", None, [pointer]),
            ("mps_context_get_roots_d", ctypes.c_int, [pointer, pointer, pointer]),
        ]:
            getattr(self.lib, function).restype = result
            getattr(self.lib, function).argtypes = arguments

    def roots(self, coefficients: Sequence[complex]) -> list[complex]:
        """All roots; coefficients ascending."""
        lib = self.lib
        degree = len(coefficients) - 1
        context = lib.mps_context_new()
        poly = lib.mps_monomial_poly_new(context, degree)
        for power, c in enumerate(coefficients):
            lib.mps_monomial_poly_set_coefficient_d(context, poly, power, c.real, c.imag)
        lib.mps_context_set_input_poly(context, poly)
        lib.mps_context_select_algorithm(context, self.SECULAR)
        lib.mps_context_set_output_goal(context, self.APPROXIMATE)
        lib.mps_context_set_output_prec(context, 53)
        lib.mps_mpsolve(context)
        found = (ctypes.c_double * (2 * degree))()
        place = ctypes.c_void_p(ctypes.addressof(found))
        lib.mps_context_get_roots_d(context, ctypes.byref(place), None)
        lib.mps_context_free(context)
        return [complex(found[2 * k], found[2 * k + 1]) for k in range(degree)]


def mpsolve_answer(triads: list[list[Leg]]) -> Answer:
    """MPSolve on the sextic rounded to doubles."""
    solver = MpSolve()
    out = Answer("MPSolve (libmps)", note="secular algorithm to 53 bits on the sextic in theta, by ctypes, back-substitution in Python")
    for legs in triads:
        seconds, found = best_of(lambda legs=legs: by_roots(legs, solver.roots))
        out.seconds.append(seconds)
        out.solutions.append([from_uv(legs, *s) for s in found])
    return out
