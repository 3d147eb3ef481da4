"""A planar parallel manipulator with three actuators, and what can be asked of it."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _assur
from ._arrays import FloatArray, number, one_or_rows, optional_vector, rows, spread, vector, whole
from ._problems import Problem
from ._report import Report, block, result
from .claims import Verification
from .errors import InputError
from .loci import SingularityLoci
from .modes import AssemblyModes, ModesBatch
from .motion import Velocity, WorkingModes
from .paths import FollowedPath
from .poses import VelocityBatch, WorkingModesBatch
from .workspaces import Region, StrokeVoid

__all__ = ["Manipulator"]

#: How far a claimed pose may be from a mode, as on the command line: radians, and displacements over the size.
TOLERANCE = 1e-6


class Manipulator:
    """A planar parallel manipulator: a platform on three legs (or two), with three actuators.

    Made from a model file (:meth:`from_file`), from a mapping with the same keys (:meth:`from_dict`), or as an example of a family
    (:meth:`of_family`). It never changes. Lengths are in the model's unit; angles are radians in every call and answer, whatever unit
    the file is written in.

    Examples
    --------
    >>> import assur
    >>> robot, inputs = assur.Manipulator.of_family("3-RPR")
    >>> answer = robot.forward(inputs)
    >>> answer.account.degree
    6
    """

    __slots__ = ("_model",)

    def __init__(self, model: _assur.Model) -> None:
        self._model = model

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> Manipulator:
        """The manipulator in a model file, TOML or JSON by its ending.

        Raises
        ------
        ModelError
            One line that names file, leg, field and value, which are attributes as well.
        """
        return cls(_assur.Model.read(Path(path)))

    @classmethod
    def from_dict(cls, model: Mapping[str, Any]) -> Manipulator:
        """The manipulator in a mapping with the keys of a model file; lists may be arrays.

        Raises
        ------
        ModelError
            As :meth:`from_file`.
        """
        text, name = Problem.of(dict(model))
        return cls(_assur.Model.parse(text, name))

    @classmethod
    def of_family(cls, family: str) -> tuple[Manipulator, FloatArray]:
        """A manipulator of a family, with inputs to try.

        Parameters
        ----------
        family : str
            ``"3-RPR"``, ``"3-RRR"``, ``"3-PRR"``, ``"3-RRP"``, ``"3-PRP"``, ``"3-PPR"``, ``"3-RPP"``, with the actuated joint marked
            ``"3-_R_RR"``, or three legs ``"R_P_R,_P_RR,_R_RR"``.
        """
        try:
            model, inputs = _assur.Model.of_family(family)
        except ValueError as error:
            raise InputError(str(error), field="family", value=family) from None
        return cls(model), np.array(inputs)

    def to_dict(self) -> dict[str, Any]:
        """The model as a mapping with the keys of a model file, numbers to the last bit."""
        document: dict[str, Any] = json.loads(self._model.to_json())
        return document

    def to_json(self) -> str:
        """The model as a JSON model file."""
        return self._model.to_json()

    def to_toml(self) -> str:
        """The model as a commented TOML model file."""
        return self._model.to_toml()

    def with_numbers(self, numbers: Mapping[str, float]) -> Manipulator:
        """This manipulator with some numbers of the design changed.

        Parameters
        ----------
        numbers : mapping from key to float
            Keys as on the command line: ``"leg1.platform.at.x"``, ``"leg2.base.angle"``, ``"leg1.links2"`` (a length),
            ``"leg3.limits.max"``, ``"legs.links1"`` of every leg, ``"reference.x"``. Angles in radians.

        Raises
        ------
        InputError
            A key that names no number of the design.
        ModelError
            Numbers that make no manipulator.
        """
        return Manipulator(self._model.with_numbers([(key, number(key, value)) for key, value in numbers.items()]))

    @property
    def name(self) -> str:
        """The name for people."""
        return self._model.name

    @property
    def family(self) -> str:
        """The family: ``"3-R_P_R"``, actuated joints between underscores."""
        return self._model.family

    @property
    def angle_unit(self) -> str:
        """The unit of angles in the model's file, ``"rad"`` or ``"deg"``; calls and answers are in radians all the same."""
        return self._model.angle_unit

    @property
    def title(self) -> str:
        """The name, or the family where there is none."""
        return self.name or self.family

    def check(self) -> dict[str, Any]:
        """What mechanism this is: legs, locked group, degree bound, remarks."""
        document: dict[str, Any] = json.loads(self._model.check())
        return document

    def _repr_html_(self) -> str:
        check = self.check()
        bound = "" if check["degree_bound"] is None else f", at most {check['degree_bound']} assembly modes"
        remarks = [["remark"], *([remark["text"]] for remark in check["remarks"])] if check["remarks"] else []
        return block(self.title, remarks, f"{check['family']}, locked {check['group'] or 'no triad'}{bound}")

    def __repr__(self) -> str:
        return f"Manipulator({self.title!r}, {self.family})"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Manipulator) and self.to_json() == other.to_json()

    def __hash__(self) -> int:
        return hash(self.to_json())

    def __reduce__(self) -> tuple[Any, ...]:
        return _from_json, (self.to_json(),)

    @overload
    def forward(self, inputs: list[float] | tuple[float, float, float], *, certify: bool = False) -> AssemblyModes: ...
    @overload
    def forward(self, inputs: ArrayLike, *, certify: Literal[True]) -> AssemblyModes: ...
    @overload
    def forward(self, inputs: ArrayLike, *, certify: bool = False) -> Any: ...
    def forward(self, inputs: ArrayLike, *, certify: bool = False) -> Any:
        """Every assembly mode for given actuator values.

        Parameters
        ----------
        inputs : array_like, shape (3,) or (n, 3)
            Actuator values, leg 1 first; lengths, or radians. A C-contiguous float64 array is read where it is, without copying.
        certify : bool
            Whether the answer is to be proved; for one row only.

        Returns
        -------
        AssemblyModes
            For one row: all modes, non-real solutions, the account, on request the proofs.
        ModesBatch
            For ``(n, 3)``: the poses alone, on all processors, with the interpreter lock released. A row that cannot be asked is masked
            and has its reason in ``errors``. Memory: 146 bytes a row.

        Raises
        ------
        InputError
            A wrong shape or dtype; for one row also values that are not finite or outside limits.

        Examples
        --------
        >>> import assur, numpy as np
        >>> robot, inputs = assur.Manipulator.of_family("3-RPR")
        >>> many = robot.forward(np.array([inputs, 1.1 * inputs]))
        >>> many.poses.shape
        (2, 6, 3)
        """
        given = one_or_rows("inputs", inputs, 3)
        if isinstance(given, list):
            return result(AssemblyModes, self._model.forward(given, bool(certify)), self)
        if certify:
            raise InputError("certify: proofs are for one row of inputs, shape (3,)", field="certify", value=True)
        return self.forward_batch(given)

    def forward_batch(self, inputs: ArrayLike) -> ModesBatch:
        """:meth:`forward` of many rows, shape ``(n, 3)``, under a name that is always the batch."""
        given = rows("inputs", inputs, 3)
        return ModesBatch._of(given, self._model.forward_batch(given))

    def certify(self, inputs: ArrayLike) -> AssemblyModes:
        """:meth:`forward` of one row, proved: a box around every mode that holds it and no other."""
        return result(AssemblyModes, self._model.forward(vector("inputs", inputs, 3), True), self)

    @overload
    def inverse(self, pose: list[float] | tuple[float, float, float]) -> WorkingModes: ...
    @overload
    def inverse(self, pose: ArrayLike) -> Any: ...
    def inverse(self, pose: ArrayLike) -> Any:
        """Every working mode of a pose, or of many.

        Parameters
        ----------
        pose : array_like, shape (3,) or (n, 3)
            ``x, y, phi`` of the platform in the base frame; ``phi`` in radians. A C-contiguous float64 array is read where it is.

        Returns
        -------
        WorkingModes
            For one pose; without modes where a leg does not reach, with how far it misses.
        WorkingModesBatch
            For ``(n, 3)``: joint values ``(n, modes, legs, 3)``, masked where a row has no such mode, on all processors. A row that is not
            finite is masked and has its reason in ``errors``.

        Raises
        ------
        InputError
            A wrong shape or dtype; for one pose also numbers that are not finite.

        Examples
        --------
        >>> import assur, numpy as np
        >>> robot, inputs = assur.Manipulator.of_family("3-RPR")
        >>> many = robot.inverse(np.array([[5.5, 4.0, 0.3], [5.0, 4.0, 0.2]]))
        >>> many.inputs[:, many.place("+++")].shape
        (2, 3)
        """
        given = one_or_rows("pose", pose, 3)
        if isinstance(given, list):
            return result(WorkingModes, self._model.inverse(given), self)
        return WorkingModesBatch._of(given, self._model.inverse_batch(given), self._actuated())

    @overload
    def velocity(
        self,
        pose: list[float] | tuple[float, float, float],
        mode: str | None = None,
        *,
        rates: ArrayLike | None = None,
        accelerations: ArrayLike | None = None,
        wrench: ArrayLike | None = None,
        length: float | None = None,
    ) -> Velocity: ...
    @overload
    def velocity(
        self,
        pose: ArrayLike,
        mode: str | None = None,
        *,
        rates: ArrayLike | None = None,
        accelerations: ArrayLike | None = None,
        wrench: ArrayLike | None = None,
        length: float | None = None,
    ) -> Any: ...
    def velocity(
        self,
        pose: ArrayLike,
        mode: str | None = None,
        *,
        rates: ArrayLike | None = None,
        accelerations: ArrayLike | None = None,
        wrench: ArrayLike | None = None,
        length: float | None = None,
    ) -> Any:
        """The two matrices of a pose, its kind of singularity, and its motion and forces.

        Parameters
        ----------
        pose : array_like, shape (3,) or (n, 3)
            ``x, y, phi``.
        mode : str, optional
            The working mode, as ``"+-+"``; without it the only one, or the only one within the limits.
        rates : array_like, shape (3,) or (n, 3), optional
            Of the platform or of the actuators: answered both ways. Per unit of time, angles in radians.
        accelerations : array_like, shape (3,) or (n, 3), optional
            The same, at these rates; at rest without them.
        wrench : array_like, shape (3,) or (n, 3), optional
            Force and moment on the platform, about its origin. One row is for all poses.
        length : float, optional
            What weighs turning against moving; the platform's size without it.

        Returns
        -------
        Velocity
            For one pose.
        VelocityBatch
            For ``(n, 3)``: matrices, determinants, singularities, rates, accelerations and forces as arrays, on all processors. A row that cannot be asked is
            masked and has its reason in ``errors``.

        Raises
        ------
        InputError
            A wrong shape or dtype, a mode that is none; for one pose also a leg that does not reach, a mode that could be several, numbers
            that are not finite.
        """
        given = one_or_rows("pose", pose, 3)
        size = None if length is None else number("length", length)
        if isinstance(given, list):
            answer = self._model.velocity(
                given,
                mode,
                optional_vector("rates", rates, 3),
                optional_vector("accelerations", accelerations, 3),
                optional_vector("wrench", wrench, 3),
                size,
            )
            return result(Velocity, answer, self)
        asked = {"rates": rates, "accelerations": accelerations, "wrench": wrench}
        moving = {what: np.empty((0, 3)) if one is None else spread(what, one, len(given), 3) for what, one in asked.items()}
        batch = self._model.velocity_batch(given, mode, moving["rates"], moving["accelerations"], moving["wrench"], size)
        return VelocityBatch._of(given, batch, {what for what, one in asked.items() if one is not None})

    def stroke_voids(self) -> tuple[StrokeVoid | None, ...]:
        """What the stroke of each leg leaves out around its middle; none for a leg that is no PRR leg whose slider has a range.

        Examples
        --------
        >>> import assur
        >>> leg = {"joints": "_P_RR", "base": {"at": [0, 0]}, "links": [0, 2], "platform": {"at": [1, 0]}, "limits": [1, 3]}
        >>> robot = assur.Manipulator.from_dict({"schema": "assur/manipulator/1", "leg": [leg, leg, leg]})
        >>> robot.stroke_voids()[0].kind
        'lens'
        """
        return tuple(None if found is None else StrokeVoid._of(*found) for found in self._model.stroke_voids())

    def _actuated(self) -> NDArray[np.bool_]:
        """Whether each joint of each leg is actuated, shape ``(legs, 3)``."""
        return np.array([[joint in leg["actuated"] for joint in (1, 2, 3)] for leg in self.check()["legs"]])

    def singularities(
        self, phi: float, mode: str | None = None, *, map: str | None = None, polynomial: bool = True
    ) -> SingularityLoci:
        """Where the manipulator is singular for an orientation, and how well it is held elsewhere.

        Parameters
        ----------
        phi : float
            The orientation, radians.
        mode : str, optional
            One working mode; all without it. A map is of this mode, or of the first.
        map : {"dexterity", "accuracy", "stiffness"}, optional
            A quantity over the plane.
        polynomial : bool
            Whether the exact curve of all modes is wanted: below a millisecond for 3-RPR, seconds for 3-RRR.
        """
        known = ("dexterity", "accuracy", "stiffness")
        if map is not None and map not in known:
            raise InputError(f"map: {map!r} must be one of {', '.join(known)}", field="map", value=map)
        answer = self._model.singularities(number("phi", phi), mode, map, bool(polynomial))
        return result(SingularityLoci, answer, self)

    def follow(self, path: ArrayLike, start: ArrayLike | None = None) -> FollowedPath:
        """One assembly mode followed through rows of inputs, each stretch shown to hold no other.

        Parameters
        ----------
        path : array_like, shape (n, 3)
            Rows of actuator values.
        start : array_like, shape (3,), optional
            Pose of the mode at the first row; without it the first mode.

        Raises
        ------
        InputError
            A row that is not finite, a start that is no mode.
        """
        answer = self._model.follow(rows("path", path, 3), optional_vector("start", start, 3))
        return result(FollowedPath, answer, self)

    def workspace(
        self,
        kind: str = "maximal",
        *,
        phi: float | None = None,
        lower: float | None = None,
        upper: float | None = None,
        mode: str = "both",
        assembly: ArrayLike | None = None,
        slices: int | None = None,
        gradient: str | Sequence[str] = (),
        optimise: Mapping[str, tuple[float, float]] | None = None,
        overlays: Sequence[str | tuple[Any, ...]] = (),
    ) -> Region:
        """Where the reference point can reach, exactly; of legs RPR, RRR and PRR in any mixture.

        Parameters
        ----------
        kind : {"constant", "maximal", "inclusive", "total", "dextrous"}
            Reached with the orientation ``phi``; with some orientation; with some between ``lower`` and ``upper``; with every one between
            them; with every orientation.
        phi, lower, upper : float
            Radians; a range runs counter-clockwise, equal ends are that single orientation, a full turn or more is every one.
        mode : str
            ``"both"``, or a sign for each leg.
        assembly : array_like, shape (3,), optional
            With ``"maximal"``: only what the assembly in this pose reaches without being taken apart.
        slices : int, optional
            So many constant-orientation workspaces over the orientations of the kind, and the volume of them all: ``Region.stack``.
        gradient : str or sequence of str
            Numbers of the design, as in :meth:`with_numbers`, by which the area is derived: ``Region.gradient``.
        optimise : mapping from key to (low, high), optional
            Numbers of the design with bounds within which the largest area is sought: ``Region.optimum``. Some hundred workspaces.
        overlays : sequence of str or tuple, optional
            Other kinds to be drawn over it, ``Region.overlays``: ``"dextrous"``, ``("constant", phi)``, ``("inclusive", lower, upper)``.

        Raises
        ------
        InputError
            A leg that is not covered or not bounded, angles that the kind does not take or lacks, a key that names no number.
        """
        pose = optional_vector("assembly", assembly, 3)
        if pose is not None and kind != "maximal":
            raise InputError("assembly: goes with the kind maximal", field="assembly", value=kind)
        question: dict[str, Any] = {
            "kind": kind,
            "angles": _angles_of(kind, phi, lower, upper),
            "mode": mode,
            "assembly": pose,
            "slices": None if slices is None else whole("slices", slices, 1, MOST_SLICES),
            "gradient": [gradient] if isinstance(gradient, str) else list(gradient),
            "optimise": [(key, _bounds(key, ends)) for key, ends in (optimise or {}).items()],
            "overlays": [_overlay(other) for other in overlays],
        }
        answer, shape = self._model.workspace(question)
        found = result(Region, answer, (self, question))
        # The cache of the property: what is there need not be made again.
        found.__dict__["_shape"] = shape
        return found

    def verify(
        self, claims: Report | Mapping[str, Any] | str | os.PathLike[str], tolerance: float = TOLERANCE
    ) -> Verification:
        """Whether claimed poses are assembly modes, each proven or refuted, and which modes the claims miss.

        Parameters
        ----------
        claims : result, mapping or path
            An answer of :meth:`forward`; or a mapping or file of any program with ``inputs`` and ``poses``, a list of ``[x, y, phi]``.
        tolerance : float
            How far a claim may be from a mode: radians, and displacements over the mechanism's size.
        """
        if isinstance(claims, Report):
            text, name = claims.to_json(), "report.json"
        else:
            text, name = Problem.of(claims)
        return result(Verification, self._model.verify(text, name, number("tolerance", tolerance)), self)

    def frames(self, joints: ArrayLike) -> FloatArray:
        """Where the joints of every leg are, for given joint values.

        Parameters
        ----------
        joints : array_like, shape (legs, 3)
            As :attr:`Mode.joints`.

        Returns
        -------
        ndarray, shape (legs, 3, 2, 3)
            ``x, y, angle`` of the frame before and after each joint, in the base frame.
        """
        values = rows("joints", joints, 3)
        return self._model.frames(values.tolist()).reshape(len(values), 3, 2, 3)


#: The angles that each kind of workspace takes.
_TAKES = {"constant": ("phi",), "maximal": (), "inclusive": ("lower", "upper"), "total": ("lower", "upper"), "dextrous": ()}


#: Most slices of a stack.
MOST_SLICES = 10_000


def _bounds(key: str, ends: ArrayLike) -> list[float]:
    low, high = vector(key, ends, 2)
    if not (np.isfinite(low) and np.isfinite(high) and low < high):
        raise InputError(f"optimise: {key}: bounds {low}, {high} must be finite and ascend", field="optimise", value=(low, high))
    return [low, high]


def _overlay(other: str | tuple[Any, ...]) -> tuple[str, list[float]]:
    kind, *angles = (other,) if isinstance(other, str) else other
    needed = _TAKES.get(kind) if isinstance(kind, str) else None
    if needed is None:
        raise InputError(f"overlays: {kind!r} must be one of {', '.join(_TAKES)}", field="overlays", value=kind)
    if len(angles) != len(needed):
        wanted = ", ".join(needed) or "no angles"
        raise InputError(f"overlays: {kind} has {len(angles)} angles, must have {wanted}", field="overlays", value=kind)
    return kind, _angles_of(kind, **{"phi": None, "lower": None, "upper": None, **dict(zip(needed, angles, strict=True))})


def _angles_of(kind: str, phi: float | None, lower: float | None, upper: float | None) -> list[float]:
    if kind not in _TAKES:
        raise InputError(f"kind: {kind!r} must be one of {', '.join(_TAKES)}", field="kind", value=kind)
    given = {"phi": phi, "lower": lower, "upper": upper}
    for name, value in given.items():
        if value is None and name in _TAKES[kind]:
            raise InputError(f"{name}: the kind {kind} needs it", field=name)
        if value is not None and name not in _TAKES[kind]:
            raise InputError(f"{name}: the kind {kind} takes none", field=name, value=value)
    return [0.0 if value is None else number(name, value) for name, value in given.items()]


def _from_json(text: str) -> Manipulator:
    return Manipulator(_assur.Model.parse(text, "pickle.json"))


