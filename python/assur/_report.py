"""Reports of the library as frozen results.

A result's fields are those of the report that the command line prints with ``--json``, under the same names; lists of numbers become
read-only arrays. The report itself stays with the result, to the letter.
"""

from __future__ import annotations

import base64
import dataclasses
import html
import json
import types
import typing
from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import Any, ClassVar, TypeVar

import numpy as np
from numpy.typing import NDArray

from . import _assur
from ._arrays import FloatArray, read_only

ComplexArray: typing.TypeAlias = NDArray[np.complex128]
T = TypeVar("T")

#: Digits of a number in a table.
_DIGITS = 12


class Evidence:
    """The report as the library gave it, and its drawing, made when somebody looks."""

    def __init__(self, answer: _assur.Answer | None, text: str, svg: str | None = None) -> None:
        self._answer, self.text, self._svg = answer, text, svg

    def svg(self) -> str | None:
        """The drawing, made once."""
        if self._svg is None and self._answer is not None:
            self._svg, self._answer = self._answer.svg(), None
        return self._svg

    def __reduce__(self) -> tuple[Any, ...]:
        # What draws lives in this process only; the drawing travels.
        return Evidence, (None, self.text, self.svg())


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Report:
    """What every answer has: fields, a table to print, a drawing, and the report itself.

    Two results are equal where their reports are.
    """

    _evidence: Evidence = dataclasses.field(repr=False, kw_only=True)
    _origin: Any = dataclasses.field(default=None, repr=False, kw_only=True)

    #: Keys of the report that are no Python names, and the fields that hold them.
    _renamed: ClassVar[Mapping[str, str]] = {}

    def to_json(self) -> str:
        """The report, letter by letter what the command line prints with ``--json``."""
        return self._evidence.text

    def to_dict(self) -> dict[str, Any]:
        """The report as plain values."""
        document: dict[str, Any] = json.loads(self._evidence.text)
        return document

    def svg(self) -> str | None:
        """The drawing as an SVG document, by the library itself; none where no drawing shows this."""
        return self._evidence.svg()

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Report) or type(other) is not type(self):
            return NotImplemented
        return self.to_json() == other.to_json()

    def __hash__(self) -> int:
        return hash(self.to_json())

    def __repr__(self) -> str:
        return "\n".join(part for part in (self._title(), text_table(self._table()), self._summary()) if part)

    def _repr_svg_(self) -> str | None:
        return self.svg()

    def _repr_html_(self) -> str:
        return block(self._title(), self._table(), self._summary(), self.svg())

    # What a kind of result says of itself.

    def _title(self) -> str:
        return type(self).__name__

    def _table(self) -> list[list[str]]:
        """Header and rows; none where a table says nothing."""
        return []

    def _summary(self) -> str:
        return ""


R = TypeVar("R", bound=Report)


def result(kind: type[R], answer: _assur.Answer, origin: object = None) -> R:
    """The result of a kind that a report holds."""
    document = json.loads(answer.json)
    values = fields_of(kind, document)
    return kind(**values, _evidence=Evidence(answer, answer.json), _origin=origin)


@lru_cache(maxsize=None)
def _hints(kind: type) -> dict[str, Any]:
    return typing.get_type_hints(kind)


def fields_of(kind: type, document: Mapping[str, Any]) -> dict[str, Any]:
    """The fields of a dataclass from a table of a report; what the report leaves out is none."""
    prepared = getattr(kind, "_prepared", None)
    document = document if prepared is None else prepared(document)
    hints = _hints(kind)
    renamed: Mapping[str, str] = getattr(kind, "_renamed", {})
    values = {renamed.get(key, key): value for key, value in document.items()}
    names = [f.name for f in dataclasses.fields(kind) if not f.name.startswith("_")]
    return {name: convert(hints[name], values.get(name)) for name in names}


def convert(hint: Any, value: Any) -> Any:
    """A value of a report as a field's type says."""
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if origin in (typing.Union, types.UnionType):
        if value is None:
            return None
        (inner,) = (argument for argument in arguments if argument is not type(None))
        return convert(inner, value)
    if hint in (FloatArray, ComplexArray):
        return _array(hint, value)
    if origin is tuple:
        # A report may leave out a list that is empty.
        return tuple(convert(arguments[0], item) for item in value or ())
    if dataclasses.is_dataclass(hint):
        assert isinstance(hint, type)
        return hint(**fields_of(hint, value))
    if hint is complex:
        return complex(*value)
    if hint is float:
        return float(value)
    return value


def _array(hint: Any, value: Sequence[Any]) -> NDArray[np.generic]:
    array: NDArray[np.generic]
    if hint == ComplexArray:
        parts = np.asarray(value, dtype=np.float64).reshape(-1, 2)
        array = parts[:, 0] + 1j * parts[:, 1]
    else:
        array = np.asarray(value, dtype=np.float64)
    read_only(array)
    return array


def number(value: float) -> str:
    """A number in a table."""
    return f"{value:.{_DIGITS}g}"


def numbers(values: typing.Iterable[float]) -> str:
    """Numbers in a table."""
    return ", ".join(number(value) for value in values)


def counted(count: int, what: str) -> str:
    """So many of something: ``1 row``, ``2 rows``."""
    return f"{count} {what}" if count == 1 else f"{count} {what}s"


def text_table(table: list[list[str]]) -> str:
    """A table as aligned columns."""
    if not table:
        return ""
    widths = [max(len(row[column]) for row in table) for column in range(len(table[0]))]
    return "\n".join("  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True)) for row in table)


def block(title: str, table: list[list[str]], summary: str = "", drawing: str | None = None) -> str:
    """A result in a notebook: title, drawing, table, summary."""
    style = "max-width: 100%; height: auto"
    picture = "" if drawing is None else f"<img style='{style}' alt='{html.escape(title)}' src='{_data_uri(drawing)}'>"
    text = f"<p>{html.escape(summary)}</p>" if summary else ""
    return f"<div><b>{html.escape(title)}</b>{picture}{_html_table(table)}{text}</div>"


def _html_table(table: list[list[str]]) -> str:
    if not table:
        return ""
    head = "".join(f"<th>{html.escape(cell)}</th>" for cell in table[0])
    body = "".join("<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in row) + "</tr>" for row in table[1:])
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _data_uri(svg: str) -> str:
    # As a picture of its own: names inside one drawing never meet those of another on the page.
    return "data:image/svg+xml;base64," + base64.b64encode(svg.encode()).decode()
