"""Tripteron, Quadrupteron and Hexapteron: robots whose sliders move the platform one degree of freedom each. Angles in radians."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from numpy.typing import ArrayLike

from . import _assur
from ._arrays import FloatArray, vector
from ._report import Report, number, numbers, result
from ._spatial import Spatial
from .modes import Account
from .tripod import TripodPose

__all__ = ["Multipteron", "MultipteronInputs", "MultipteronMode", "MultipteronPoses"]


@dataclass(frozen=True, eq=False)
class MultipteronMode:
    """One way to put a Multipteron together."""

    pose: TripodPose


@dataclass(frozen=True, eq=False, repr=False)
class MultipteronPoses(Report):
    """Every pose for given slider positions; the account sums to the degree, 1, 2 or 8."""

    kind: str
    inputs: FloatArray
    modes: tuple[MultipteronMode, ...]
    account: Account

    def __len__(self) -> int:
        return len(self.modes)

    def __iter__(self) -> Iterator[MultipteronMode]:
        return iter(self.modes)

    def _title(self) -> str:
        return f"{self.kind.capitalize()}, inputs {numbers(self.inputs)}"

    def _table(self) -> list[list[str]]:
        rows = [
            [str(place), *map(number, mode.pose.position), *(numbers(row) for row in mode.pose.rotation.reshape(-1, 3))]
            for place, mode in enumerate(self.modes, 1)
        ]
        return [["mode", "x", "y", "z", "rotation, row 1", "row 2", "row 3"], *rows] if rows else []

    def _summary(self) -> str:
        return str(self.account)


@dataclass(frozen=True, eq=False, repr=False)
class MultipteronInputs(Report):
    """The slider positions for a pose: a place and a rotation vector."""

    kind: str
    position: FloatArray
    rotation_vector: FloatArray
    inputs: FloatArray

    def _title(self) -> str:
        return f"{self.kind.capitalize()} in place {numbers(self.position)}, turned by {numbers(self.rotation_vector)}"

    def _summary(self) -> str:
        return f"inputs {numbers(self.inputs)}"


class Multipteron(Spatial):
    """Tripteron, Quadrupteron or Hexapteron; the Pentapteron is not covered.

    A pose is three numbers, the place, or six, place and rotation vector (axis times angle, radians).

    Examples
    --------
    >>> import assur
    >>> axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
    >>> robot = assur.Multipteron.from_dict({"schema": "assur/multipteron/1", "kind": "tripteron", "directions": axes})
    >>> robot.inverse([1, 2, 3]).inputs
    array([1., 2., 3.])
    """

    __slots__ = ()
    _compiled = _assur.MultipteronModel

    @property
    def kind(self) -> str:
        """``"tripteron"``, ``"quadrupteron"`` or ``"hexapteron"``."""
        kind: str = self._model.kind
        return kind

    @property
    def degrees_of_freedom(self) -> int:
        """How many sliders there are: 3, 4 or 6."""
        count: int = self._model.degrees_of_freedom
        return count

    def forward(self, inputs: ArrayLike) -> MultipteronPoses:
        """Every pose for slider positions.

        Parameters
        ----------
        inputs : array_like, shape (degrees_of_freedom,)

        Raises
        ------
        InputError
            A wrong shape; numbers that are not finite.
        """
        return result(MultipteronPoses, self._model.forward(vector("inputs", inputs, self.degrees_of_freedom)), self)

    def inverse(self, pose: ArrayLike) -> MultipteronInputs:
        """The slider positions for a pose.

        Parameters
        ----------
        pose : array_like, shape (3,) or (6,)
            Place, and rotation vector where the robot turns.

        Raises
        ------
        InputError
            A wrong shape; a rotation that the robot cannot make.
        """
        given = vector("pose", pose, 3, 6)
        return result(MultipteronInputs, self._model.inverse(given[:3], (given[3:] or [0.0, 0.0, 0.0])), self)
