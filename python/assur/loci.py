"""Where a manipulator is singular for an orientation, and how well it is held elsewhere."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ._arrays import FloatArray
from ._report import Report, number

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["LegLocus", "LocusPolynomial", "ModeLocus", "PlaneCurve", "PlaneMap", "SingularityLoci", "Type2Locus"]


@dataclass(frozen=True, eq=False)
class LocusPolynomial:
    """The exact curve of type 2 for all working modes, coefficients rounded.

    Attributes
    ----------
    degree : int
    everywhere : bool
        Whether every position is singular.
    terms : ndarray, shape (n, 3)
        Power of ``x``, power of ``y``, coefficient; the largest coefficient is 1 in size.
    removed : list
        Factors taken out, each with its power.
    """

    variables: tuple[str, ...]
    degree: int
    everywhere: bool
    terms: FloatArray
    removed: list[list[object]]


@dataclass(frozen=True, eq=False)
class ModeLocus:
    """The part of the curve that belongs to one working mode: pieces, shape ``(n, 2, 2)``: ends of each, ``x, y``."""

    signs: str
    pieces: FloatArray


@dataclass(frozen=True, eq=False)
class Type2Locus:
    """Positions where the actuators do not hold the platform; ``reason`` says why there is no polynomial."""

    polynomial: LocusPolynomial | None
    reason: str | None
    clipped_to: str
    modes: tuple[ModeLocus, ...]


@dataclass(frozen=True, eq=False)
class PlaneCurve:
    """A ``"circle"`` (center, radius) or a ``"line"`` (point, direction)."""

    curve: str
    center: FloatArray | None
    radius: float | None
    point: FloatArray | None
    direction: FloatArray | None


@dataclass(frozen=True, eq=False)
class LegLocus:
    """Where a leg is at the end of its reach: a singularity of type 1."""

    leg: int
    everywhere: bool
    curves: tuple[PlaneCurve, ...]


@dataclass(frozen=True, eq=False)
class PlaneMap:
    """A quantity over the plane for one orientation and working mode.

    Attributes
    ----------
    quantity : str
        ``"dexterity"``, ``"accuracy"`` or ``"stiffness"``.
    low, high : ndarray, shape (2,)
        Corners of the window.
    columns, rows : int
    values : ndarray, shape (rows * columns,)
        Row by row from below; NaN where a leg does not reach within its limits. ``grid`` is the same as ``(rows, columns)``.
    """

    quantity: str
    signs: str
    characteristic_length: float
    low: FloatArray
    high: FloatArray
    columns: int
    rows: int
    values: FloatArray

    @property
    def grid(self) -> FloatArray:
        """The values, shape ``(rows, columns)``, lowest row first."""
        return self.values.reshape(self.rows, self.columns)


@dataclass(frozen=True, eq=False, repr=False)
class SingularityLoci(Report):
    """Where a manipulator is singular for an orientation.

    Attributes
    ----------
    phi : float
        The orientation, radians.
    type_2 : Type2Locus
        Curves on which the actuators do not hold the platform.
    type_1 : tuple of LegLocus
        Curves on which a leg ends.
    map : PlaneMap or None
        The quantity asked for.
    """

    phi: float
    type_2: Type2Locus
    type_1: tuple[LegLocus, ...]
    map: PlaneMap | None

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the curves over the map, if there is one; returns the axes, shows nothing."""
        from . import _plot

        return _plot.loci(self, ax)

    def _title(self) -> str:
        return f"Singular positions at phi = {number(self.phi)} rad"

    def _summary(self) -> str:
        polynomial = self.type_2.polynomial
        if polynomial is None:
            curve = f"no exact curve ({self.type_2.reason})"
        else:
            curve = f"a curve of degree {polynomial.degree}, {len(polynomial.terms)} terms, for all modes"
        return f"type 2: {curve}; {len(self.type_2.modes)} modes traced"
