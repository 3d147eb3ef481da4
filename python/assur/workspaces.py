"""Where a manipulator can reach, exactly: closed loops of circular arcs, segments and coupler curves. Angles in radians."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _assur
from ._arrays import MOST_POINTS, FloatArray, read_only, rows, whole
from ._report import Report, counted, number
from .errors import InputError

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["BoundaryArc", "BoundaryLoop", "Isolated", "Memberships", "Optimum", "Overlay", "Region", "Slice", "Stack", "StrokeVoid"]

#: Points along each arc where an outline is made of straight pieces.
POINTS = 64


@dataclass(frozen=True, eq=False)
class _OnCurve:
    """A piece of a curve, and what defines the curve: ``"point"``, ``"line"``, ``"circle"``, ``"ellipse"`` or ``"coupler"``."""

    curve: str
    active: tuple[str, ...]
    center: FloatArray | None
    radius: float | None
    start_angle: float | None
    end_angle: float | None
    pair: list[dict[str, Any]] | None
    sigma: float | None
    phi_start: float | None
    phi_end: float | None


@dataclass(frozen=True, eq=False)
class BoundaryArc(_OnCurve):
    """A piece of boundary, the region on its left.

    Attributes
    ----------
    curve : str
        ``"line"``, ``"circle"``, ``"ellipse"`` or ``"coupler"``, with what defines it.
    start, end : ndarray, shape (2,)
    active : tuple of str
        The limits active on it: ``"leg 1 max"``, ``"leg 2 side"``, ``"phi from"``.
    center, radius, start_angle, end_angle
        Of a circle.
    pair, sigma, phi_start, phi_end
        Of an ellipse or coupler curve: the two limits held at once, and the orientations at its ends.
    """

    start: FloatArray
    end: FloatArray


@dataclass(frozen=True, eq=False)
class BoundaryLoop:
    """A closed boundary; its area is positive for an outer one, which runs counter-clockwise, and negative for a hole."""

    area: float
    arcs: tuple[BoundaryArc, ...]


@dataclass(frozen=True, eq=False)
class Isolated(_OnCurve):
    """A point (``at``) or curve (``start``, ``end``) of the workspace that has no area."""

    at: FloatArray | None
    start: FloatArray | None
    end: FloatArray | None


@dataclass(frozen=True, eq=False, repr=False)
class _Measured:
    """What is measured of a region of the plane."""

    area: float
    perimeter: float
    centroid: FloatArray | None
    bbox: FloatArray | None
    components: int
    holes: int
    loops: tuple[BoundaryLoop, ...]
    isolated: tuple[Isolated, ...]
    unclosed: tuple[BoundaryArc, ...]

    def _without_area(self) -> str:
        """What a region without an area is; one that is undecided is not empty."""
        if self.unclosed:
            return "undecided"
        return f"no area, {counted(len(self.isolated), 'isolated part')}" if self.isolated else "empty"


@dataclass(frozen=True, eq=False)
class Slice(_Measured):
    """The constant-orientation workspace of one orientation, radians, measured as :class:`Region` is."""

    phi: float


@dataclass(frozen=True, eq=False)
class Overlay(_Measured):
    """A workspace of another kind, drawn over a :class:`Region` and measured as one."""

    kind: str
    phi: float | None
    lower: float | None
    upper: float | None
    mode: str
    status: str
    separating: tuple[BoundaryArc, ...]

    _renamed: ClassVar[Mapping[str, str]] = {"from": "lower", "to": "upper"}

    def _label(self) -> str:
        return _asked(self.kind, self.phi, self.lower, self.upper)


@dataclass(frozen=True, eq=False)
class StrokeVoid:
    """What the stroke of a PRR leg leaves out around its middle, in places of the leg's platform pivot in the base frame.

    Attributes
    ----------
    kind : {"none", "touching", "lens"}
        Nothing; a point that is reached, where the stroke is two links; an open lens, where it is shorter.
    points : ndarray, shape (n, 2)
        The point, or the lens's tips.
    area : float
        The lens's area.
    """

    kind: str
    points: FloatArray
    area: float

    @classmethod
    def _of(cls, kind: str, flat: list[float], area: float) -> StrokeVoid:
        points = _pairs(flat)
        read_only(points)
        return cls(kind, points, area)


@dataclass(frozen=True, eq=False)
class Stack:
    """Slices over a range of orientations.

    Attributes
    ----------
    lower, upper : float
        The range, radians.
    volume : float
        Of all poses with these orientations, area times radians; ``volume_error`` is an estimate of its error.
    slices : tuple of Slice
        At evenly spaced orientations, both ends included (of a whole turn only the first).
    """

    lower: float
    upper: float
    volume: float
    volume_error: float
    slices: tuple[Slice, ...]

    _renamed: ClassVar[Mapping[str, str]] = {"from": "lower", "to": "upper"}


@dataclass(frozen=True, eq=False)
class Optimum:
    """The best design that was found; a better one may lie between those that were tried.

    Attributes
    ----------
    values : dict
        Its numbers by their keys; radians for angles. ``robot.with_numbers(optimum.values)`` is the design.
    area : float
    gradient : dict
        The area's derivatives by the numbers: near zero inside the bounds, or pointing outwards at one.
    area_before : float
        The area of the design that was given.
    evaluations : int
        How many designs were measured.
    """

    values: dict[str, float]
    area: float
    gradient: dict[str, float]
    area_before: float
    evaluations: int


@dataclass(frozen=True, eq=False)
class Memberships:
    """Of many places: whether each is inside, how far it is from the boundary, and what binds there.

    Attributes
    ----------
    inside : ndarray of bool, shape (n,)
    margin : ndarray, shape (n,)
        Length units: how far the point may be moved without turning the platform before a limit is met; negative outside, and -inf
        where no orientation is allowed.
    binding : tuple of (str or None), length n
    """

    inside: NDArray[np.bool_]
    margin: FloatArray
    binding: tuple[str | None, ...]


@dataclass(frozen=True, eq=False, repr=False)
class Region(_Measured, Report):
    """A workspace of a manipulator's reference point, exactly.

    Attributes
    ----------
    kind : str
        ``"constant"``, ``"maximal"``, ``"inclusive"``, ``"total"`` or ``"dextrous"``.
    phi, lower, upper : float or None
        The orientation, or the range of orientations asked for, radians.
    mode : str
        Working modes that count: ``"both"`` or signs.
    area, perimeter : float
        In closed form up to the integrals of coupler curves, which are to rounding.
    centroid : ndarray, shape (2,), or None
    bbox : ndarray, shape (4,), or None
        ``xmin, ymin, xmax, ymax``.
    components, holes : int
        Pieces of positive area; pieces that touch in a point count as two.
    loops : tuple of BoundaryLoop
        Outer ones run counter-clockwise, holes clockwise.
    isolated : tuple of Isolated
        Points and curves of no area.
    unclosed : tuple of BoundaryArc
        Pieces that could not be joined to loops, where digits ran out; ``status`` is then ``"undecided"``.
    separating : tuple of BoundaryArc
        Arcs inside where a way of reaching the places ends.
    assembly : ndarray, shape (3,), or None
        The pose whose assembly alone counts, where one was named.
    stack : Stack or None
        Slices over the orientations, where they were asked for.
    gradient : dict or None
        The area's derivatives by numbers of the design, where they were asked for: area over length, or over radians.
    optimum : Optimum or None
        The design with the largest area found, where it was asked for.
    overlays : tuple of Overlay
        Workspaces of other kinds, where they were asked for.
    """

    kind: str
    phi: float | None
    lower: float | None
    upper: float | None
    mode: str
    status: str
    separating: tuple[BoundaryArc, ...]
    assembly: FloatArray | None
    stack: Stack | None
    gradient: dict[str, float] | None
    optimum: Optimum | None
    overlays: tuple[Overlay, ...]

    _renamed: ClassVar[Mapping[str, str]] = {"from": "lower", "to": "upper"}

    @cached_property
    def _shape(self) -> _assur.Shape:
        """What the library knows of the region; made again where the result has travelled."""
        robot, question = self._origin
        shape: _assur.Shape = robot._model.workspace(question)[1]
        return shape

    def __getstate__(self) -> dict[str, Any]:
        # The shape lives in this process only; where the result goes it is made again when it is asked.
        return {name: value for name, value in self.__dict__.items() if name != "_shape"}

    def memberships(self, points: ArrayLike) -> Memberships:
        """Whether places are inside, how far from the boundary, and what binds there.

        Parameters
        ----------
        points : array_like, shape (n, 2)

        Raises
        ------
        InputError
            A wrong shape; a place that is not finite.
        """
        given = rows("points", points, 2)
        for row in np.flatnonzero(~np.isfinite(given).all(axis=1)):
            place = given[row].tolist()
            raise InputError(f"points: row {row}: {place} must be finite", row=int(row), field="points", value=place)
        if self.assembly is not None:
            raise InputError("points: membership is of whole workspaces, not of one assembly", field="assembly")
        inside, margin, binding = self._shape.memberships(given)
        return Memberships(inside, margin, tuple(binding))

    def contains(self, points: ArrayLike) -> NDArray[np.bool_]:
        """Whether places are inside, boundary included; shape ``(n,)`` for points of shape ``(n, 2)``, decided exactly."""
        return self.memberships(points).inside

    def outlines(self, points: int = POINTS) -> list[NDArray[np.float64]]:
        """The loops as closed polygons, ``points`` to each curved arc, in the order of ``loops``; each of shape ``(n, 2)``."""
        return [_pairs(flat) for flat in self._shape.outlines(_fine(points))]

    def slice_outlines(self, points: int = POINTS) -> list[list[NDArray[np.float64]]]:
        """The loops of each slice of the stack as closed polygons, as :meth:`outlines`; empty without a stack."""
        return [[_pairs(flat) for flat in loops] for loops in self._shape.slices(_fine(points))]

    def overlay_outlines(self, points: int = POINTS) -> list[list[NDArray[np.float64]]]:
        """The loops of each overlay as closed polygons, as :meth:`outlines`."""
        return [[_pairs(flat) for flat in loops] for loops in self._shape.overlays(_fine(points))]

    def to_dxf(self) -> str:
        """The boundary as a DXF drawing (release 12), lines, arcs and circles exact; what ``--dxf`` writes."""
        return self._shape.dxf()

    def to_csv(self) -> str:
        """Points along the boundary as CSV, ``part,loop,arc,curve,active,x,y``; what ``--csv`` writes."""
        return self._shape.csv()

    def to_shapely(self, points: int = POINTS) -> Any:
        """The region as a shapely ``MultiPolygon``, curves as polygons of ``points`` each; needs shapely."""
        import shapely

        outlines = self.outlines(points)
        outer = [line for line, loop in zip(outlines, self.loops, strict=True) if loop.area > 0]
        holes = [line for line, loop in zip(outlines, self.loops, strict=True) if loop.area <= 0]
        whole = shapely.union_all([shapely.make_valid(shapely.Polygon(line)) for line in outer])
        cut = shapely.union_all([shapely.make_valid(shapely.Polygon(line)) for line in holes])
        found = shapely.difference(whole, cut)
        parts = [part for part in getattr(found, "geoms", [found]) if part.geom_type == "Polygon" and not part.is_empty]
        return shapely.MultiPolygon(parts)

    def plot(self, ax: Axes | None = None, *, label: str | None = None) -> Axes:
        """Draws the region; returns the axes, shows nothing.

        Parameters
        ----------
        ax : matplotlib Axes, optional
            Where to draw; without it new axes are made.
            Overlays are drawn with it.
        label : str, optional
            With it the region is one of several over one another, in one colour under this name; without it each arc has the colour of its limits.
        """
        from . import _plot

        return _plot.region(self, ax, label)

    def plot_slices(self, ax: Axes | None = None) -> Axes:
        """Draws the slices of the stack over one another, ``phi`` upwards, into axes in space; returns them, shows nothing."""
        from . import _plot

        return _plot.slices(self, ax)

    def _title(self) -> str:
        return f"{_asked(f'{self.kind} workspace', self.phi, self.lower, self.upper)}, mode {self.mode}"

    def _table(self) -> list[list[str]]:
        table = [
            [str(place), number(loop.area), str(len(loop.arcs)), ", ".join(dict.fromkeys(a for arc in loop.arcs for a in arc.active))]
            for place, loop in enumerate(self.loops, 1)
        ]
        return [["loop", "area", "arcs", "limits"], *table] if table else []

    def _summary(self) -> str:
        pieces = f"{counted(self.components, 'component')}, {counted(self.holes, 'hole')}"
        parts = [f"area {number(self.area)}, perimeter {number(self.perimeter)}, {pieces}" if self.components else self._without_area()]
        if self.stack is not None:
            parts.append(f"volume {number(self.stack.volume)} over {len(self.stack.slices)} slices")
        parts += [f"d area / d {key} {number(slope)}" for key, slope in (self.gradient or {}).items()]
        if self.optimum is not None:
            parts.append(f"largest area found {number(self.optimum.area)}")
        parts += [f"{other._label()}: area {number(other.area)}" for other in self.overlays]
        return "; ".join(parts)


def _asked(what: str, phi: float | None, lower: float | None, upper: float | None) -> str:
    if lower is not None and upper is not None:
        return f"{what} over phi from {number(lower)} to {number(upper)}"
    return what if phi is None else f"{what} at phi = {number(phi)}"


def _fine(points: int) -> int:
    return whole("points", points, 2, MOST_POINTS)


def _pairs(flat: list[float]) -> NDArray[np.float64]:
    return np.asarray(flat).reshape(-1, 2)
