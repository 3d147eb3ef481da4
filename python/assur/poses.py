"""Answers about many poses at once: working modes, and matrices with their singularities."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from . import _assur
from ._arrays import FloatArray, read_only
from ._batch import Batch, RowErrors
from .errors import InputError

__all__ = ["SINGULARITIES", "MaskedFloats", "VelocityBatch", "WorkingModesBatch"]

MaskedFloats: TypeAlias = "np.ma.MaskedArray[Any, np.dtype[np.float64]]"

#: Codes of :attr:`WorkingModesBatch._found`.
_ABSENT, _WITHIN = 0, 1
#: Names of the codes of :attr:`VelocityBatch.singularities`.
SINGULARITIES = ("none", "type 1", "type 2", "type 3", "self-motion", "error")


def _masked(values: FloatArray, mask: NDArray[np.bool_]) -> MaskedFloats:
    """Values with a mask over their first axes."""
    spread = mask.reshape(mask.shape + (1,) * (values.ndim - mask.ndim))
    return np.ma.MaskedArray(values, mask=np.broadcast_to(spread, values.shape))


@dataclass(frozen=True, eq=False, repr=False)
class WorkingModesBatch(Batch):
    """Every working mode of many poses; each mode has a place of its own, so that it is one column over all rows.

    A row that cannot be asked (not finite) is masked throughout and has its reason in ``errors``. Results do not depend on how many threads
    there are.

    Attributes
    ----------
    poses : ndarray, shape (n, 3)
        The rows: the caller's own array where no conversion was needed.
    signs : tuple of str, length m
        The names of the modes: ``"+++"`` first.
    mask : ndarray of bool, shape (n, m)
        True where a row has no such mode. Where the two ways of a leg have merged, the one mode is written +.
    within : ndarray of bool, shape (n, m)
        Whether the mode is there and violates no limit.
    joints : masked array, shape (n, m, legs, 3)
        Joint values, leg by leg, base first; radians or lengths.
    inputs : masked array, shape (n, m, 3)
        The actuated ones of them, as :meth:`Manipulator.forward` takes them.
    counts : ndarray of int, shape (n,)
        How many modes each row has.
    misses : ndarray, shape (n, legs)
        By how much each leg misses the pose, a length; zero where it reaches.
    errors : mapping from row to InputError
        Rows that could not be asked.
    """

    poses: FloatArray
    signs: tuple[str, ...]
    misses: FloatArray
    errors: RowErrors
    _joints: FloatArray = field(repr=False)
    _found: NDArray[np.uint8] = field(repr=False)
    _actuated: NDArray[np.bool_] = field(repr=False)

    @classmethod
    def _of(cls, poses: FloatArray, batch: _assur.WaysBatch, actuated: NDArray[np.bool_]) -> WorkingModesBatch:
        for array in (batch.joints, batch.found, batch.misses):
            read_only(array)
        return cls(poses, tuple(batch.names), batch.misses, RowErrors(batch.errors), batch.joints, batch.found, actuated)

    @cached_property
    def mask(self) -> NDArray[np.bool_]:
        """True where a row has no such mode, shape ``(n, m)``."""
        mask: NDArray[np.bool_] = self._found == _ABSENT
        read_only(mask)
        return mask

    @cached_property
    def within(self) -> NDArray[np.bool_]:
        """Whether the mode is there and violates no limit, shape ``(n, m)``."""
        within: NDArray[np.bool_] = self._found == _WITHIN
        read_only(within)
        return within

    @cached_property
    def counts(self) -> NDArray[np.int64]:
        """How many modes each row has, shape ``(n,)``."""
        counts: NDArray[np.int64] = np.count_nonzero(self._found, axis=1).astype(np.int64)
        read_only(counts)
        return counts

    @cached_property
    def joints(self) -> MaskedFloats:
        """Joint values, shape ``(n, m, legs, 3)``."""
        return _masked(self._joints, self.mask)

    @cached_property
    def inputs(self) -> MaskedFloats:
        """The actuated ones of the joint values, shape ``(n, m, 3)``."""
        return _masked(self._joints[:, :, self._actuated], self.mask)

    def __len__(self) -> int:
        return len(self.poses)

    def place(self, signs: str) -> int:
        """The place of a mode: ``batch.inputs[:, batch.place("+-+")]`` has the inputs of one mode in every row.

        Raises
        ------
        InputError
            A name that no mode has.
        """
        if signs not in self.signs:
            raise InputError(f"mode: {signs!r} must be one of {', '.join(self.signs)}", field="mode", value=signs)
        return self.signs.index(signs)

    def _title(self) -> str:
        return f"Working modes of {len(self)} poses"

    def _table(self) -> list[list[str]]:
        there, within = len(self) - self.mask.sum(axis=0), self.within.sum(axis=0)
        return [["mode", "rows", "within limits"], *([s, str(a), str(b)] for s, a, b in zip(self.signs, there, within, strict=True))]


@dataclass(frozen=True, eq=False, repr=False)
class VelocityBatch(Batch):
    """The matrices of many poses, ``pose_matrix @ pose' + input_matrix @ inputs' = 0``, and their singularities.

    A row that cannot be asked (not finite, out of reach, several modes that could be meant) is masked throughout and has its reason in
    ``errors``. All arrays are masked there.

    Attributes
    ----------
    poses : ndarray, shape (n, 3)
        The rows: the caller's own array where no conversion was needed.
    mask : ndarray of bool, shape (n,)
        True for a row with an error.
    pose_matrix, input_matrix : masked array, shape (n, 3, 3)
        Rows are scaled as in :class:`Velocity`.
    det_pose, det_input : masked array, shape (n,)
    sigma_min, sigma_min_input, dexterity : masked array, shape (n,)
        As in :class:`Velocity`.
    singularities : ndarray of uint8, shape (n,)
        0 none, 1 to 3 the type, 4 self-motion, 5 error; ``SINGULARITIES`` has their names.
    signs : tuple of str
        The names of all modes.
    modes : ndarray of uint8, shape (n,)
        The place of each row's mode among ``signs``.
    inputs_if_pose, pose_if_inputs : masked array, shape (n, 3), or None
        Where rates were given: the actuators' if those given are the platform's, and the other way round; masked where a singularity leaves none.
    input_accelerations_if_pose, pose_accelerations_if_inputs : masked array, shape (n, 3), or None
        Where accelerations were given: the same.
    actuator_forces : masked array, shape (n, 3), or None
        Where a wrench was given: what holds it; masked where a singularity leaves none.
    errors : mapping from row to InputError
        Rows that could not be asked.
    """

    poses: FloatArray
    signs: tuple[str, ...]
    modes: NDArray[np.uint8]
    singularities: NDArray[np.uint8]
    errors: RowErrors
    _matrices: FloatArray = field(repr=False)
    _readings: FloatArray = field(repr=False)
    _rates: FloatArray | None = field(repr=False)
    _answered: NDArray[np.bool_] = field(repr=False)
    _accelerations: FloatArray | None = field(repr=False)
    _accelerated: NDArray[np.bool_] = field(repr=False)
    _forces: FloatArray | None = field(repr=False)
    _held: NDArray[np.bool_] = field(repr=False)

    @classmethod
    def _of(cls, poses: FloatArray, batch: _assur.MotionBatch, asked: set[str]) -> VelocityBatch:
        for array in (batch.modes, batch.matrices, batch.readings, batch.singularities, batch.rates, batch.answered):
            read_only(array)
        for array in (batch.accelerations, batch.accelerated, batch.forces, batch.held):
            read_only(array)
        return cls(
            poses,
            tuple(batch.names),
            batch.modes,
            batch.singularities,
            RowErrors(batch.errors),
            batch.matrices,
            batch.readings,
            batch.rates if "rates" in asked else None,
            batch.answered,
            batch.accelerations if "accelerations" in asked else None,
            batch.accelerated,
            batch.forces if "wrench" in asked else None,
            batch.held,
        )

    @cached_property
    def mask(self) -> NDArray[np.bool_]:
        """True for a row with an error, shape ``(n,)``."""
        mask: NDArray[np.bool_] = self.singularities == SINGULARITIES.index("error")
        read_only(mask)
        return mask

    @property
    def pose_matrix(self) -> MaskedFloats:
        """``A``, shape ``(n, 3, 3)``."""
        return _masked(self._matrices[:, 0], self.mask)

    @property
    def input_matrix(self) -> MaskedFloats:
        """``B``, shape ``(n, 3, 3)``."""
        return _masked(self._matrices[:, 1], self.mask)

    @property
    def det_pose(self) -> MaskedFloats:
        """The determinant of ``A``, shape ``(n,)``; zero in a singularity of type 2."""
        return _masked(self._readings[:, 0], self.mask)

    @property
    def det_input(self) -> MaskedFloats:
        """The determinant of ``B``, shape ``(n,)``; zero in a singularity of type 1."""
        return _masked(self._readings[:, 1], self.mask)

    @property
    def sigma_min(self) -> MaskedFloats:
        """The smallest singular value of ``A``, rows scaled to length one, shape ``(n,)``."""
        return _masked(self._readings[:, 2], self.mask)

    @property
    def sigma_min_input(self) -> MaskedFloats:
        """The smallest singular value of a leg's block of ``B``, scaled, shape ``(n,)``."""
        return _masked(self._readings[:, 3], self.mask)

    @property
    def dexterity(self) -> MaskedFloats:
        """Smallest over largest singular value of the map from inputs to pose, shape ``(n,)``: 0 singular, 1 isotropic."""
        return _masked(self._readings[:, 4], self.mask)

    @property
    def inputs_if_pose(self) -> MaskedFloats | None:
        """Rates of the inputs if those given are the platform's, shape ``(n, 3)``; none where no rates were given."""
        return None if self._rates is None else _masked(self._rates[:, 0], ~self._answered[:, 0])

    @property
    def pose_if_inputs(self) -> MaskedFloats | None:
        """Rates of the platform if those given are the inputs', shape ``(n, 3)``; none where no rates were given."""
        return None if self._rates is None else _masked(self._rates[:, 1], ~self._answered[:, 1])

    @property
    def input_accelerations_if_pose(self) -> MaskedFloats | None:
        """Accelerations of the inputs if those given are the platform's, shape ``(n, 3)``; none where none were given."""
        return None if self._accelerations is None else _masked(self._accelerations[:, 0], ~self._accelerated[:, 0])

    @property
    def pose_accelerations_if_inputs(self) -> MaskedFloats | None:
        """Accelerations of the platform if those given are the inputs', shape ``(n, 3)``; none where none were given."""
        return None if self._accelerations is None else _masked(self._accelerations[:, 1], ~self._accelerated[:, 1])

    @property
    def actuator_forces(self) -> MaskedFloats | None:
        """Forces of the actuators that hold the wrench, shape ``(n, 3)``; none where no wrench was given."""
        return None if self._forces is None else _masked(self._forces, ~self._held)

    def __len__(self) -> int:
        return len(self.poses)

    def _title(self) -> str:
        return f"Velocities in {len(self)} poses"

    def _table(self) -> list[list[str]]:
        tally = np.bincount(self.singularities, minlength=len(SINGULARITIES))
        return [["singularity", "rows"], *([name, str(rows)] for name, rows in zip(SINGULARITIES, tally, strict=True) if rows)]
