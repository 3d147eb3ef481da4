"""What cannot be asked or read, with the place of the mistake as attributes.

"No assembly mode", "self-motion" and "undecided" are answers, not errors.
"""

from __future__ import annotations

from typing import Any

__all__ = ["AssurError", "InputError", "ModelError"]

_PLACE = ("file", "row", "leg", "joint", "field", "value")


class AssurError(ValueError):
    """A question that cannot be asked; the message is the command line's.

    Attributes
    ----------
    file : str or None
        The file, where there is one.
    row : int or None
        Row of a path, from 1; of a batch, from 0.
    leg, joint : int or None
        Leg and joint, from 1.
    field : str or None
        Field of the file, or quantity: ``"links[0].at"``, ``"inputs"``, ``"pose"``.
    value : object
        What was found there.
    """

    file: str | None
    row: int | None
    leg: int | None
    joint: int | None
    field: str | None
    value: object

    def __init__(
        self,
        message: str,
        *,
        file: str | None = None,
        row: int | None = None,
        leg: int | None = None,
        joint: int | None = None,
        field: str | None = None,
        value: object = None,
    ) -> None:
        super().__init__(message)
        self.file, self.row, self.leg, self.joint = file, row, leg, joint
        self.field, self.value = field, value

    def __reduce__(self) -> tuple[Any, ...]:
        # Keyword arguments do not survive the pickling of exceptions by themselves.
        return _again, (type(self), str(self), {name: getattr(self, name) for name in _PLACE})


def _again(kind: type[AssurError], message: str, place: dict[str, Any]) -> AssurError:
    return kind(message, **place)


class ModelError(AssurError):
    """A file or description that holds no sound model or problem."""


class InputError(AssurError):
    """Inputs, a pose or an option that a sound model cannot be asked about."""
