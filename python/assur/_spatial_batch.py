"""Velocities of the spatial robots in many poses at once."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import ClassVar, TypeVar

import numpy as np
from numpy.typing import NDArray

from . import _assur
from ._arrays import FloatArray, read_only
from ._batch import Batch, RowErrors
from .poses import MaskedFloats, _masked

__all__ = ["HanaVelocityBatch", "TripodVelocityBatch"]

#: The code of a row that could not be asked.
_ERROR = 255
S = TypeVar("S", bound="SpatialVelocityBatch")


@dataclass(frozen=True, eq=False, repr=False)
class SpatialVelocityBatch(Batch):
    """Matrices of many poses of a spatial robot. A row that cannot be asked is masked throughout and has its reason in ``errors``."""

    poses: FloatArray
    singularities: NDArray[np.uint8]
    errors: RowErrors
    _batch: dict[str, NDArray[np.generic]] = field(repr=False)
    _asked: frozenset[str] = field(repr=False)

    #: Names of the codes in ``singularities``.
    SINGULARITIES: ClassVar[tuple[str, ...]] = ("none", "type 1", "type 2", "type 3")

    @classmethod
    def _of(cls: type[S], poses: FloatArray, batch: _assur.SpatialBatch, asked: set[str]) -> S:
        arrays: dict[str, NDArray[np.generic]] = {
            "inputs": batch.inputs,
            "matrices": batch.matrices,
            "readings": batch.readings,
            "rates": batch.rates,
            "answered": batch.answered,
            "accelerations": batch.accelerations,
            "accelerated": batch.accelerated,
        }
        for array in (batch.singularities, *arrays.values()):
            read_only(array)
        return cls(poses, batch.singularities, RowErrors(batch.errors), arrays, frozenset(asked))

    @cached_property
    def mask(self) -> NDArray[np.bool_]:
        """True for a row with an error, shape ``(n,)``."""
        mask: NDArray[np.bool_] = self.singularities == _ERROR
        read_only(mask)
        return mask

    def _floats(self, name: str) -> FloatArray:
        return self._batch[name].astype(np.float64, copy=False)

    @property
    def inputs(self) -> MaskedFloats:
        """Slider positions, shape ``(n, sliders)``."""
        return _masked(self._floats("inputs"), self.mask)

    def _way(self, what: str, there: str, way: int) -> MaskedFloats | None:
        if what not in self._asked:
            return None
        answered = self._batch[there][:, way].astype(np.bool_)
        return _masked(self._floats(what)[:, way], ~answered)

    @property
    def inputs_if_pose(self) -> MaskedFloats | None:
        """Rates of the sliders if those given are the platform's, shape ``(n, sliders)``; none where no rates were given."""
        return self._way("rates", "answered", 0)

    @property
    def pose_if_inputs(self) -> MaskedFloats | None:
        """Rates of the platform if those given are the sliders'; masked where a singularity leaves none."""
        return self._way("rates", "answered", 1)

    @property
    def input_accelerations_if_pose(self) -> MaskedFloats | None:
        """Accelerations of the sliders if those given are the platform's; none where none were given."""
        return self._way("accelerations", "accelerated", 0)

    @property
    def pose_accelerations_if_inputs(self) -> MaskedFloats | None:
        """Accelerations of the platform if those given are the sliders'; masked where a singularity leaves none."""
        return self._way("accelerations", "accelerated", 1)

    def __len__(self) -> int:
        return len(self.poses)

    def _title(self) -> str:
        return f"Velocities in {len(self)} poses"

    def _table(self) -> list[list[str]]:
        names = {**dict(enumerate(self.SINGULARITIES)), _ERROR: "error"}
        tally = np.bincount(self.singularities, minlength=_ERROR + 1)
        return [["singularity", "rows"], *([name, str(tally[code])] for code, name in names.items() if tally[code])]


@dataclass(frozen=True, eq=False, repr=False)
class HanaVelocityBatch(SpatialVelocityBatch):
    """The matrices of HANA in many poses, ``pose_matrix @ pose' + input_matrix @ inputs' = 0``; all arrays are masked in rows with an error.

    Attributes
    ----------
    poses : ndarray, shape (n, 3)
    mask : ndarray of bool, shape (n,)
    singularities : ndarray of uint8, shape (n,)
        The place among ``SINGULARITIES``; 255 for a row with an error.
    inputs : masked array, shape (n, 3)
    pose_matrix, input_matrix : masked array, shape (n, 3, 3)
    det_pose, det_input, sigma_min, sigma_min_input, dexterity : masked array, shape (n,)
    inputs_if_pose, pose_if_inputs : masked array, shape (n, 3), or None
    input_accelerations_if_pose, pose_accelerations_if_inputs : masked array, shape (n, 3), or None
    errors : mapping from row to InputError
    """

    @property
    def pose_matrix(self) -> MaskedFloats:
        """``A``, shape ``(n, 3, 3)``."""
        return _masked(self._floats("matrices").reshape(-1, 2, 3, 3)[:, 0], self.mask)

    @property
    def input_matrix(self) -> MaskedFloats:
        """``B``, shape ``(n, 3, 3)``."""
        return _masked(self._floats("matrices").reshape(-1, 2, 3, 3)[:, 1], self.mask)

    @property
    def det_pose(self) -> MaskedFloats:
        """The determinant of ``A``, shape ``(n,)``."""
        return _masked(self._floats("readings")[:, 0], self.mask)

    @property
    def det_input(self) -> MaskedFloats:
        """The determinant of ``B``, shape ``(n,)``."""
        return _masked(self._floats("readings")[:, 1], self.mask)

    @property
    def sigma_min(self) -> MaskedFloats:
        """The smallest singular value of ``A``, scaled as in :class:`HanaVelocity`, shape ``(n,)``."""
        return _masked(self._floats("readings")[:, 2], self.mask)

    @property
    def sigma_min_input(self) -> MaskedFloats:
        """The smallest singular value of ``B``, scaled, shape ``(n,)``."""
        return _masked(self._floats("readings")[:, 3], self.mask)

    @property
    def dexterity(self) -> MaskedFloats:
        """Smallest over largest singular value of the map from inputs to pose, shape ``(n,)``."""
        return _masked(self._floats("readings")[:, 4], self.mask)


@dataclass(frozen=True, eq=False, repr=False)
class TripodVelocityBatch(SpatialVelocityBatch):
    """The Jacobians of a three-legged robot in many poses, ``inputs' = jacobian @ (p', omega)``; all arrays are masked in rows with an error.

    Attributes
    ----------
    poses : ndarray, shape (n, 6) or (n, 12)
    mask : ndarray of bool, shape (n,)
    singularities : ndarray of uint8, shape (n,)
        The place among ``SINGULARITIES``, all of type 2 but the first; 255 for a row with an error, as those of type 1.
    inputs : masked array, shape (n, 6)
    jacobian : masked array, shape (n, 6, 6)
    det_jacobian, position_volume, orientation_volume : masked array, shape (n,)
    inputs_if_pose, pose_if_inputs : masked array, shape (n, 6), or None
    input_accelerations_if_pose, pose_accelerations_if_inputs : masked array, shape (n, 6), or None
    errors : mapping from row to InputError
    """

    SINGULARITIES: ClassVar[tuple[str, ...]] = ("none", "position", "orientation", "both")

    @property
    def jacobian(self) -> MaskedFloats:
        """``J``, shape ``(n, 6, 6)``."""
        return _masked(self._floats("matrices").reshape(-1, 6, 6), self.mask)

    @property
    def det_jacobian(self) -> MaskedFloats:
        """The determinant of ``J``, shape ``(n,)``."""
        return _masked(self._floats("readings")[:, 0], self.mask)

    @property
    def position_volume(self) -> MaskedFloats:
        """Volume of the planes' unit normals, shape ``(n,)``; zero where the place is not determined."""
        return _masked(self._floats("readings")[:, 1], self.mask)

    @property
    def orientation_volume(self) -> MaskedFloats:
        """Volume of the turning axes, shape ``(n,)``; zero where the orientation is not determined."""
        return _masked(self._floats("readings")[:, 2], self.mask)
