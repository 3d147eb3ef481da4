"""Problem files: a path, or a mapping with the same keys, as the text that the library reads."""

from __future__ import annotations

import json
import math
import os
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from .errors import ModelError

ProblemLike: TypeAlias = "str | os.PathLike[str] | Mapping[str, Any]"

#: What errors call a problem that came as a mapping.
_MAPPING = "dict.json"


class Problem(NamedTuple):
    """The text of a problem, and what errors call it."""

    text: str
    name: str

    @classmethod
    def of(cls, problem: ProblemLike) -> Problem:
        """The text of a file, or of a mapping as JSON."""
        if isinstance(problem, Mapping):
            return cls(json.dumps(_plain(problem, "")), _MAPPING)
        path = Path(problem)
        try:
            return cls(path.read_text(encoding="utf-8"), str(path))
        except (OSError, UnicodeDecodeError) as error:
            reason = error.strerror if isinstance(error, OSError) else str(error)
            raise ModelError(f"{path}: cannot be read: {reason}", file=str(path)) from None

    def document(self) -> dict[str, Any]:
        """The problem as plain values."""
        text = self.text.removeprefix("\ufeff")
        is_json = self.name.lower().endswith(".json") or text.lstrip().startswith("{")
        found: dict[str, Any] = json.loads(text) if is_json else tomllib.loads(text)
        return found


def _plain(value: Any, place: str) -> Any:
    """Plain values only: arrays become lists, and what JSON cannot say is refused with its place."""
    if isinstance(value, np.ndarray):
        return _plain(value.tolist(), place)
    if isinstance(value, np.generic):
        return _plain(value.item(), place)
    if isinstance(value, float) and not math.isfinite(value):
        raise ModelError(f"dict: {place or 'file'}: {value} must be finite", file="dict", field=place, value=value)
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    if isinstance(value, Mapping):
        return {str(key): _plain(inner, f"{place}.{key}" if place else str(key)) for key, inner in value.items()}
    if isinstance(value, Sequence):
        return [_plain(inner, f"{place}[{index}]") for index, inner in enumerate(value)]
    kind = type(value).__name__
    raise ModelError(f"dict: {place or 'file'}: {kind} must be a number, text, list or mapping", file="dict", field=place)
