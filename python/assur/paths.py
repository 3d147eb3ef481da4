"""One assembly mode followed along a path of inputs."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from ._arrays import FloatArray, read_only
from ._report import Report, counted, number, numbers
from .modes import Violation

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes

__all__ = ["FollowedPath", "PathEvent", "PathRow"]


@dataclass(frozen=True, eq=False)
class PathRow:
    """The mode at a row of the path: ``step`` from 1, ``id`` the mode's number at that row."""

    step: int
    inputs: FloatArray
    pose: FloatArray
    id: int
    det_a: float


@dataclass(frozen=True, eq=False)
class PathEvent:
    """What happens on the way.

    Attributes
    ----------
    at : float
        Where: row number and share of the way to the next.
    kind : str
        ``"meeting"`` (two modes meet and end), ``"limit"``, ``"branch"`` (modes cannot be told apart) or ``"self-motion"``.
    inputs, pose : ndarray, shape (3,)
    violation : Violation or None
        The limit that is crossed.
    leaves : bool or None
        Whether the joint leaves its range there, or comes back.
    self_motion : dict or None
        ``phi`` of the curve of poses, where the path stops on one.
    """

    at: float
    kind: str
    inputs: FloatArray
    pose: FloatArray
    violation: Violation | None
    leaves: bool | None
    self_motion: dict[str, Any] | None


@dataclass(frozen=True, eq=False, repr=False)
class FollowedPath(Report):
    """One assembly mode followed through rows of inputs; between rows it is proved never to jump.

    Attributes
    ----------
    complete : bool
        Whether the last row was reached.
    rows : tuple of PathRow
    events : tuple of PathEvent
    closed_in : int or None
        Where the path comes back to its first inputs: the mode it is in then. Another one means a mode change without a singularity.
    distance_to_meeting : float or None
        Length of the path of inputs from the first row to a meeting.
    """

    complete: bool
    rows: tuple[PathRow, ...]
    events: tuple[PathEvent, ...]
    closed_in: int | None
    distance_to_meeting: float | None

    @cached_property
    def inputs(self) -> FloatArray:
        """Inputs of the rows reached, shape ``(n, 3)``."""
        return _stacked([row.inputs for row in self.rows])

    @cached_property
    def poses(self) -> FloatArray:
        """Poses of the rows reached, shape ``(n, 3)``."""
        return _stacked([row.pose for row in self.rows])

    @cached_property
    def det_a(self) -> FloatArray:
        """Determinants of the pose matrix at the rows reached, shape ``(n,)``."""
        values: FloatArray = np.array([row.det_a for row in self.rows], dtype=np.float64)
        read_only(values)
        return values

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the positions along the path with its events; returns the axes, shows nothing."""
        from . import _plot

        return _plot.path(self, ax)

    def animate(self, ax: Axes | None = None, *, frames: int = 60, interval: float = 50.0) -> FuncAnimation:
        """An animation of the mechanism along the path.

        Parameters
        ----------
        ax : matplotlib Axes, optional
            Where to draw.
        frames : int
            At most so many rows are shown, evenly chosen.
        interval : float
            Milliseconds between them.

        Returns
        -------
        matplotlib FuncAnimation
            Save it with any of matplotlib's writers: ``animation.save("path.gif", writer="pillow")``.
        """
        from . import _plot

        return _plot.animate(self, ax, frames=frames, interval=interval)

    def _title(self) -> str:
        return f"Path through {counted(len(self.rows), 'row')}"

    def _table(self) -> list[list[str]]:
        rows = [[event.kind, number(event.at), numbers(event.inputs), numbers(event.pose)] for event in self.events]
        return [["event", "at", "inputs", "pose"], *rows] if rows else []

    def _summary(self) -> str:
        if not self.complete:
            return "stopped"
        if self.closed_in is None:
            return "complete"
        first = self.rows[0].id
        same = "the same mode" if self.closed_in == first else f"mode {self.closed_in}, without a singularity"
        return f"complete; the loop of mode {first} ends in {same}"


def _stacked(rows: list[NDArray[np.float64]]) -> FloatArray:
    stacked: FloatArray = np.array(rows, dtype=np.float64).reshape(-1, 3)
    read_only(stacked)
    return stacked
