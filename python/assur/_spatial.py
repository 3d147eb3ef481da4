"""What the spatial robots have in common: they come from files or mappings, print well and never change."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import Any, ClassVar, Self

from ._problems import Problem
from ._report import block

#: Most cells along a side, and most sections, of a map.
MOST_CELLS, MOST_SECTIONS = 2000, 100


class Spatial:
    """A spatial robot."""

    __slots__ = ("_model", "_problem")

    #: What the compiled part knows it as.
    _compiled: ClassVar[Any]
    _problem: Problem

    def __init__(self, problem: Problem) -> None:
        self._problem = problem
        self._model = self._compiled.parse(problem.text, problem.name)

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Self:
        """The robot in a model file, TOML or JSON.

        Raises
        ------
        ModelError
            One line that names file, field and value, which are attributes as well.
        """
        return cls(Problem.of(path))

    @classmethod
    def from_dict(cls, model: Mapping[str, Any]) -> Self:
        """The robot in a mapping with the keys of a model file.

        Raises
        ------
        ModelError
            As :meth:`from_file`.
        """
        return cls(Problem.of(dict(model)))

    def to_dict(self) -> dict[str, Any]:
        """The model as a mapping with the keys of its file."""
        return self._problem.document()

    @property
    def name(self) -> str:
        """The name for people."""
        name: str = self._model.name
        return name

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.name!r})"

    def _repr_html_(self) -> str:
        rows = [[key, str(value)] for key, value in self.to_dict().items() if key not in ("schema", "name")]
        return block(f"{type(self).__name__} {self.name}".rstrip(), [["field", "value"], *rows])

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Spatial) and type(other) is type(self) and self._problem == other._problem

    def __hash__(self) -> int:
        return hash(self._problem)

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (self._problem,)
