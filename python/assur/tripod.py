"""Three-legged robots of six degrees of freedom. Angles in radians."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _assur
from ._arrays import FloatArray, number as one_number, read_only, reals, rows, spread, vector, whole
from ._report import Report, number, numbers, result
from ._spatial import MOST_CELLS, MOST_SECTIONS, Spatial
from ._spatial_batch import TripodVelocityBatch
from .errors import InputError
from .modes import Account
from .motion import BothWays

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = [
    "DeterminantCurve",
    "DeterminantCurves",
    "DeterminantPoint",
    "Pointed",
    "PointedWay",
    "Tilt",
    "TiltMap",
    "TiltSection",
    "Torsion",
    "Torsions",
    "Tripod",
    "TripodAssemblies",
    "TripodAssembly",
    "TripodPose",
    "TripodVelocity",
    "TripodViolation",
    "TripodWay",
]

#: Tolerance of the proved tilt where nothing else is said, radians, as on the command line.
TILT_TOLERANCE = 1e-3
#: Most elevations of a curve, as on the command line.
MOST_ELEVATIONS = 1_000_000


@dataclass(frozen=True, eq=False)
class TripodPose:
    """A place, shape ``(3,)``, and a rotation matrix, shape ``(3, 3)``."""

    position: FloatArray
    rotation: FloatArray


@dataclass(frozen=True, eq=False)
class TripodViolation:
    """A slider outside its stroke, or a leg's plane turned too far."""

    leg: int
    slider: int | None
    value: float | None
    plane_angle: float | None
    limit: FloatArray


@dataclass(frozen=True, eq=False, repr=False)
class TripodWay(Report):
    """Slider positions for a pose, shape ``(6,)``, with the limits that they violate."""

    pose: TripodPose
    inputs: FloatArray
    plane_angles: FloatArray
    violations: tuple[TripodViolation, ...]

    def _title(self) -> str:
        return "Three-legged robot"

    def _table(self) -> list[list[str]]:
        rows = zip(self.inputs.reshape(3, 2), self.plane_angles, strict=True)
        return [
            ["leg", "rho a", "rho b", "plane angle (rad)"],
            *([str(leg), *map(number, rho), number(angle)] for leg, (rho, angle) in enumerate(rows, 1)),
        ]

    def _summary(self) -> str:
        return f"{len(self.violations)} limits violated"


@dataclass(frozen=True, eq=False)
class Torsion:
    """A torsion, radians, about a direction, and the orientation with it, shape ``(3, 3)``; torsion 0 is the shortest turn there."""

    torsion: float
    rotation: FloatArray


@dataclass(frozen=True, eq=False, repr=False)
class Torsions(Report):
    """The orientations that point a tool's axis in a direction.

    Attributes
    ----------
    status : str
        ``"complete"``; ``"every_torsion"`` where every one serves: the one listed is torsion 0.
    direction : ndarray, shape (3,)
    solutions : tuple of Torsion
        Least torsion first; none means that there are none.
    """

    status: str
    direction: FloatArray
    solutions: tuple[Torsion, ...]

    def __len__(self) -> int:
        return len(self.solutions)

    def __iter__(self) -> Iterator[Torsion]:
        return iter(self.solutions)

    def _title(self) -> str:
        return f"Tool pointed along {numbers(self.direction)}"

    def _table(self) -> list[list[str]]:
        rows = [[number(way.torsion), *map(number, way.rotation.ravel())] for way in self.solutions]
        return [["torsion (rad)", *(f"r{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3))], *rows] if rows else []

    def _summary(self) -> str:
        return _torsions(self.status, len(self))


@dataclass(frozen=True, eq=False)
class PointedWay:
    """A pose that points the tool as asked: its torsion (radians), slider positions, shape ``(6,)``, and the limits that they violate."""

    torsion: float
    pose: TripodPose
    inputs: FloatArray
    plane_angles: FloatArray
    violations: tuple[TripodViolation, ...]


@dataclass(frozen=True, eq=False, repr=False)
class Pointed(Report):
    """The poses at a place that point a tool's axis in a direction; attributes as of :class:`Torsions`."""

    status: str
    position: FloatArray
    direction: FloatArray
    solutions: tuple[PointedWay, ...]

    def __len__(self) -> int:
        return len(self.solutions)

    def __iter__(self) -> Iterator[PointedWay]:
        return iter(self.solutions)

    def _title(self) -> str:
        return f"Tool pointed along {numbers(self.direction)}, platform at {numbers(self.position)}"

    def _table(self) -> list[list[str]]:
        rows = [
            [number(way.torsion), *map(number, way.inputs), str(len(way.violations))] for way in self.solutions
        ]
        return [["torsion (rad)", *(f"rho {k}" for k in range(1, 7)), "limits violated"], *rows] if rows else []

    def _summary(self) -> str:
        return _torsions(self.status, len(self))


def _torsions(status: str, count: int) -> str:
    return "every torsion serves; torsion 0 is shown" if status == "every_torsion" else f"{count} orientations"


@dataclass(frozen=True, eq=False)
class TripodAssembly:
    """One way to put the robot together; ``parallel_axes`` names legs whose planes are not determined: then it is spurious."""

    pose: TripodPose
    multiplicity: int
    residual: float
    parallel_axes: tuple[int, ...]
    proof: str


@dataclass(frozen=True, eq=False, repr=False)
class TripodAssemblies(Report):
    """Every assembly mode for given slider positions, and the solutions of the equations that are none."""

    status: str
    inputs: FloatArray
    modes: tuple[TripodAssembly, ...]
    spurious: tuple[TripodAssembly, ...]
    account: Account

    def __len__(self) -> int:
        return len(self.modes)

    def __iter__(self) -> Iterator[TripodAssembly]:
        return iter(self.modes)

    def _title(self) -> str:
        return f"Three-legged robot, inputs {numbers(self.inputs)}"

    def _table(self) -> list[list[str]]:
        rows = [
            [str(place), *map(number, mode.pose.position), str(mode.multiplicity), f"{mode.residual:.0e}"]
            for place, mode in enumerate(self.modes, 1)
        ]
        return [["mode", "x", "y", "z", "mult.", "residual"], *rows] if rows else []

    def _summary(self) -> str:
        return f"{self.status}; {self.account}"


@dataclass(frozen=True, eq=False, repr=False)
class TripodVelocity(Report):
    """The Jacobian in a pose, ``inputs' = jacobian @ (p', omega)``, and its singularity."""

    pose: TripodPose
    inputs: FloatArray
    jacobian: FloatArray
    columns: str
    det_jacobian: float
    singularity: str
    reading: str
    position_volume: float
    orientation_volume: float
    rates: BothWays | None
    accelerations: BothWays | None

    def _title(self) -> str:
        return "Three-legged robot in motion"

    def _summary(self) -> str:
        return f"singularity: {self.singularity}; {self.reading}; det J {number(self.det_jacobian)}"


@dataclass(frozen=True, eq=False, repr=False)
class Tilt(Report):
    """The largest tilt of the tool that every azimuth allows at a place, radians, and the part of it that is proved."""

    at: FloatArray
    inside: bool
    tilt: float | None
    worst_azimuth: float | None
    limit: str | None
    proved_at_least: float | None

    def _title(self) -> str:
        return f"Tilt at {numbers(self.at)}"

    def _summary(self) -> str:
        if self.tilt is None:
            return "out of limits already in the home orientation"
        proved = "not proved" if self.proved_at_least is None else f"proved {number(self.proved_at_least)} rad"
        return f"largest tilt {number(self.tilt)} rad ({self.limit}), {proved}"


@dataclass(frozen=True, eq=False)
class TiltSection:
    """Tilts at a height, row by row from the lowest corner; NaN out of limits."""

    z: float
    values: FloatArray


@dataclass(frozen=True, eq=False, repr=False)
class TiltMap(Report):
    """The largest tilts over sections of a box, radians."""

    low: FloatArray
    high: FloatArray
    columns: int
    rows: int
    sections: tuple[TiltSection, ...]

    @cached_property
    def grid(self) -> NDArray[np.float64]:
        """All sections, shape ``(sections, rows, columns)``."""
        return np.array([section.values for section in self.sections]).reshape(-1, self.rows, self.columns)

    def plot(self, ax: Axes | None = None, *, section: int = 0) -> Axes:
        """Draws one section; returns the axes, shows nothing."""
        from . import _plot

        return _plot.tilt_section(self, section, ax)

    def _title(self) -> str:
        return f"Tilt over {len(self.sections)} sections"

    def _table(self) -> list[list[str]]:
        rows = []
        for section in self.sections:
            known = section.values[np.isfinite(section.values)]
            ends = [number(known.min()), number(known.max())] if known.size else ["-", "-"]
            rows.append([number(section.z), f"{known.size} of {section.values.size}", *ends])
        return [["z", "places within limits", "least (rad)", "largest (rad)"], *rows]


@dataclass(frozen=True)
class DeterminantPoint:
    """``det J`` at an elevation (radians); none where the Jacobian has a pole (type 1). ``between`` is the angle between two rails."""

    elevation: float
    between: float
    determinant: float | None


@dataclass(frozen=True, eq=False)
class DeterminantCurve:
    """``det J`` over the elevations in one pose."""

    pose: TripodPose
    points: tuple[DeterminantPoint, ...]


@dataclass(frozen=True, eq=False, repr=False)
class DeterminantCurves(Report):
    """``det J`` over the elevations of a design, one curve a pose, in the cube of the unit of length.

    Attributes
    ----------
    design : str
        ``"inclined"`` (rails at the elevation) or ``"upright"`` (platform axes at the elevation).
    d1, d2 : float
        Distances of the two rails of each leg.
    curves : tuple of DeterminantCurve
    """

    design: str
    d1: float
    d2: float
    curves: tuple[DeterminantCurve, ...]

    @cached_property
    def elevations(self) -> FloatArray:
        """The elevations, radians, shape ``(points,)``."""
        found: FloatArray = np.array([point.elevation for point in self.curves[0].points] if self.curves else [])
        read_only(found)
        return found

    @cached_property
    def determinants(self) -> np.ma.MaskedArray[tuple[int, int], np.dtype[np.float64]]:
        """``det J``, shape ``(curves, points)``, masked where the Jacobian has a pole."""
        rows = [[point.determinant for point in curve.points] for curve in self.curves]
        mask = [[value is None for value in row] for row in rows]
        return np.ma.MaskedArray([[value or 0.0 for value in row] for row in rows], mask=mask)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the curves; returns the axes, shows nothing."""
        from . import _plot

        return _plot.determinants(self, ax)

    def _title(self) -> str:
        return f"det J of the {self.design} design, d1 = {number(self.d1)}, d2 = {number(self.d2)}"

    def _table(self) -> list[list[str]]:
        rows = []
        for place, curve in enumerate(self.curves, 1):
            known = [point.determinant for point in curve.points if point.determinant is not None]
            ends = [number(min(known)), number(max(known))] if known else ["-", "-"]
            rows.append([str(place), *ends])
        return [["pose", "least det J", "largest det J"], *rows] if rows else []


class Tripod(Spatial):
    """A three-legged robot on two sliders a leg: six degrees of freedom, less one for each leg with one motor.

    A pose is six numbers, place and rotation vector (axis times angle, radians), or twelve, place and rotation matrix row by row.
    """

    __slots__ = ()
    _compiled = _assur.TripodModel

    def inverse(self, pose: ArrayLike) -> TripodWay:
        """Slider positions for a pose, and the limits that they violate."""
        return result(TripodWay, self._model.inverse(_tripod_pose(pose)), self)

    def forward(self, inputs: ArrayLike, *, certify: bool = False) -> TripodAssemblies:
        """Every assembly mode for given slider positions.

        Parameters
        ----------
        inputs : array_like, shape (6,) or (m,)
            Leg by leg; one for each motor where a leg has one, see :attr:`motors`.
        certify : bool
            Whether solutions are counted exactly, over the integers.

        Raises
        ------
        InputError
            A wrong shape, numbers that are not finite; six in which the sliders of a leg with one motor differ.
        """
        return result(TripodAssemblies, self._model.forward(self._of_motors("inputs", inputs), bool(certify)), self)

    @property
    def motors(self) -> tuple[int, ...]:
        """The sliders, from 1 to 6, with a motor of their own: all but the second of a leg with one motor."""
        return tuple(self._model.motors)

    @property
    def degrees_of_freedom(self) -> int:
        """How many motors there are."""
        return len(self.motors)

    def _of_motors(self, what: str, values: ArrayLike) -> list[float]:
        return vector(what, values, *sorted({self.degrees_of_freedom, 6}))

    def pointing(self, direction: ArrayLike) -> Torsions:
        """The orientations of a robot with five degrees of freedom that point the tool's axis in a direction of the base frame.

        Parameters
        ----------
        direction : array_like, shape (3,)
            Of any length.

        Raises
        ------
        InputError
            A robot with other degrees of freedom; a direction of no length.
        """
        return result(Torsions, self._model.pointing(vector("direction", direction, 3)), self)

    def pointed(self, position: ArrayLike, direction: ArrayLike) -> Pointed:
        """The poses of a robot with five degrees of freedom that point the tool's axis in a direction.

        Parameters
        ----------
        position : array_like, shape (3,)
            Of the platform's origin.
        direction : array_like, shape (3,)
            As :meth:`pointing`.

        Raises
        ------
        InputError
            As :meth:`pointing` and :meth:`inverse`.
        """
        return result(Pointed, self._model.pointed(vector("position", position, 3), vector("direction", direction, 3)), self)

    @overload
    def velocity(
        self, pose: list[float], *, rates: ArrayLike | None = None, accelerations: ArrayLike | None = None
    ) -> TripodVelocity: ...
    @overload
    def velocity(
        self, pose: ArrayLike, *, rates: ArrayLike | None = None, accelerations: ArrayLike | None = None
    ) -> Any: ...
    def velocity(
        self, pose: ArrayLike, *, rates: ArrayLike | None = None, accelerations: ArrayLike | None = None
    ) -> Any:
        """Jacobian, singularity, rates and accelerations in a pose or in many.

        Parameters
        ----------
        pose : array_like, shape (6,), (12,), (n, 6) or (n, 12)
        rates, accelerations : array_like, shape (6,), (m,), (n, 6) or (n, m), optional
            Six of the platform or of the sliders, answered both ways; one for each motor, of the sliders. Angles in radians.
            One row is for all poses.

        Returns
        -------
        TripodVelocity
            For one pose.
        TripodVelocityBatch
            For many: arrays, on all processors. A row that cannot be asked is masked and has its reason in ``errors``.
        """
        given = reals("pose", pose)
        if given.ndim == 2:
            given = rows("pose", given, 12 if given.shape[1] == 12 else 6)
            asked = {
                what: None if one is None else reals(what, one) for what, one in (("rates", rates), ("accelerations", accelerations))
            }
            widths = {what: 6 if one is None or one.shape[-1:] == (6,) else self.degrees_of_freedom for what, one in asked.items()}
            moving_rows = {
                what: np.empty((0, widths[what])) if one is None else spread(what, one, len(given), widths[what])
                for what, one in asked.items()
            }
            batch = self._model.velocity_batch(given, moving_rows["rates"], moving_rows["accelerations"])
            return TripodVelocityBatch._of(given, batch, {what for what, one in asked.items() if one is not None})
        moving = [
            None if values is None else self._of_motors(what, values)
            for what, values in (("rates", rates), ("accelerations", accelerations))
        ]
        return result(TripodVelocity, self._model.velocity(_tripod_pose(pose), *moving), self)

    def tilt(self, at: ArrayLike, *, tolerance: float = TILT_TOLERANCE) -> Tilt:
        """The largest tilt of the tool that every azimuth allows at a place; the proved one is within ``tolerance`` below."""
        return result(Tilt, self._model.tilt(vector("at", at, 3), one_number("tolerance", tolerance)), self)

    def tilt_map(self, low: ArrayLike, high: ArrayLike, *, sections: int = 12, cells: int = 100) -> TiltMap:
        """The largest tilts over sections of a box, evenly over its height."""
        answer = self._model.tilt_map(
            vector("low", low, 3),
            vector("high", high, 3),
            whole("sections", sections, 1, MOST_SECTIONS),
            whole("cells", cells, 1, MOST_CELLS),
        )
        return result(TiltMap, answer, self)

    @staticmethod
    def determinant_curves(
        design: str,
        poses: Sequence[ArrayLike],
        *,
        lower: float = 0.0,
        upper: float = np.pi / 2,
        points: int = 181,
        d1: float = 600.0,
        d2: float = 720.0,
    ) -> DeterminantCurves:
        """``det J`` over the elevation of the rails or of the platform's axes: where a design is best held, and where not at all.

        Parameters
        ----------
        design : {"inclined", "upright"}
            Rails at the elevation, or platform axes at it.
        poses : sequence of array_like
            A curve for each; poses as everywhere in this class.
        lower, upper : float
            First and last elevation, radians.
        points : int
            Elevations, from 2 on.
        d1, d2 : float
            Distances of the first and second rail of each leg.

        Raises
        ------
        InputError
            Another design, numbers that are not finite, equal distances.

        Examples
        --------
        >>> import assur
        >>> curves = assur.Tripod.determinant_curves("inclined", [[0, 0, 0, 0, 0, 0]], points=3)
        >>> bool(curves.determinants[0].argmax() == 1)
        True
        """
        if design not in ("inclined", "upright"):
            raise InputError(f"design: {design!r} must be inclined or upright", field="design", value=design)
        answer = _assur.determinant(
            design,
            [one_number("d1", d1), one_number("d2", d2)],
            [_tripod_pose(pose) for pose in poses],
            [one_number("lower", lower), one_number("upper", upper)],
            whole("points", points, 2, MOST_ELEVATIONS),
        )
        return result(DeterminantCurves, answer)


def _tripod_pose(pose: ArrayLike) -> list[float]:
    return vector("pose", pose, 6, 12)
