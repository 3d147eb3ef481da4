"""Assur groups, linkages and coupler curves, from problem files or dictionaries of the same keys. Angles in radians."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from . import _assur
from ._arrays import MOST_POINTS, FloatArray, number as one_number, read_only, whole
from ._problems import Problem, ProblemLike
from ._report import ComplexArray, Report, number, result
from .errors import InputError
from .modes import Account, AssemblyModes

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

__all__ = [
    "Circuit",
    "Circle",
    "CouplerCurve",
    "DoublePoint",
    "FourBar",
    "GroupAssemblies",
    "GroupAssembly",
    "Intersection",
    "LinkageAssemblies",
    "LinkageAssembly",
    "LinkageGroup",
    "LinkageNode",
    "Sextic",
    "coupler",
    "group",
    "triad",
]


def triad(problem: ProblemLike, *, certify: bool = False) -> AssemblyModes:
    """Every way to put a triad of the dyads RR, PR, RP, PP together.

    Parameters
    ----------
    problem : path or mapping
        A triad problem, schema ``assur/triad/1``; :attr:`AssemblyModes.triad` is one.
    certify : bool
        Whether the answer is to be proved: a box around every mode that holds it and no other.

    Returns
    -------
    AssemblyModes
        Without joints and signs, which belong to manipulators.

    Raises
    ------
    ModelError
        A file or mapping that holds no triad.

    Examples
    --------
    >>> import assur
    >>> leg = lambda a, b, l: {"type": "RR", "a": a, "b": b, "l": l}
    >>> legs = [leg([0, 0], [0, 0], 2.0), leg([4, 0], [1, 0], 2.5), leg([0, 3], [0, 1], 2.0)]
    >>> answer = assur.triad({"schema": "assur/triad/1", "legs": legs})
    >>> answer.account.degree
    6
    """
    text, name = Problem.of(problem)
    return result(AssemblyModes, _assur.triad(text, name, bool(certify)))


@dataclass(frozen=True, eq=False)
class GroupAssembly:
    """One assembly: ``theta = exp(i phi)`` of every link but the ground, in order, as rotations from the reference assembly."""

    theta: ComplexArray
    real: bool
    multiplicity: int
    residual: float

    @property
    def angles(self) -> FloatArray:
        """The rotations in radians, of a real assembly; shape ``(links - 1,)``."""
        return np.angle(self.theta)


@dataclass(frozen=True, eq=False, repr=False)
class GroupAssemblies(Report):
    """Every way to put a group of revolute joints together, held against the number of its kind.

    Attributes
    ----------
    status : str
        ``"complete"``, ``"self_motion"`` or ``"undecided"``.
    assemblies : tuple of GroupAssembly
        The real ones; with ``complex=True`` all.
    count : int
        How many there are, real and complex, with multiplicity.
    expected, missing : int or None
        How many there are for general dimensions, and how many of them were not found.
    truss : str or None
        Name in the catalogue of Baranov trusses.
    self_motions : tuple of GroupAssembly
        One assembly on each curve of assemblies.
    loose_links : tuple of int
        Links that turn freely.
    size : float
        The length that residuals are measured against.
    """

    status: str
    assemblies: tuple[GroupAssembly, ...]
    count: int
    expected: int | None
    missing: int | None
    truss: str | None
    self_motions: tuple[GroupAssembly, ...]
    loose_links: tuple[int, ...]
    size: float

    def __len__(self) -> int:
        return len(self.assemblies)

    def __iter__(self) -> Iterator[GroupAssembly]:
        return iter(self.assemblies)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the real assemblies over one another; returns the axes, shows nothing."""
        from . import _plot

        return _plot.trusses(self, ax)

    def _title(self) -> str:
        return f"Baranov truss {self.truss}" if self.truss else "Group of revolute joints"

    def _table(self) -> list[list[str]]:
        real = [assembly for assembly in self.assemblies if assembly.real]
        if not real:
            return []
        header = ["assembly", *(f"link {link}" for link in range(1, len(real[0].theta) + 1)), "mult.", "residual"]
        rows = [
            [str(place), *map(number, assembly.angles), str(assembly.multiplicity), f"{assembly.residual:.1e}"]
            for place, assembly in enumerate(real, 1)
        ]
        return [header, *rows]

    def _summary(self) -> str:
        of = "" if self.expected is None else f" of {self.expected}"
        return f"{self.status}; {sum(assembly.real for assembly in self.assemblies)} real, {self.count}{of} in all"


@dataclass(frozen=True)
class LinkageGroup:
    """A group that a linkage falls into with its drivers held."""

    links: tuple[int, ...]
    name: str


@dataclass(frozen=True)
class LinkageNode:
    """One group's assembly, standing on its parent's, by place in the list of nodes."""

    group: int
    parent: int | None
    number: int
    status: str
    multiplicity: int


@dataclass(frozen=True, eq=False)
class LinkageAssembly:
    """One assembly of the whole: which of each group's (from 1), ``x, y, phi`` of each link and the displacement of each joint from the reference assembly."""

    choice: tuple[int, ...]
    poses: FloatArray
    displacements: FloatArray
    residual: float


@dataclass(frozen=True, eq=False, repr=False)
class LinkageAssemblies(Report):
    """Every assembly of a linkage, as the tree of its groups' assemblies.

    Attributes
    ----------
    status : str
    inputs : ndarray, shape (drivers,)
        Angle of each driven joint from the reference assembly, radians.
    groups : tuple of LinkageGroup
        In the order of assembly.
    nodes : tuple of LinkageNode
        The tree, parents before children.
    assemblies : tuple of LinkageAssembly
    dead_ends : int
        Branches of the tree that end at a group without a real assembly.
    count : int
    """

    status: str
    inputs: FloatArray
    groups: tuple[LinkageGroup, ...]
    nodes: tuple[LinkageNode, ...]
    assemblies: tuple[LinkageAssembly, ...]
    dead_ends: int
    count: int

    def __len__(self) -> int:
        return len(self.assemblies)

    def __iter__(self) -> Iterator[LinkageAssembly]:
        return iter(self.assemblies)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the assemblies over one another; returns the axes, shows nothing."""
        from . import _plot

        return _plot.linkages(self, ax)

    def _title(self) -> str:
        return "Linkage of " + ", ".join(group.name for group in self.groups)

    def _table(self) -> list[list[str]]:
        rows = [
            ["-".join(map(str, assembly.choice)), f"{assembly.residual:.1e}"] for assembly in self.assemblies
        ]
        return [["assembly", "residual"], *rows] if rows else []

    def _summary(self) -> str:
        return f"{self.status}; {self.count} assemblies"


def group(
    problem: ProblemLike, *, inputs: ArrayLike = (), complex: bool = False
) -> GroupAssemblies | LinkageAssemblies:
    """Every way to put an Assur group of revolute joints together, or a linkage of such groups.

    Parameters
    ----------
    problem : path or mapping
        A group (schema ``assur/group/1``, up to eleven links) or a linkage (``assur/linkage/1``).
    inputs : array_like, shape (drivers,)
        For a linkage: the angle of each driven joint from the reference assembly, radians, in file order.
    complex : bool
        Whether the non-real assemblies of a group are listed too.

    Returns
    -------
    GroupAssemblies or LinkageAssemblies
        As the problem is.

    Raises
    ------
    ModelError
        A file or mapping that holds neither.
    InputError
        Another number of inputs than of driven joints.
    """
    text, name = Problem.of(problem)
    values = np.atleast_1d(np.asarray(inputs, dtype=object)).ravel()
    numbers = [one_number("inputs", value) for value in values]
    try:
        answer = _assur.group(text, name, numbers, bool(complex))
    except InputError:
        raise
    except ValueError as error:
        if type(error) is not ValueError:
            raise
        raise InputError(str(error), field="inputs", value=len(numbers)) from None
    origin = Problem(text, name)
    if '"assur/linkage-report/1"' in answer.json:
        return result(LinkageAssemblies, answer, origin)
    return result(GroupAssemblies, answer, origin)


@dataclass(frozen=True, eq=False)
class Sextic:
    """The equation of a coupler curve: ``coefficients[i, j]`` belongs to ``z**i * w**j`` with ``z = x + i y``, ``w = x - i y``."""

    coefficients: ComplexArray


@dataclass(frozen=True, eq=False)
class Circle:
    """A circle."""

    center: FloatArray
    radius: float


@dataclass(frozen=True, eq=False)
class DoublePoint:
    """A point that the curve passes twice; ``point`` is none where it is not real."""

    kind: str
    point: FloatArray | None
    z: complex
    w: complex
    thetas: ComplexArray


@dataclass(frozen=True, eq=False)
class Circuit:
    """A piece of the curve that the linkage traces without being taken apart: the range of its input angle, none for a full turn."""

    input: FloatArray | None
    way: int | None
    touches: bool


@dataclass(frozen=True, eq=False)
class FourBar:
    """A four-bar: coupler point ``z``, coupler turn ``theta``, ``|z - a + theta p| = r``, ``|z - b + theta q| = s``."""

    a: FloatArray
    b: FloatArray
    p: FloatArray
    q: FloatArray
    r: float
    s: float


@dataclass(frozen=True, eq=False)
class Intersection:
    """Where the curve meets its partner; ``point`` is none where it is not real."""

    real: bool
    point: FloatArray | None
    z: complex
    w: complex
    thetas: ComplexArray
    multiplicity: int
    residual: float


@dataclass(frozen=True, eq=False, repr=False)
class CouplerCurve(Report):
    """A coupler curve, its special points and pieces, and every intersection asked for.

    Attributes
    ----------
    grashof : str or None
        Class of a four-bar.
    sextic : Sextic
    foci : ndarray, shape (3, 2) or (0,)
    circle_of_singular_foci : Circle or None
    double_points : tuple of DoublePoint or None
        None where every point is double.
    circuits : tuple of Circuit
    cognates : tuple of FourBar
        The two other four-bars that draw the same curve.
    intersections : tuple of Intersection or None
    account : Account or None
        Where every intersection went.
    """

    grashof: str | None
    sextic: Sextic
    foci: FloatArray
    circle_of_singular_foci: Circle | None
    double_points: tuple[DoublePoint, ...] | None
    circuits: tuple[Circuit, ...]
    cognates: tuple[FourBar, ...]
    intersections: tuple[Intersection, ...] | None
    account: Account | None

    @cached_property
    def points(self) -> FloatArray:
        """The real intersections, shape ``(n, 2)``."""
        found = [meeting.point for meeting in self.intersections or () if meeting.point is not None]
        points: FloatArray = np.array(found, dtype=np.float64).reshape(-1, 2)
        read_only(points)
        return points

    def polygons(self, points: int = 400) -> list[NDArray[np.float64]]:
        """The curve as polygons of about so many points each, shape ``(n, 2)``, circuit by circuit."""
        assert isinstance(self._origin, Problem)
        count = whole("points", points, 3, MOST_POINTS)
        flat = _assur.coupler_polygons(self._origin.text, self._origin.name, count)
        return [np.asarray(piece).reshape(-1, 2) for piece in flat]

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draws the curve with its foci, double points and intersections; returns the axes, shows nothing."""
        from . import _plot

        return _plot.coupler(self, ax)

    def _title(self) -> str:
        return f"Coupler curve{'' if self.grashof is None else f' of a four-bar: {self.grashof}'}"

    def _table(self) -> list[list[str]]:
        real = [meeting for meeting in self.intersections or () if meeting.point is not None]
        rows = [
            [str(place), *map(number, meeting.point), str(meeting.multiplicity), f"{meeting.residual:.1e}"]
            for place, meeting in enumerate(real, 1)
            if meeting.point is not None
        ]
        return [["intersection", "x", "y", "mult.", "residual"], *rows] if rows else []

    def _summary(self) -> str:
        met = "" if self.account is None else f"; intersections: {self.account}"
        return f"{len(self.circuits)} circuits{met}"


def coupler(problem: ProblemLike) -> CouplerCurve:
    """A coupler curve, and where it meets a line, a circle or another.

    Parameters
    ----------
    problem : path or mapping
        Schema ``assur/coupler/1``; what it is to meet stands under ``with``.

    Returns
    -------
    CouplerCurve

    Raises
    ------
    ModelError
        A file or mapping that holds no coupler curve.
    """
    text, name = Problem.of(problem)
    return result(CouplerCurve, _assur.coupler(text, name), Problem(text, name))
