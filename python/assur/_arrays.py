"""Whatever a caller passes as numbers, as arrays the library takes; refused with the exact reason otherwise."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import InputError

FloatArray: TypeAlias = NDArray[np.float64]

#: Most points along a curve.
MOST_POINTS = 1_000_000
#: Kinds of dtype that are real numbers: floats, integers, unsigned integers.
_REAL = "fiu"


def reals(what: str, values: ArrayLike) -> FloatArray:
    """Real numbers in any shape; masked ones are NaN."""
    try:
        found = np.asarray(values)
    except ValueError as error:  # rows of different lengths
        raise InputError(f"{what}: no array of numbers: {error}", field=what) from None
    if found.dtype.kind not in _REAL and found.size:
        raise InputError(f"{what}: dtype {found.dtype} must be real numbers", field=what, value=str(found.dtype))
    if isinstance(values, np.ma.MaskedArray):
        # What is masked is not known, and must not be taken for a number.
        found = np.ma.filled(values.astype(np.float64), np.nan)
    # Without entries any kind will do.
    return np.asarray(found, dtype=np.float64) if found.size else np.zeros(found.shape)


def _wrong_shape(what: str, found: FloatArray, expected: str) -> InputError:
    return InputError(f"{what}: shape {found.shape} must be {expected}", field=what, value=found.shape)


def vector(what: str, values: ArrayLike, *lengths: int) -> list[float]:
    """Numbers as a list; as many as one of ``lengths``."""
    found = reals(what, values)
    if found.shape not in [(length,) for length in lengths]:
        raise _wrong_shape(what, found, " or ".join(f"({length},)" for length in lengths))
    return [float(value) for value in found]


def optional_vector(what: str, values: ArrayLike | None, length: int) -> list[float] | None:
    """``length`` numbers as a list, or nothing."""
    return None if values is None else vector(what, values, length)


def rows(what: str, values: ArrayLike, width: int) -> FloatArray:
    """A C-contiguous array ``(n, width)``; the caller's own memory where it is one already."""
    found = reals(what, values)
    if found.ndim != 2 or found.shape[1] != width:
        raise _wrong_shape(what, found, f"(n, {width})")
    return _packed(found)


def _packed(found: FloatArray) -> FloatArray:
    """C-contiguous and aligned; the array itself where it is both."""
    return np.require(found, requirements=["C", "A"])


def one_or_rows(what: str, values: ArrayLike, width: int) -> list[float] | FloatArray:
    """One row as a list, or many as an array."""
    found = reals(what, values)
    if found.shape == (width,):
        return [float(value) for value in found]
    if found.ndim == 2 and found.shape[1] == width:
        return _packed(found)
    raise _wrong_shape(what, found, f"({width},) or (n, {width})")


def spread(what: str, values: ArrayLike, count: int, width: int) -> FloatArray:
    """One row for all of ``count``, or a row for each."""
    found = reals(what, values)
    if found.shape not in [(width,), (count, width)]:
        raise _wrong_shape(what, found, f"({width},) or ({count}, {width})")
    return _packed(np.broadcast_to(found, (count, width)))


def number(what: str, value: object) -> float:
    """One number."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, float, np.integer, np.floating)):
        raise InputError(f"{what}: {value!r} must be a number", field=what, value=value)
    try:
        return float(value)
    except OverflowError:
        raise InputError(f"{what}: {value!r} must be finite", field=what, value=value) from None


def whole(what: str, value: int, least: int, most: int) -> int:
    """A whole number between two."""
    if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or not least <= value <= most:
        raise InputError(f"{what}: {value!r} must be a whole number from {least} to {most}", field=what, value=value)
    return int(value)


def read_only(array: NDArray[np.generic]) -> None:
    """Freezes an array that belongs to a result."""
    array.flags.writeable = False
