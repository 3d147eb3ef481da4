"""Poses that somebody claims, and what is proved of them."""

from __future__ import annotations

from dataclasses import dataclass

from ._arrays import FloatArray
from ._report import Report, number, numbers
from .modes import Certificate

__all__ = ["Claim", "Missing", "Verification"]


@dataclass(frozen=True, eq=False)
class Claim:
    """A claimed pose: ``"proven"``, ``"refuted"`` or ``"undecided"``; modes and claims are counted from 1."""

    pose: FloatArray
    verdict: str
    nearest: int | None
    repeats: int | None
    distance: float | None


@dataclass(frozen=True, eq=False)
class Missing:
    """A mode that no claim is near, with a box that holds it and no other."""

    mode: int
    pose: FloatArray
    box: FloatArray | None


@dataclass(frozen=True, eq=False, repr=False)
class Verification(Report):
    """Each claimed pose proven or refuted, and the modes the claims miss.

    Attributes
    ----------
    tolerance : float
        How far a claim may be from a mode: radians, and displacements over the mechanism's size.
    claims : tuple of Claim
    missing : tuple of Missing
    certificate : Certificate or None
    """

    tolerance: float
    claims: tuple[Claim, ...]
    missing: tuple[Missing, ...]
    certificate: Certificate | None

    def _title(self) -> str:
        return f"{len(self.claims)} claimed poses"

    def _table(self) -> list[list[str]]:
        rows = [
            [str(place), numbers(claim.pose), claim.verdict, "" if claim.distance is None else number(claim.distance)]
            for place, claim in enumerate(self.claims, 1)
        ]
        return [["claim", "pose", "verdict", "distance"], *rows]

    def _summary(self) -> str:
        proof = "" if self.certificate is None else f"; {self.certificate.summary}"
        return f"{len(self.missing)} modes missing{proof}"
