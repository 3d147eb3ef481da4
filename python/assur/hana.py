"""HANA, a spatial robot with two translations and a rotation. Angles in radians."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _assur
from ._arrays import MOST_POINTS, FloatArray, number as one_number, one_or_rows, optional_vector, spread, vector, whole
from ._report import Report, counted, number, numbers, result
from ._spatial import MOST_CELLS, Spatial
from ._spatial_batch import HanaVelocityBatch
from .errors import InputError
from .modes import Account
from .motion import BothWays, UnreachableLeg

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
    "TiltWindow",
]

#: Cells of a map along each side where nothing else is said, as on the command line.
CELLS = 120


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
    unreachable_legs: tuple[UnreachableLeg, ...]
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
        loops = robot._model.outlines(*question, whole("points", points, 2, MOST_POINTS))
        return [[np.asarray(piece).reshape(-1, 2) for piece in loop] for loop in loops]

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the region; returns the axes, shows nothing."""
        from . import _plot

        return _plot.arcs(self, ax)

    def _title(self) -> str:
        return f"{self.kind} workspace of HANA"

    def _summary(self) -> str:
        return f"area {number(self.area)}, perimeter {number(self.perimeter)}, {counted(self.components, 'component')}"


@dataclass(frozen=True, eq=False)
class Supremum:
    """The largest capability (radians), where, whether it is had or only approached, and a bound shown for every place."""

    zeta: float
    at: FloatArray
    attained: bool
    at_most: float


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
        """Draws the map, and the exact boundary over it; returns the axes, shows nothing."""
        from . import _plot

        return _plot.tilts(self, ax)

    def _title(self) -> str:
        return "Rotational capability of HANA"

    def _summary(self) -> str:
        here = "" if self.zeta is None or self.at is None else f"at {numbers(self.at)}: {number(self.zeta)} rad; "
        best = "empty workspace" if self.supremum is None else f"largest {number(self.supremum.zeta)} rad"
        return here + best


class Hana(Spatial):
    """HANA, a spatial robot with two translations and a rotation; a pose is ``y, z, phi``, radians.

    Examples
    --------
    >>> import assur
    >>> model = {"schema": "assur/hana/1", "r": 3, "R": 12, "L": 15, "L3": 15, "strokes": [-3, 3]}
    >>> len(assur.Hana.from_dict(model).inverse([-2, -12, 0.3]))
    8
    """

    __slots__ = ()
    _compiled = _assur.HanaModel

    def inverse(self, pose: ArrayLike) -> HanaWays:
        """Every working mode of a pose ``y, z, phi``."""
        return result(HanaWays, self._model.inverse(vector("pose", pose, 3)), self)

    def forward(self, inputs: ArrayLike) -> HanaAssemblies:
        """Every assembly mode for slider heights ``z1, z2, z3``."""
        return result(HanaAssemblies, self._model.forward(vector("inputs", inputs, 3)), self)

    @overload
    def velocity(
        self,
        pose: list[float] | tuple[float, float, float],
        mode: str = "+++",
        *,
        rates: ArrayLike | None = None,
        accelerations: ArrayLike | None = None,
    ) -> HanaVelocity: ...
    @overload
    def velocity(
        self,
        pose: ArrayLike,
        mode: str = "+++",
        *,
        rates: ArrayLike | None = None,
        accelerations: ArrayLike | None = None,
    ) -> Any: ...
    def velocity(
        self,
        pose: ArrayLike,
        mode: str = "+++",
        *,
        rates: ArrayLike | None = None,
        accelerations: ArrayLike | None = None,
    ) -> Any:
        """Matrices, singularity, rates and accelerations in a pose or in many, the last two answered both ways.

        Parameters
        ----------
        pose : array_like, shape (3,) or (n, 3)
            ``y, z, phi``, radians.
        mode : str
            The working mode.
        rates, accelerations : array_like, shape (3,) or (n, 3), optional
            Of the platform or of the sliders; one row is for all poses.

        Returns
        -------
        HanaVelocity
            For one pose.
        HanaVelocityBatch
            For ``(n, 3)``: arrays, on all processors. A row that cannot be asked is masked and has its reason in ``errors``.
        """
        given = one_or_rows("pose", pose, 3)
        if not isinstance(given, list):
            asked = {"rates": rates, "accelerations": accelerations}
            moving = {what: np.empty((0, 3)) if one is None else spread(what, one, len(given), 3) for what, one in asked.items()}
            batch = self._model.velocity_batch(given, mode, moving["rates"], moving["accelerations"])
            return HanaVelocityBatch._of(given, batch, {what for what, one in asked.items() if one is not None})
        answer = self._model.velocity(
            given,
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
        size = None if cells is None else whole("cells", cells, 1, MOST_CELLS)
        return result(HanaTilts, self._model.capability(place, mode, halves, size), (self, mode))
