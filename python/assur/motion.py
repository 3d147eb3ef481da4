"""Answers about a pose: its working modes, its matrices, its motion."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ._arrays import FloatArray
from ._report import Report, number, numbers
from .modes import Violation

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["BothWays", "Held", "InverseSpecial", "Reading", "UnreachableLeg", "Velocity", "WorkingMode", "WorkingModes"]


@dataclass(frozen=True, eq=False)
class WorkingMode:
    """One way for the legs to reach a pose.

    Attributes
    ----------
    signs : str
        One sign a leg; + is the larger value of the prismatic joint in which its two ways differ, for RRR link 1 x link 2 > 0.
    joints : ndarray, shape (legs, 3)
        Joint values, leg by leg, base first; radians or lengths.
    violations : tuple of Violation
        Limits that the mode violates.
    """

    signs: str
    joints: FloatArray
    violations: tuple[Violation, ...]


@dataclass(frozen=True)
class UnreachableLeg:
    """A leg that does not reach the pose, and by how much it misses, a length."""

    leg: int
    miss: float


@dataclass(frozen=True)
class InverseSpecial:
    """What is special about a leg on the way back from a pose."""

    name: str
    leg: int
    text: str


@dataclass(frozen=True, eq=False, repr=False)
class WorkingModes(Report):
    """Every working mode of a pose.

    Attributes
    ----------
    pose : ndarray, shape (3,)
        ``x, y, phi``.
    modes : tuple of WorkingMode
        None where a leg does not reach.
    unreachable_legs : tuple of UnreachableLeg
        Legs that do not reach the pose.
    special : tuple of InverseSpecial
        Merged ways, free pivots, shared travel.
    """

    pose: FloatArray
    modes: tuple[WorkingMode, ...]
    unreachable_legs: tuple[UnreachableLeg, ...]
    special: tuple[InverseSpecial, ...]

    def __len__(self) -> int:
        return len(self.modes)

    def __iter__(self) -> Iterator[WorkingMode]:
        return iter(self.modes)

    def __getitem__(self, place: int) -> WorkingMode:
        return self.modes[place]

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws all working modes over one another, each in a colour of its own; returns the axes, shows nothing."""
        from . import _plot

        return _plot.working_modes(self, ax)

    def _title(self) -> str:
        return f"Working modes of pose {numbers(self.pose)}"

    def _table(self) -> list[list[str]]:
        if not self.modes:
            return []
        legs = [f"leg {leg}: q1, q2, q3" for leg in range(1, len(self.modes[0].joints) + 1)]
        rows = [
            [mode.signs, *(numbers(leg) for leg in mode.joints), "violated" if mode.violations else "within"]
            for mode in self.modes
        ]
        return [["mode", *legs, "limits"], *rows]

    def _summary(self) -> str:
        missing = [f"leg {leg.leg} does not reach: it misses by {number(leg.miss)}" for leg in self.unreachable_legs]
        return "; ".join([f"{len(self.modes)} working modes", *missing, *(special.text for special in self.special)])


@dataclass(frozen=True, eq=False)
class Reading:
    """How the legs' lines of force lie in a singularity: they ``"meet"``, are ``"parallel"``, or are ``"one line"``."""

    kind: str
    point: FloatArray | None
    direction: FloatArray | None


class _Answered:
    """Answers that a singularity, or a leg with one motor, may leave out: a report has the reason in their place."""

    @staticmethod
    def _prepared(document: Mapping[str, Any]) -> dict[str, Any]:
        missing = [reason for value in document.values() if isinstance(value, Mapping) for reason in value.values()]
        if "pose_refused" in document:
            missing.append(document["pose_refused"])
        found = {key: None if isinstance(value, Mapping) else value for key, value in document.items()}
        return {**found, "reasons": missing}


@dataclass(frozen=True, eq=False)
class BothWays(_Answered):
    """Rates or accelerations, answered both ways; none where a singularity leaves no answer, with the reason beside it.

    Attributes
    ----------
    given : ndarray, shape (3,)
        What was asked about.
    inputs_if_pose : ndarray, shape (3,), or None
        The actuators', if what is given is the platform's.
    pose_if_inputs : ndarray, shape (3,), or None
        The platform's, if what is given is the actuators'.
    reasons : tuple of str
        Why an answer is missing.
    """

    given: FloatArray
    inputs_if_pose: FloatArray | None
    pose_if_inputs: FloatArray | None
    reasons: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Held(_Answered):
    """The actuator forces that hold a wrench ``(fx, fy, m)``; none in a singularity, with the reason."""

    given: FloatArray
    actuator_forces: FloatArray | None
    reasons: tuple[str, ...]


@dataclass(frozen=True, eq=False, repr=False)
class Velocity(Report):
    """The matrices of a pose, ``pose_matrix @ pose' + input_matrix @ inputs' = 0``, and its singularity.

    Attributes
    ----------
    pose : ndarray, shape (3,)
    signs : str
        The working mode; ``mode_choice`` says why this one.
    joints : ndarray, shape (legs, 3)
    pose_matrix, input_matrix : ndarray, shape (3, 3)
        Rows belong to ``row_legs``; ``row_scaling`` says how they are scaled.
    det_pose, det_input : float
    singularity : str
        ``"none"``, ``"type 1"``, ``"type 2"``, ``"type 3"`` or ``"self-motion"``, with the ``legs`` and the ``reading``.
    free_motion : ndarray, shape (3,), or None
        How the platform moves with the actuators held, in a singularity of type 2.
    sigma_min, sigma_min_input : float
        Smallest singular values; ``scaling`` says of what.
    singular_values : ndarray, shape (3,)
    scaled_pose_matrix : ndarray, shape (3, 3)
    dexterity : float
        Smallest over largest singular value of the map from inputs to pose, angles times ``characteristic_length``.
    rates, accelerations : BothWays or None
    wrench : Held or None
    """

    pose: FloatArray
    signs: str
    mode_choice: str
    joints: FloatArray
    pose_matrix: FloatArray
    input_matrix: FloatArray
    row_legs: tuple[int, ...]
    row_scaling: str
    det_pose: float
    det_input: float
    singularity: str
    legs: tuple[int, ...]
    idle_legs: tuple[int, ...]
    reading: Reading | None
    free_motion: FloatArray | None
    sigma_min: float
    sigma_min_input: float
    singular_values: FloatArray
    scaled_pose_matrix: FloatArray
    dexterity: float
    characteristic_length: float
    scaling: dict[str, str]
    rates: BothWays | None
    accelerations: BothWays | None
    wrench: Held | None

    def _title(self) -> str:
        return f"Mode {self.signs} ({self.mode_choice}) in pose {numbers(self.pose)}"

    def _table(self) -> list[list[str]]:
        rows = zip(self.row_legs, self.pose_matrix, self.input_matrix, strict=True)
        cells = [[str(leg), *map(number, a), *map(number, b)] for leg, a, b in rows]
        return [["leg", "A: x'", "y'", "phi'", "B: 1", "2", "3"], *cells]

    def _summary(self) -> str:
        return f"singularity: {self.singularity}; dexterity {number(self.dexterity)}, least singular value {number(self.sigma_min)}"
