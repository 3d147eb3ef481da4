"""Three-legged robots of six degrees of freedom. Angles in radians."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _assur
from ._arrays import FloatArray, number as one_number, optional_vector, read_only, vector, whole
from ._report import Report, number, numbers, result
from ._spatial import MOST_CELLS, MOST_SECTIONS, Spatial
from .errors import InputError
from .modes import Account
from .motion import BothWays

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = [
    "DeterminantCurve",
    "DeterminantCurves",
    "DeterminantPoint",
    "Tilt",
    "TiltMap",
    "TiltSection",
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
    """A three-legged robot of six degrees of freedom; ``legs`` on two sliders each.

    A pose is six numbers, place and rotation vector (axis times angle, radians), or twelve, place and rotation matrix row by row.
    """

    __slots__ = ()
    _compiled = _assur.TripodModel

    def inverse(self, pose: ArrayLike) -> TripodWay:
        """Slider positions for a pose, and the limits that they violate."""
        return result(TripodWay, self._model.inverse(_tripod_pose(pose)), self)

    def forward(self, inputs: ArrayLike, *, certify: bool = False) -> TripodAssemblies:
        """Every assembly mode for six slider positions, leg by leg; with ``certify`` counted exactly, over the integers."""
        return result(TripodAssemblies, self._model.forward(vector("inputs", inputs, 6), bool(certify)), self)

    def velocity(
        self, pose: ArrayLike, *, rates: ArrayLike | None = None, accelerations: ArrayLike | None = None
    ) -> TripodVelocity:
        """Jacobian, singularity, rates and accelerations in a pose, the last two answered both ways."""
        answer = self._model.velocity(
            _tripod_pose(pose), optional_vector("rates", rates, 6), optional_vector("accelerations", accelerations, 6)
        )
        return result(TripodVelocity, answer, self)

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
