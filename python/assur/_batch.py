"""What answers to many rows have in common: the rows that could not be asked, and how they show themselves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from . import _assur
from ._report import block, text_table
from .errors import InputError


class RowErrors(Mapping[int, InputError]):
    """The rows of a batch that could not be asked, by number from 0, each with its reason as an exception."""

    def __init__(self, errors: _assur.RowErrors | dict[int, InputError]) -> None:
        self._errors = errors

    def __len__(self) -> int:
        return len(self._errors)

    def __iter__(self) -> Iterator[int]:
        if isinstance(self._errors, dict):
            return iter(self._errors)
        return (int(row) for row in self._errors.rows())

    def __getitem__(self, row: int) -> InputError:
        error = self._errors.get(row) if row >= 0 else None
        if error is None:
            raise KeyError(row)
        error.row = row
        return error

    def __repr__(self) -> str:
        shown = [f"{row}: {self[row]}" for row, _ in zip(self, range(3), strict=False)]
        more = ", ..." if len(self) > len(shown) else ""
        return "{" + ", ".join(shown) + more + "}"

    def __reduce__(self) -> tuple[Any, ...]:
        return RowErrors, (dict(self.items()),)


class Batch:
    """Answers to many rows."""

    errors: RowErrors

    def _title(self) -> str:
        raise NotImplementedError

    def _table(self) -> list[list[str]]:
        raise NotImplementedError

    def _summary(self) -> str:
        return f"{len(self.errors)} rows with an error: {self.errors!r}" if self.errors else ""

    def __repr__(self) -> str:
        return "\n".join(part for part in (self._title(), text_table(self._table()), self._summary()) if part)

    def _repr_html_(self) -> str:
        return block(self._title(), self._table(), self._summary())
