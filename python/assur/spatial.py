"""The two spatial robots: HANA, and the three-legged robots of six degrees of freedom. Angles in radians."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _assur
from ._arrays import FloatArray, number as one_number, optional_vector, vector
from ._problems import Problem
from ._report import Report, number, numbers, result
from .errors import InputError
from .modes import Account
from .motion import BothWays

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = [
    "Arc",
    "ArcLoop",
    "ArcRegion",
    "Hana",
    "HanaAssemblies",
    "HanaMode",
    "HanaTilts",
    "HanaVelocity",
    "HanaWay",
    "HanaWays",
    "MixedReach",
    "MixedSingularity",
    "SliderViolation",
    "SpatialSelfMotion",
    "StrokeTilt",
    "Supremum",
    "Tilt",
    "TiltMap",
    "TiltSection",
    "TiltWindow",
    "Tripod",
    "TripodAssemblies",
    "TripodAssembly",
    "TripodPose",
    "TripodVelocity",
    "TripodViolation",
    "TripodWay",
]

#: Cells of a map along each side where nothing else is said, as on the command line.
CELLS = 120
#: Tolerance of the proved tilt where nothing else is said, radians, as on the command line.
TILT_TOLERANCE = 1e-3
#: Most cells along a side, and most sections, of a map.
MOST_CELLS, MOST_SECTIONS = 2000, 100


@dataclass(frozen=True, eq=False)
class SliderViolation:
    """A slider outside its stroke."""

    leg: int
    value: float
    limit: FloatArray


@dataclass(frozen=True, eq=False)
class HanaWay:
    """One working mode: signs (+ for a slider above its joint) and slider heights, shape ``(3,)``."""

    signs: str
    inputs: FloatArray
    violations: tuple[SliderViolation, ...]


@dataclass(frozen=True)
class Unreachable:
    """A leg that does not reach the pose, and by how much it misses, a length."""

    leg: int
    miss: float


@dataclass(frozen=True, eq=False)
class MixedSingularity:
    """Heights of sliders 1 and 2 for which their links are stretched or folded into one line, at an orientation."""

    kind: str
    phi: float
    inputs: FloatArray
    within_strokes: bool


@dataclass(frozen=True)
class MixedReach:
    """Whether the strokes reach a mixed-mode singularity: ``"nowhere"``, ``"somewhere"`` or ``"touched"``, and where."""

    reached: str
    y: float | None
    z: float | None


@dataclass(frozen=True, eq=False, repr=False)
class HanaWays(Report):
    """Every working mode of a pose ``y, z, phi`` of HANA, and the mixed-mode singularities at its place."""

    pose: FloatArray
    modes: tuple[HanaWay, ...]
    unreachable_legs: tuple[Unreachable, ...]
    merged_legs: tuple[int, ...]
    mixed_singularities_here: tuple[MixedSingularity, ...]
    mixed_singularities: MixedReach

    def __len__(self) -> int:
        return len(self.modes)

    def __iter__(self) -> Iterator[HanaWay]:
        return iter(self.modes)

    def _title(self) -> str:
        return f"Working modes of HANA in pose {numbers(self.pose)}"

    def _table(self) -> list[list[str]]:
        rows = [[way.signs, *map(number, way.inputs)] for way in self.modes]
        return [["mode", "z1", "z2", "z3"], *rows] if rows else []

    def _summary(self) -> str:
        missing = [f"leg {leg.leg} misses by {number(leg.miss)}" for leg in self.unreachable_legs]
        return "; ".join([f"{len(self.modes)} working modes", *missing])


@dataclass(frozen=True, eq=False)
class HanaMode:
    """One way to put HANA together: ``y, z, phi``, signs, and the family its square roots come from."""

    pose: FloatArray
    signs: str
    family: str
    multiplicity: int
    residual: float


@dataclass(frozen=True)
class SpatialSelfMotion:
    """An orientation with a whole circle of poses."""

    phi: float


@dataclass(frozen=True, eq=False, repr=False)
class HanaAssemblies(Report):
    """Every assembly mode for given slider heights; the count is exact."""

    status: str
    inputs: FloatArray
    modes: tuple[HanaMode, ...]
    account: Account
    self_motions: tuple[SpatialSelfMotion, ...]
    violations: tuple[SliderViolation, ...]

    def __len__(self) -> int:
        return len(self.modes)

    def __iter__(self) -> Iterator[HanaMode]:
        return iter(self.modes)

    def _title(self) -> str:
        return f"HANA, inputs {numbers(self.inputs)}"

    def _table(self) -> list[list[str]]:
        rows = [
            [str(place), *map(number, mode.pose), mode.signs, mode.family, str(mode.multiplicity), f"{mode.residual:.0e}"]
            for place, mode in enumerate(self.modes, 1)
        ]
        return [["mode", "y", "z", "phi (rad)", "signs", "family", "mult.", "residual"], *rows] if rows else []

    def _summary(self) -> str:
        return f"{self.status}; {self.account}"


@dataclass(frozen=True, eq=False, repr=False)
class HanaVelocity(Report):
    """The matrices of HANA in a pose, ``pose_matrix @ pose' + input_matrix @ inputs' = 0``, and its singularity."""

    pose: FloatArray
    signs: str
    inputs: FloatArray
    pose_matrix: FloatArray
    input_matrix: FloatArray
    row_scaling: str
    det_pose: float
    det_input: float
    singularity: str
    legs: tuple[int, ...]
    reading: tuple[str, ...]
    sigma_min: float
    sigma_min_input: float
    dexterity: float
    rates: BothWays | None
    accelerations: BothWays | None

    def _title(self) -> str:
        return f"HANA, mode {self.signs} in pose {numbers(self.pose)}"

    def _summary(self) -> str:
        return f"singularity: {self.singularity}; dexterity {number(self.dexterity)}"


@dataclass(frozen=True, eq=False)
class Arc:
    """A piece of boundary.

    Attributes
    ----------
    curve : str
        ``"line"``, ``"circle"``, or one of the curves on which legs 1 and 2 end level or over all orientations.
    start, end : ndarray, shape (2,)
    length : float
    active : tuple of str
        The limits reached on it.
    center, radius, start_angle, end_angle
        Of a circle.
    height, L, factors
        Of the other curves: ``(z - height)**2 = (a0 + a1 l) (b0 + b1 l)`` with ``l = sqrt(L**2 - y**2)``.
    """

    curve: str
    start: FloatArray
    end: FloatArray
    length: float
    active: tuple[str, ...]
    center: FloatArray | None
    radius: float | None
    start_angle: float | None
    end_angle: float | None
    height: float | None
    L: float | None
    factors: FloatArray | None


@dataclass(frozen=True, eq=False)
class ArcLoop:
    """A closed boundary, region on its left."""

    area: float
    arcs: tuple[Arc, ...]


@dataclass(frozen=True, eq=False, repr=False)
class ArcRegion(Report):
    """A workspace of HANA in the plane ``(y, z)``, as exact arcs."""

    kind: str
    status: str
    area: float
    perimeter: float
    centroid: FloatArray | None
    bbox: FloatArray | None
    components: int
    holes: int
    loops: tuple[ArcLoop, ...]

    def outlines(self, points: int = 64) -> list[list[NDArray[np.float64]]]:
        """``points`` points along each piece of each loop, ends included; each of shape ``(points, 2)``."""
        robot, question = self._origin
        loops = robot._model.outlines(*question, points)
        return [[np.asarray(piece).reshape(-1, 2) for piece in loop] for loop in loops]

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the region; returns the axes, shows nothing."""
        from . import _plot

        return _plot.arcs(self, ax)

    def _title(self) -> str:
        return f"{self.kind} workspace of HANA"

    def _summary(self) -> str:
        return f"area {number(self.area)}, perimeter {number(self.perimeter)}, {self.components} components"


@dataclass(frozen=True, eq=False)
class Supremum:
    """The largest capability (radians), where, and whether it is had or only approached."""

    zeta: float
    at: FloatArray
    attained: bool


@dataclass(frozen=True, eq=False)
class TiltWindow:
    """Capabilities over ``window = (ymin, zmin, ymax, zmax)``, row by row from below; NaN outside the workspace."""

    window: FloatArray
    columns: int
    rows: int
    values: FloatArray

    @property
    def grid(self) -> FloatArray:
        """The values, shape ``(rows, columns)``, lowest row first."""
        return self.values.reshape(self.rows, self.columns)


@dataclass(frozen=True)
class StrokeTilt:
    """The largest capability for strokes of a half length; none where the workspace is empty."""

    half_stroke: float
    zeta: float | None


@dataclass(frozen=True, eq=False, repr=False)
class HanaTilts(Report):
    """How far HANA's platform tilts.

    Attributes
    ----------
    supremum : Supremum or None
        Over the workspace of ``phi = 0``; none where that is empty.
    at : ndarray, shape (2,), or None
        The place asked about, and there ``inside``, ``zeta`` (radians), the ``range`` of tilts and what ends it, ``limits``.
    map : TiltWindow or None
    against_strokes : tuple of StrokeTilt or None
    """

    supremum: Supremum | None
    at: FloatArray | None
    inside: bool | None
    zeta: float | None
    range: FloatArray | None
    limits: tuple[str, ...] | None
    map: TiltWindow | None
    against_strokes: tuple[StrokeTilt, ...] | None

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the map; returns the axes, shows nothing."""
        from . import _plot

        return _plot.tilts(self, ax)

    def _title(self) -> str:
        return "Rotational capability of HANA"

    def _summary(self) -> str:
        here = "" if self.zeta is None or self.at is None else f"at {numbers(self.at)}: {number(self.zeta)} rad; "
        best = "empty workspace" if self.supremum is None else f"largest {number(self.supremum.zeta)} rad"
        return here + best


class _Spatial:
    """What the two robots have in common: they come from files or mappings, and never change."""

    __slots__ = ("_problem",)
    _problem: Problem

    def to_dict(self) -> dict[str, Any]:
        """The model as a mapping with the keys of its file."""
        return self._problem.document()

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Spatial) and type(other) is type(self) and self._problem == other._problem

    def __hash__(self) -> int:
        return hash(self._problem)


class Hana(_Spatial):
    """HANA, a spatial robot with two translations and a rotation; a pose is ``y, z, phi``, radians.

    Examples
    --------
    >>> import assur
    >>> model = {"schema": "assur/hana/1", "r": 3, "R": 12, "L": 15, "L3": 15, "strokes": [-3, 3]}
    >>> len(assur.Hana.from_dict(model).inverse([-2, -12, 0.3]))
    8
    """

    __slots__ = ("_model",)

    def __init__(self, problem: Problem) -> None:
        self._problem = problem
        self._model = _assur.HanaModel.parse(problem.text, problem.name)

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Hana:
        """The robot in a model file, schema ``assur/hana/1``."""
        return cls(Problem.of(path))

    @classmethod
    def from_dict(cls, model: Mapping[str, Any]) -> Hana:
        """The robot in a mapping with the keys of a model file."""
        return cls(Problem.of(dict(model)))

    @property
    def name(self) -> str:
        """The name for people."""
        return self._model.name

    def __repr__(self) -> str:
        return f"Hana({self.name!r})"

    def __reduce__(self) -> tuple[Any, ...]:
        return Hana, (self._problem,)

    def inverse(self, pose: ArrayLike) -> HanaWays:
        """Every working mode of a pose ``y, z, phi``."""
        return result(HanaWays, self._model.inverse(vector("pose", pose, 3)), self)

    def forward(self, inputs: ArrayLike) -> HanaAssemblies:
        """Every assembly mode for slider heights ``z1, z2, z3``."""
        return result(HanaAssemblies, self._model.forward(vector("inputs", inputs, 3)), self)

    def velocity(
        self,
        pose: ArrayLike,
        mode: str = "+++",
        *,
        rates: ArrayLike | None = None,
        accelerations: ArrayLike | None = None,
    ) -> HanaVelocity:
        """Matrices, singularity, rates and accelerations in a pose, the last two answered both ways."""
        answer = self._model.velocity(
            vector("pose", pose, 3),
            mode,
            optional_vector("rates", rates, 3),
            optional_vector("accelerations", accelerations, 3),
        )
        return result(HanaVelocity, answer, self)

    def workspace(
        self,
        kind: str = "reachable",
        *,
        phi: float = 0.0,
        between: ArrayLike | None = None,
        mode: str = "+++",
    ) -> ArcRegion:
        """The places of the platform's centre.

        Parameters
        ----------
        kind : {"constant", "reachable"}
            For the orientation ``phi``, or over a range of orientations.
        phi : float
            Of ``"constant"``, radians.
        between : array_like, shape (2,), optional
            Of ``"reachable"``: first and last orientation, counter-clockwise, radians; between the quarter turns without it.
        mode : str
            The working mode.
        """
        if kind not in ("constant", "reachable"):
            raise InputError(f"kind: {kind!r} must be constant or reachable", field="kind", value=kind)
        constant = kind == "constant"
        if constant and between is not None:
            raise InputError("between: goes with the kind reachable", field="between", value=between)
        question = (one_number("phi", phi) if constant else None, optional_vector("between", between, 2), mode)
        return result(ArcRegion, self._model.workspace(*question), (self, question))

    def capability(
        self,
        at: ArrayLike | None = None,
        *,
        mode: str = "+++",
        strokes: ArrayLike = (),
        cells: int | None = None,
    ) -> HanaTilts:
        """How far the platform tilts: at a place, at most, over the workspace, against strokes.

        Parameters
        ----------
        at : array_like, shape (2,), optional
            A place ``y, z``.
        mode : str
            The working mode.
        strokes : array_like, shape (n,)
            Half lengths of all strokes for which the supremum is given too.
        cells : int, optional
            Cells of a map along each side; without it a map is made where no place is given, with 120.
        """
        place = optional_vector("at", at, 2)
        cells = CELLS if cells is None and place is None else cells
        halves = [one_number("strokes", value) for value in np.atleast_1d(np.asarray(strokes, dtype=object)).ravel()]
        size = None if cells is None else _count("cells", cells, MOST_CELLS)
        return result(HanaTilts, self._model.capability(place, mode, halves, size), self)


def _count(what: str, value: int, most: int) -> int:
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or not 1 <= value <= most:
        raise InputError(f"{what}: {value!r} must be a whole number from 1 to {most}", field=what, value=value)
    return int(value)


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


class Tripod(_Spatial):
    """A three-legged robot of six degrees of freedom; ``legs`` on two sliders each.

    A pose is six numbers, place and rotation vector (axis times angle, radians), or twelve, place and rotation matrix row by row.
    """

    __slots__ = ("_model",)

    def __init__(self, problem: Problem) -> None:
        self._problem = problem
        self._model = _assur.TripodModel.parse(problem.text, problem.name)

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Tripod:
        """The robot in a model file, schema ``assur/tripod/1``."""
        return cls(Problem.of(path))

    @classmethod
    def from_dict(cls, model: Mapping[str, Any]) -> Tripod:
        """The robot in a mapping with the keys of a model file."""
        return cls(Problem.of(dict(model)))

    @property
    def name(self) -> str:
        """The name for people."""
        return self._model.name

    def __repr__(self) -> str:
        return f"Tripod({self.name!r})"

    def __reduce__(self) -> tuple[Any, ...]:
        return Tripod, (self._problem,)

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
            _count("sections", sections, MOST_SECTIONS),
            _count("cells", cells, MOST_CELLS),
        )
        return result(TiltMap, answer, self)


def _tripod_pose(pose: ArrayLike) -> list[float]:
    size = np.size(pose)
    return vector("pose", pose, 12 if size == 12 else 6)
