"""Answers to the forward problem: every assembly mode, of one row of inputs or of many."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from . import _assur
from ._arrays import FloatArray, read_only
from ._batch import Batch, RowErrors
from ._report import ComplexArray, Report, number, numbers

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = [
    "Account",
    "AssemblyModes",
    "Certificate",
    "ComplexMode",
    "Mode",
    "ModesBatch",
    "NearMiss",
    "Rejection",
    "SelfMotion",
    "ThetaPolynomial",
    "UndecidedLimit",
    "Violation",
]


@dataclass(frozen=True, eq=False)
class Violation:
    """A joint outside its limits; legs and joints from 1, radians or lengths."""

    leg: int
    joint: int
    value: float
    limit: FloatArray


@dataclass(frozen=True, eq=False)
class Mode:
    """One way to put the mechanism together.

    Attributes
    ----------
    pose : ndarray, shape (3,)
        ``x, y, phi`` of the platform in the base frame; lengths as in the model, radians in (-pi, pi].
    multiplicity : int
        How many modes meet here; above 1 the pose is singular.
    residual : float
        Largest closure error of the assembled mechanism over its largest length.
    proof : str
        ``"proven"``, ``"refuted"``, ``"undecided"`` or ``"not_asked"``.
    box : ndarray, shape (3, 2), or None
        Intervals of ``x, y, phi`` that hold this mode and no other, where proofs were asked for.
    joints : ndarray, shape (legs, 3), or None
        Joint values, leg by leg, base first; none for a triad.
    signs : str or None
        The working mode: one sign a leg; none for a triad.
    det_a : float
        Determinant of the pose matrix in the pose; zero in a singularity of type 2.
    violations : tuple of Violation
        Passive limits that the mode violates.
    """

    pose: FloatArray
    multiplicity: int
    residual: float
    proof: str
    box: FloatArray | None
    joints: FloatArray | None
    signs: str | None
    det_a: float
    violations: tuple[Violation, ...]


@dataclass(frozen=True, eq=False)
class ComplexMode:
    """A non-real solution: ``theta = exp(i phi)``, ``z = x + i y``, ``w = x - i y``, each a complex number of its own."""

    theta: complex
    z: complex
    w: complex
    multiplicity: int


@dataclass(frozen=True)
class Account:
    """Where every solution went; the entries after ``degree`` add up to it."""

    degree: int
    real: int
    complex: int
    at_infinity: int
    rejected: int
    self_motion: int
    undecided: int

    def __str__(self) -> str:
        parts = [
            (self.real, "real"),
            (self.complex, "complex"),
            (self.at_infinity, "at infinity"),
            (self.rejected, "rejected"),
            (self.self_motion, "self-motion"),
            (self.undecided, "undecided"),
        ]
        shown = [f"{count} {name}" for place, (count, name) in enumerate(parts) if count or place < 2]
        return f"degree {self.degree} = " + " + ".join(shown)


@dataclass(frozen=True, eq=False)
class Rejection:
    """A root of the polynomial that carries no pose, with the reason."""

    theta: complex
    multiplicity: int
    reason: str


@dataclass(frozen=True)
class SelfMotion:
    """A curve of poses; ``phi`` (radians) where it is a translation, none where the platform turns."""

    phi: float | None
    real: bool


@dataclass(frozen=True)
class NearMiss:
    """A special shape the mechanism does not have, exactly, but nearly; the distance is relative."""

    special: str
    distance: float


@dataclass(frozen=True)
class UndecidedLimit:
    """Which limit was reached where something stays undecided: ``"size"`` or ``"exponent_range"``."""

    name: str
    text: str


@dataclass(frozen=True, eq=False)
class Certificate:
    """What is proved of the answer as a whole, and of which numbers."""

    summary: str
    complete: bool
    indistinct: int
    rounded_offset: bool
    free_ways: int
    about: str
    subject: dict[str, Any]


@dataclass(frozen=True, eq=False)
class ThetaPolynomial:
    """The polynomial in ``theta`` that elimination leaves: ``coefficients[k]`` belongs to ``theta**(lowest + k)``."""

    variable: str
    lowest: int
    coefficients: ComplexArray

    _renamed: ClassVar[Mapping[str, str]] = {"from": "lowest"}


@dataclass(frozen=True, eq=False, repr=False)
class AssemblyModes(Report):
    """Every assembly mode for given inputs, with the evidence that there is no other.

    Attributes
    ----------
    status : str
        ``"complete"`` (also where there is no mode), ``"self_motion"`` where a curve of poses exists, ``"undecided"``.
    limit : UndecidedLimit or None
        Which limit was reached where something stays undecided.
    inputs : ndarray, shape (3,)
        The actuator values, radians or lengths; empty for a triad.
    group : str or None
        The locked group: ``"RR-RR-RR"``.
    triad : dict or None
        The locked triad as a problem file, for :func:`assur.triad`.
    modes : tuple of Mode
        Sorted by ``phi``, then ``x``, then ``y``.
    complex : tuple of ComplexMode
        The non-real solutions.
    complex_out_of_range : int
        Non-real solutions whose numbers leave the range of a float: counted, not listed.
    account : Account
        Where every solution went.
    rejections, self_motions, special, near
        Rejected roots, curves of poses, names of what is special, and of what nearly is.
    certificate : Certificate or None
        What is proved, where that was asked for.
    polynomial : ThetaPolynomial or None
        The eliminant.
    size : float
        The length that residuals are measured against.
    """

    status: str
    limit: UndecidedLimit | None
    inputs: FloatArray
    group: str | None
    triad: dict[str, Any] | None
    modes: tuple[Mode, ...]
    complex: tuple[ComplexMode, ...]
    complex_out_of_range: int
    account: Account
    rejections: tuple[Rejection, ...]
    self_motions: tuple[SelfMotion, ...]
    special: tuple[str, ...]
    near: tuple[NearMiss, ...]
    certificate: Certificate | None
    polynomial: ThetaPolynomial | None
    size: float

    def __len__(self) -> int:
        return len(self.modes)

    def __iter__(self) -> Iterator[Mode]:
        return iter(self.modes)

    def __getitem__(self, place: int) -> Mode:
        return self.modes[place]

    @cached_property
    def poses(self) -> FloatArray:
        """``x, y, phi`` of every mode, shape ``(modes, 3)``."""
        poses = np.array([mode.pose for mode in self.modes], dtype=np.float64).reshape(-1, 3)
        read_only(poses)
        return poses

    @property
    def residual(self) -> float:
        """The largest residual of all modes; 0 where there is none."""
        return max((mode.residual for mode in self.modes), default=0.0)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws all modes over one another, each in a colour of its own.

        Parameters
        ----------
        ax : matplotlib Axes, optional
            Where to draw; without it new axes are made.

        Returns
        -------
        matplotlib Axes
            Nothing is shown: that is for the caller.
        """
        from . import _plot

        return _plot.modes(self, ax)

    def plot_each(self) -> NDArray[np.object_]:
        """Draws each mode into axes of its own, all on one scale; returns the array of axes, one for each mode."""
        from . import _plot

        return _plot.each_mode(self)

    def _title(self) -> str:
        what = self._origin.title if self._origin is not None else "Triad"
        inputs = f", inputs {numbers(self.inputs)}" if self.inputs.size else ""
        return f"{what}: locked {self.group}{inputs}"

    def _table(self) -> list[list[str]]:
        if not self.modes:
            return []
        proofs = any(mode.proof != "not_asked" for mode in self.modes)
        header = ["mode", "x", "y", "phi (rad)", "mult.", "det A", "residual", "signs", "proof"]
        rows = [
            [
                str(place),
                *(number(value) for value in mode.pose),
                str(mode.multiplicity),
                f"{mode.det_a:+.3e}",
                f"{mode.residual:.0e}",
                (mode.signs or "") + ("" if not mode.violations else " (limits)"),
                mode.proof,
            ]
            for place, mode in enumerate(self.modes, 1)
        ]
        return [row if proofs else row[:-1] for row in [header, *rows]]

    def _summary(self) -> str:
        proof = "" if self.certificate is None else f"; proof: {self.certificate.summary}"
        special = "" if not self.special else f"; special: {', '.join(self.special)}"
        return f"{self.status}; {self.account}{special}{proof}"


#: Names of the codes of :attr:`ModesBatch.statuses`.
STATUSES = ("complete", "self_motion", "undecided", "error")


@dataclass(frozen=True, eq=False, repr=False)
class ModesBatch(Batch):
    """Every real assembly mode for many rows of inputs.

    A row that cannot be asked (not finite, outside limits) is masked throughout and has its reason in ``errors``. Each row's count is
    proved; results do not depend on how many threads there are.

    Attributes
    ----------
    inputs : ndarray, shape (n, 3)
        The rows, radians or lengths: the caller's own array where no conversion was needed.
    poses : masked array, shape (n, 6, 3)
        ``x, y, phi`` of each mode, sorted by ``phi``, ``x``, ``y``; masked beyond a row's count. ``poses.data`` is the plain array, with
        zeros there.
    counts : ndarray of uint8, shape (n,)
        How many modes each row has.
    mask : ndarray of bool, shape (n, 6)
        True where a row has no such mode, as in numpy's masked arrays.
    statuses : ndarray of uint8, shape (n,)
        0 complete, 1 self-motion (a curve of poses beside the modes), 2 undecided, 3 error; ``STATUSES`` has their names.
    errors : mapping from row to InputError
        Rows that could not be asked.
    """

    inputs: FloatArray
    counts: NDArray[np.uint8]
    statuses: NDArray[np.uint8]
    errors: RowErrors
    _poses: FloatArray = field(repr=False)

    @classmethod
    def _of(cls, inputs: FloatArray, batch: _assur.Batch) -> ModesBatch:
        for array in (batch.poses, batch.counts, batch.statuses):
            read_only(array)
        return cls(inputs, batch.counts, batch.statuses, RowErrors(batch.errors), batch.poses)

    @cached_property
    def mask(self) -> NDArray[np.bool_]:
        """True where a row has no such mode, shape ``(n, 6)``."""
        mask: NDArray[np.bool_] = np.arange(self._poses.shape[1], dtype=np.uint8) >= self.counts[:, np.newaxis]
        read_only(mask)
        return mask

    @cached_property
    def poses(self) -> np.ma.MaskedArray[Any, np.dtype[np.float64]]:
        """``x, y, phi`` of each mode, shape ``(n, 6, 3)``, masked beyond a row's count."""
        mask = np.broadcast_to(self.mask[:, :, np.newaxis], self._poses.shape)
        return np.ma.MaskedArray(self._poses, mask=mask)

    def __len__(self) -> int:
        return len(self.counts)

    def __getitem__(self, row: int) -> FloatArray:
        """The poses of one row, shape ``(count, 3)``."""
        return self._poses[row, : self.counts[row]]

    def _title(self) -> str:
        return f"Assembly modes of {len(self)} rows"

    def _table(self) -> list[list[str]]:
        tally = np.bincount(self.counts[self.statuses != STATUSES.index("error")], minlength=1)
        return [["modes", "rows"], *([str(count), str(rows)] for count, rows in enumerate(tally) if rows)]

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the positions of all modes of all rows, coloured by orientation; returns the axes."""
        from . import _plot

        return _plot.batch(self, ax)
