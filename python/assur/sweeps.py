"""Design studies: many designs, the same questions of each, in this process or on a Dask cluster.

Designs are cut into chunks of a fixed size. Each chunk becomes one table (Arrow on its way from a worker) and one file of a Parquet dataset, which appears whole or
not at all. So a worker that dies costs the chunk it was at, and a sweep that was stopped goes on where it was.
"""

from __future__ import annotations

import hashlib
import itertools
import json
import os
import pickle
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._report import block, number
from .errors import AssurError, InputError
from .manipulator import Manipulator

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["Design", "Sweep", "sweep", "vary"]

#: What a measure may answer for a design.
Measured: TypeAlias = "Mapping[str, float | int | str | None]"
#: A name of a measure, or a function of one's own.
Measure: TypeAlias = "str | Callable[[Manipulator], Measured]"

#: Designs in a chunk: some seconds' work of the dearer measures, and files of a handy size.
CHUNK = 256
#: Rows that a notebook shows.
MOST_SHOWN = 20
#: The file that says what a dataset is the answer to.
_MANIFEST = "sweep.json"


@dataclass(frozen=True)
class Design:
    """A manipulator, and the parameters that make it this one."""

    parameters: Mapping[str, float]
    manipulator: Manipulator


class _Grid(Sequence[Design]):
    """All combinations of values, made one by one."""

    def __init__(self, base: Manipulator, axes: dict[str, NDArray[np.float64]]) -> None:
        self._base, self._axes = base, axes
        self._shape = tuple(len(values) for values in axes.values())

    def __len__(self) -> int:
        return int(np.prod(self._shape, dtype=np.int64))

    def __getitem__(self, place: Any) -> Any:
        if isinstance(place, slice):
            return [self[k] for k in range(*place.indices(len(self)))]
        if not -len(self) <= place < len(self):
            raise IndexError(place)
        at = np.unravel_index(place % len(self), self._shape)
        values = {key: float(axis[k]) for (key, axis), k in zip(self._axes.items(), at, strict=True)}
        return Design(values, self._base.with_numbers(values))


def vary(manipulator: Manipulator, parameters: Mapping[str, ArrayLike]) -> Sequence[Design]:
    """All combinations of values of some numbers of a design.

    Parameters
    ----------
    manipulator : Manipulator
        The design to start from.
    parameters : mapping from key to array_like, shape (n,)
        Keys as in :meth:`Manipulator.with_numbers`; angles in radians.

    Returns
    -------
    sequence of Design
        In the order of nested loops, the last key fastest.

    Raises
    ------
    InputError
        A key that names no number of the design.
    """
    axes = {key: np.atleast_1d(np.asarray(values, dtype=np.float64)) for key, values in parameters.items()}
    for key, values in axes.items():
        if values.ndim != 1 or not values.size:
            raise InputError(f"{key}: shape {values.shape} must be (n,), not empty", field=key, value=values.shape)
        manipulator.with_numbers({key: float(values[0])})
    return _Grid(manipulator, axes)


# --- measures ------------------------------------------------------------------------------------------------------------------------


def _degree(robot: Manipulator, argument: str) -> Measured:
    del argument
    return {"degree": robot.check()["degree_bound"]}


def _modes(robot: Manipulator, argument: str) -> Measured:
    answer = robot.forward(_three("modes", argument))
    return {"modes": len(answer), "modes_status": answer.status}


def _dexterity(robot: Manipulator, argument: str) -> Measured:
    pose, _, mode = argument.partition("@")
    found = robot.velocity(_three("dexterity", pose), mode or None)
    return {"dexterity": found.dexterity, "singularity": found.singularity}


def _workspace(quantity: str) -> Callable[[Manipulator, str], Measured]:
    def measured(robot: Manipulator, argument: str) -> Measured:
        kind, *angles = argument.split(":")
        try:
            numbers: list[float | None] = [float(angle) for angle in angles]
        except ValueError:
            raise InputError(f"report: {quantity}:{argument} must have numbers behind the kind", field="report", value=argument) from None
        phi = numbers[0] if len(numbers) == 1 else None
        lower, upper = numbers if len(numbers) == 2 else (None, None)
        region = robot.workspace(kind or "maximal", phi=phi, lower=lower, upper=upper)
        if quantity in _EDGES:
            value = None if region.bbox is None else float(region.bbox[_EDGES.index(quantity)])
        else:
            value = getattr(region, quantity)
        return {f"{quantity}:{argument}": value}

    return measured


#: Edges of a region's bounding box, in its order.
_EDGES = ("xmin", "ymin", "xmax", "ymax")


def _three(measure: str, text: str) -> list[float]:
    try:
        a, b, c = (float(part) for part in text.split(","))
    except ValueError:
        raise InputError(f"report: {measure}:{text} must have three numbers", field="report", value=text) from None
    return [a, b, c]


#: Measures by name; what stands behind the colon is their argument.
_MEASURES: dict[str, Callable[[Manipulator, str], Measured]] = {
    "degree": _degree,
    "modes": _modes,
    "dexterity": _dexterity,
    **{name: _workspace(name) for name in ("area", "perimeter", "components", "holes", *_EDGES)},
}


def _checked(report: Measure | Iterable[Measure]) -> tuple[Measure, ...]:
    measures = (report,) if isinstance(report, str) or callable(report) else tuple(report)
    for measure in measures:
        if isinstance(measure, str) and measure.partition(":")[0] not in _MEASURES:
            known = ", ".join(_MEASURES)
            raise InputError(f"report: {measure!r} must be one of {known}, or a function", field="report", value=measure)
    if not measures:
        raise InputError("report: nothing is asked for", field="report")
    return measures


def _name(measure: Measure) -> str:
    return measure if isinstance(measure, str) else f"{measure.__module__}.{getattr(measure, '__qualname__', repr(measure))}"


def _row(number: int, design: Design, measures: tuple[Measure, ...]) -> dict[str, Any]:
    row: dict[str, Any] = {"design": number, **design.parameters, "error": None}
    for measure in measures:
        try:
            if isinstance(measure, str):
                name, _, argument = measure.partition(":")
                row.update(_MEASURES[name](design.manipulator, argument))
            else:
                row.update(measure(design.manipulator))
        except AssurError as error:
            # A design that cannot be asked is a row with a reason; the others go on.
            row["error"] = str(error) if row["error"] is None else f"{row['error']}; {error}"
    return row


def _columns(rows: list[dict[str, Any]]) -> dict[str, list[Any]]:
    names: dict[str, None] = {}
    for row in rows:
        names.update(dict.fromkeys(row))
    return {name: [row.get(name) for row in rows] for name in names}


def _solve(first: int, designs: list[Design], measures: tuple[Measure, ...]) -> list[dict[str, Any]]:
    return [_row(first + place, design, measures) for place, design in enumerate(designs)]


def _solve_arrow(first: int, designs: list[Design], measures: bytes) -> Any:
    """A chunk on a worker: its rows as an Arrow table."""
    # Unpacked here and not on the way: a function that this worker cannot import is then the task's error, not the end of its connection.
    return _arrow(_solve(first, designs, pickle.loads(measures)))


# --- the sweep -----------------------------------------------------------------------------------------------------------------------


@dataclass(frozen=True, eq=False, repr=False)
class Sweep:
    """Results over designs, a row each, in the order of the designs.

    Attributes
    ----------
    columns : mapping from name to ndarray, shape (n,)
        ``design`` (from 0), the parameters, what was measured (NaN or None where a design has no answer), ``error`` with the reason.
    path : Path or None
        The Parquet dataset, where one was written.
    """

    columns: Mapping[str, NDArray[Any]]
    path: Path | None = field(default=None)

    def __len__(self) -> int:
        return len(self.columns["design"])

    def __getitem__(self, name: str) -> NDArray[Any]:
        return self.columns[name]

    def _title(self) -> str:
        errors = sum(error is not None for error in self.columns["error"])
        where = "" if self.path is None else f", in {self.path}"
        return f"Sweep of {len(self)} designs ({errors} with an error): {', '.join(self.columns)}{where}"

    def __repr__(self) -> str:
        return self._title()

    def _repr_html_(self) -> str:
        shown = min(len(self), MOST_SHOWN)
        rows = [["" if (x := values[row]) is None else number(x) if isinstance(x, float) else str(x) for values in self.columns.values()] for row in range(shown)]
        more = f"{len(self) - shown} more rows" if len(self) > shown else ""
        return block(self._title(), [list(self.columns), *rows], more)

    def to_arrow(self) -> Any:
        """The rows as a pyarrow table."""
        import pyarrow

        return pyarrow.table({name: pyarrow.array(values, from_pandas=True) for name, values in self.columns.items()})

    def pareto(self, *, least: Sequence[str] = (), most: Sequence[str] = ()) -> NDArray[np.int64]:
        """Rows that no other row beats: as good in everything named and better in something.

        Parameters
        ----------
        least, most : sequence of str
            Columns that should be small, and large.

        Returns
        -------
        ndarray of int, shape (k,)
            Rows, ascending; rows without an answer in one of the columns are none of them.
        """
        goals = [np.asarray(self.columns[name], dtype=np.float64) for name in least]
        goals += [-np.asarray(self.columns[name], dtype=np.float64) for name in most]
        table = np.stack(goals, axis=1)
        rows = np.flatnonzero(np.isfinite(table).all(axis=1))
        kept = []
        for row in rows:
            others = table[rows]
            beaten = (others <= table[row]).all(axis=1) & (others < table[row]).any(axis=1)
            if not beaten.any():
                kept.append(row)
        return np.array(kept, dtype=np.int64)

    def plot(self, x: str, y: str, ax: Axes | None = None, *, front: NDArray[np.int64] | None = None) -> Axes:
        """Draws two columns against each other, with a front if one is given; returns the axes, shows nothing."""
        from . import _plot

        return _plot.sweep(self, x, y, ax, front)


def sweep(
    designs: Iterable[Design | Manipulator],
    report: Measure | Iterable[Measure],
    client: Any = None,
    *,
    output: str | os.PathLike[str] | None = None,
    chunk: int = CHUNK,
    progress: bool = False,
) -> Sweep:
    """The same questions of many designs.

    Parameters
    ----------
    designs : iterable of Design or Manipulator
        :func:`vary` makes a grid of them.
    report : str, callable, or several
        ``"degree"``, ``"modes:q1,q2,q3"`` (real assembly modes), ``"dexterity:x,y,phi"`` or ``"dexterity:x,y,phi@+-+"``; of
        workspaces ``area``, ``perimeter``, ``components``, ``holes``, ``xmin``, ``ymin``, ``xmax``, ``ymax`` of a kind, as on the command line:
        ``"area:maximal"``, ``"area:constant:0.3"``, ``"holes:inclusive:0:1.5"``; or functions of a manipulator that answer a mapping from
        names to numbers or texts. Angles in radians.
    client : dask.distributed.Client, optional
        A Dask client, with any scheduler behind it; without it all is done in this process. Its workers need this package; functions of a
        module that they cannot import are sent whole after ``cloudpickle.register_pickle_by_value(module)``, those of a notebook always.
    output : path, optional
        A folder for the results as a Parquet dataset, a file for each chunk. If it holds some already, of the same sweep, those are kept and
        the rest is done.
    chunk : int
        Designs in a chunk.
    progress : bool
        Whether Dask's own progress bar is shown.

    Returns
    -------
    Sweep

    Raises
    ------
    InputError
        A measure that is unknown; an ``output`` that holds another sweep.

    Notes
    -----
    A design that cannot be asked has its reason in ``error``; the others go on. On a cluster, a chunk whose worker dies is done again by
    another; each chunk's file is written once, by this process, so that workers need no common disk.
    """
    measures = _checked(report)
    if isinstance(chunk, bool) or not isinstance(chunk, (int, np.integer)) or chunk < 1:
        raise InputError(f"chunk: {chunk!r} must be a whole number from 1", field="chunk", value=chunk)
    all_designs = designs if isinstance(designs, Sequence) else list(designs)
    chunks = range(0, len(all_designs), int(chunk))
    target = None if output is None else _Dataset(Path(output), all_designs, measures, int(chunk))
    done = {} if target is None else target.finished()
    left = [first for first in chunks if first not in done]
    parts: dict[int, Any] = dict(done)
    if client is None:
        for first in left:
            rows = _solve(first, _part(all_designs, first, chunk), measures)
            parts[first] = rows if target is None else target.write(first, _arrow(rows))
    else:
        for first, table in _on_cluster(client, all_designs, left, int(chunk), measures, progress):
            parts[first] = table if target is None else target.write(first, table)
    rows = [row for first in sorted(parts) for row in _rows(parts[first])]
    return Sweep(_arrays(rows), None if target is None else target.path)


def _part(designs: Sequence[Design | Manipulator], first: int, chunk: int) -> list[Design]:
    some = itertools.islice(range(first, len(designs)), chunk)
    return [_design(designs[place]) for place in some]


def _design(design: Design | Manipulator) -> Design:
    return design if isinstance(design, Design) else Design({}, design)


def _on_cluster(
    client: Any, designs: Sequence[Design | Manipulator], left: list[int], chunk: int, measures: tuple[Measure, ...], progress: bool
) -> Iterator[tuple[int, Any]]:
    import cloudpickle
    import distributed

    packed = cloudpickle.dumps(measures)
    # Not pure: the same chunk asked for twice, by two sweeps, is done twice and shared by none.
    futures = {
        client.submit(_solve_arrow, first, _part(designs, first, chunk), packed, pure=False): first for first in left
    }
    if progress:
        distributed.progress(list(futures))
    for future, table in distributed.as_completed(list(futures), with_results=True):
        yield futures.pop(future), table
        future.release()


def _arrow(rows: list[dict[str, Any]]) -> Any:
    """Rows as an Arrow table; types depend on names and kinds only, so that all chunks of a dataset agree."""
    import pyarrow

    def column(name: str, values: list[Any]) -> Any:
        if name == "design":
            return pyarrow.array(values, pyarrow.int64())
        if name == "error" or any(isinstance(value, str) for value in values):
            return pyarrow.array(values, pyarrow.string())
        return pyarrow.array([None if value is None else float(value) for value in values], pyarrow.float64())

    return pyarrow.table({name: column(name, values) for name, values in _columns(rows).items()})


def _rows(part: Any) -> list[dict[str, Any]]:
    rows: list[dict[str, Any]] = part if isinstance(part, list) else part.to_pylist()
    return rows


def _arrays(rows: list[dict[str, Any]]) -> dict[str, NDArray[Any]]:
    columns = _columns(rows) or {"design": [], "error": []}
    arrays: dict[str, NDArray[Any]] = {}
    for name, values in columns.items():
        text = name == "error" or any(isinstance(value, str) for value in values)
        kind: Any = np.int64 if name == "design" else object if text else np.float64
        arrays[name] = np.array(values, dtype=kind)
        arrays[name].flags.writeable = False
    return arrays


class _Dataset:
    """A folder with a file for each chunk, and one that says what they answer."""

    def __init__(self, path: Path, designs: Sequence[Design | Manipulator], measures: tuple[Measure, ...], chunk: int) -> None:
        self.path = path
        digest = hashlib.sha256()
        for place in range(len(designs)):
            design = _design(designs[place])
            digest.update(json.dumps(dict(design.parameters)).encode() + design.manipulator.to_json().encode())
        manifest = {
            "schema": "assur/sweep/1",
            "designs": len(designs),
            "chunk": chunk,
            "report": [_name(measure) for measure in measures],
            "fingerprint": digest.hexdigest(),
        }
        path.mkdir(parents=True, exist_ok=True)
        written = path / _MANIFEST
        if written.exists():
            found = json.loads(written.read_text())
            if found != manifest:
                different = [key for key in manifest if found.get(key) != manifest[key]]
                raise InputError(
                    f"output: {path} holds another sweep, with other {', '.join(different)}", field="output", value=str(path)
                )
        else:
            _replace(written, json.dumps(manifest, indent=2).encode())

    def _file(self, first: int) -> Path:
        return self.path / f"part-{first:012d}.parquet"

    def finished(self) -> dict[int, Any]:
        """The chunks that are there, by their first design."""
        import pyarrow.parquet

        files = sorted(self.path.glob("part-*.parquet"))
        return {int(file.stem.removeprefix("part-")): pyarrow.parquet.read_table(file) for file in files}

    def write(self, first: int, table: Any) -> Any:
        """A chunk's file, which appears whole or not at all."""
        import pyarrow
        import pyarrow.parquet

        sink = pyarrow.BufferOutputStream()
        pyarrow.parquet.write_table(table, sink)
        _replace(self._file(first), sink.getvalue().to_pybytes())
        return table


def _replace(path: Path, content: bytes) -> None:
    temporary = path.with_name(f"{path.name}.{os.getpid()}.tmp")
    temporary.write_bytes(content)
    temporary.replace(path)
