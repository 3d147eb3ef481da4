"""Results are frozen, print well, show themselves, travel, and carry everything the report says."""

from __future__ import annotations

import copy
import dataclasses
import doctest
import importlib
import pickle
import pkgutil
import re
from typing import Any

import numpy as np
import pytest

import assur
from assur._report import Report

from .conftest import EXAMPLES, MODELS, in_radians

ROBOT = assur.Manipulator.from_file(EXAMPLES / "3-rpr.toml")
INPUTS = [14.98, 15.38, 12.0]
HANA = assur.Hana.from_file(EXAMPLES / "hana.toml")
ARM = assur.Manipulator.from_file(EXAMPLES / "workspaces" / "table1-1a.toml")
HEXAPTERON = assur.Multipteron.from_file(EXAMPLES / "hexapteron.toml")
TRIPOD = assur.Tripod.from_file(EXAMPLES / "tripod-cartesian.toml")


def answers() -> list[Report]:
    """One answer of every kind."""
    modes = ROBOT.certify(INPUTS)
    pose = modes[0].pose
    rows = np.array([INPUTS]) * np.linspace(1, 0.8, 5)[:, np.newaxis]
    assert modes.triad is not None
    return [
        modes,
        assur.triad(modes.triad),
        ROBOT.inverse(pose),
        ROBOT.velocity(pose, "+++", rates=[1, 0, 0], accelerations=[0, 0, 1], wrench=[0, 1, 0]),
        ROBOT.singularities(0.3, map="dexterity"),
        ROBOT.follow(rows),
        ROBOT.verify(modes),
        assur.group(EXAMPLES / "seven-link.json"),
        assur.group(EXAMPLES / "chain.json", inputs=[0.1]),
        assur.coupler(EXAMPLES / "coupler.json"),
        HANA.inverse([-2, -12, 0.3]),
        HANA.forward([1, -0.5, 0.3]),
        HANA.velocity([-2, -12, 0.3], rates=[1, 0, 0]),
        HANA.workspace(),
        ARM.workspace(),
        ARM.workspace("inclusive", lower=3.5, upper=4.5),
        HANA.capability([-2, -12], cells=8, strokes=[1, 2]),
        TRIPOD.inverse([200, 260, 240, 0.1, 0.05, -0.03]),
        TRIPOD.forward([240, 254, 188, 164, 92, 47]),
        TRIPOD.velocity([200, 260, 240, 0.1, 0.05, -0.03]),
        TRIPOD.tilt([163.4, 163.4, 163.4]),
        TRIPOD.tilt_map([0, 0, 0], [400, 400, 400], sections=2, cells=3),
        assur.Tripod.determinant_curves("inclined", [[0, 0, 0, 0.1, 0.2, 0]], points=5),
        HEXAPTERON.forward([0.8, 1.2, 0.9, 0.4, 1.1, 0.7]),
        HEXAPTERON.inverse([20, -10, 30, 0.1, 0, 0.2]),
        ARM.workspace("constant", phi=4.2, slices=2, gradient=["leg1.limits.max"], optimise={"leg1.limits.max": (20.0, 30.0)}),
    ]


ANSWERS = answers()
each = pytest.mark.parametrize("answer", ANSWERS, ids=lambda answer: type(answer).__name__)


def _plain(value: Any) -> Any:
    """A field as the report has it."""
    if isinstance(value, np.ndarray):
        if value.dtype.kind == "c":
            return [[float(z.real), float(z.imag)] for z in value.ravel()]
        return [None if np.isnan(x) else float(x) for x in value.ravel()]
    if isinstance(value, complex):
        return [value.real, value.imag]
    if isinstance(value, tuple):
        return [_plain(item) for item in value]
    return value


def _flat(value: Any) -> Any:
    """Nested lists of numbers as one list, of pairs as one list of pairs."""
    array = np.array(value, dtype=object)
    return array.ravel().tolist()


def _compare(document: Any, found: Any, place: str) -> None:
    """Every entry of a report is in the result, under its name and with its value."""
    if dataclasses.is_dataclass(found):
        renamed = getattr(type(found), "_renamed", {})
        names = {field.name for field in dataclasses.fields(found)}
        for key, value in document.items():
            name = renamed.get(key, key)
            if key == "schema":
                continue
            assert name in names, f"{place}.{key} of the report is not in {type(found).__name__}"
            _compare(value, getattr(found, name), f"{place}.{key}")
        return
    if isinstance(found, tuple) and found and dataclasses.is_dataclass(found[0]):
        assert len(document) == len(found), place
        for number, (inner, item) in enumerate(zip(document, found, strict=True)):
            _compare(inner, item, f"{place}[{number}]")
        return
    if isinstance(document, list):
        assert _flat(document) == _flat(_plain(found)), place
    elif not (isinstance(document, dict) and "singular" in document):
        assert document == _plain(found), place


@each
def test_every_entry_of_the_report_is_a_field(answer: Report) -> None:
    _compare(answer.to_dict(), answer, type(answer).__name__)


@each
def test_results_are_frozen(answer: Report) -> None:
    for field in dataclasses.fields(answer):
        with pytest.raises(dataclasses.FrozenInstanceError):
            setattr(answer, field.name, None)
        value = getattr(answer, field.name)
        if isinstance(value, np.ndarray):
            assert not value.flags.writeable, field.name


@each
def test_results_print_and_show_themselves(answer: Report) -> None:
    text = repr(answer)
    assert text and "object at 0x" not in text and "nan" not in text.lower()
    assert answer._repr_html_().startswith("<div>")
    svg = answer._repr_svg_()
    assert svg is None or svg.startswith("<svg") or "<svg" in svg[:200]


@each
def test_results_travel(answer: Report) -> None:
    again = pickle.loads(pickle.dumps(answer))
    assert again == answer and hash(again) == hash(answer)
    assert repr(again) == repr(answer) and again.svg() == answer.svg()
    assert copy.deepcopy(answer) == answer


def test_robots_and_sweeps_show_themselves() -> None:
    study = assur.sweep(assur.vary(ROBOT, {"leg2.base.at.x": np.linspace(10, 20, 30)}), "degree")
    for thing in (ROBOT, HANA, TRIPOD, HEXAPTERON, study, ROBOT.forward(np.array([INPUTS, INPUTS]))):
        shown = thing._repr_html_()
        assert shown.startswith("<div><b>") and shown.endswith("</div>") and "<td>" in shown or thing is ROBOT
    assert "10 more rows" in study._repr_html_()


def test_batches_travel() -> None:
    batch = ROBOT.forward(np.array([INPUTS, [np.nan, 0, 0]]))
    again = pickle.loads(pickle.dumps(batch))
    assert np.array_equal(again.poses.data, batch.poses.data) and str(again.errors[1]) == str(batch.errors[1])


def test_manipulators_travel_and_compare() -> None:
    again = pickle.loads(pickle.dumps(ROBOT))
    assert again == ROBOT and hash(again) == hash(ROBOT) and again is not ROBOT
    assert again.forward(INPUTS) == ROBOT.forward(INPUTS)
    assert pickle.loads(pickle.dumps(HANA)) == HANA and HANA != TRIPOD
    assert assur.Hana.from_dict(HANA.to_dict()).forward([1, 0, 0]).account.degree == 8


@pytest.mark.parametrize("name", MODELS)
def test_the_account_adds_up_and_modes_close(name: str) -> None:
    robot = assur.Manipulator.from_file(EXAMPLES / name)
    answer = robot.forward(in_radians(robot, MODELS[name]))
    account = dataclasses.asdict(answer.account)
    assert sum(count for key, count in account.items() if key != "degree") == account["degree"]
    assert answer.residual < 1e-12
    for mode in answer:
        assert mode.joints is not None
        # By another road: each leg's last frame is where the pose puts it.
        x, y, phi = mode.pose
        for leg, frames in zip(robot.to_dict()["leg"], robot.frames(mode.joints), strict=True):
            at = np.array(leg["platform"]["at"])
            turn = np.array([[np.cos(phi), -np.sin(phi)], [np.sin(phi), np.cos(phi)]])
            assert np.allclose(frames[2, 1, :2], [x, y] + turn @ at, atol=1e-9 * answer.size)


def test_proofs_are_carried() -> None:
    answer = ROBOT.certify(INPUTS)
    assert answer.certificate is not None and answer.certificate.complete
    assert all(mode.proof == "proven" and mode.box is not None for mode in answer)
    for mode in answer:
        assert mode.box is not None
        assert (mode.box[:, 0] <= mode.pose).all() and (mode.pose <= mode.box[:, 1]).all()
    assert "proof" in repr(answer)


def test_answers_that_are_none() -> None:
    none = ROBOT.forward([1.0, 1.0, 100.0])
    assert len(none) == 0 and none.status == "complete" and none.poses.shape == (0, 3)
    assert "complete" in repr(none) and none.svg() is not None
    out_of_reach = assur.Manipulator.from_file(EXAMPLES / "3-rrr.toml").inverse([1e6, 0, 0])
    assert not out_of_reach.modes and len(out_of_reach.unreachable_legs) == 3


def test_docstrings() -> None:
    tried = 0
    for info in pkgutil.iter_modules(assur.__path__, "assur."):
        module = importlib.import_module(info.name)
        found = doctest.testmod(module)
        assert not found.failed, info.name
        tried += found.attempted
    assert not doctest.testmod(assur).failed
    assert tried > 10


def test_everything_public_says_what_it_is() -> None:
    for name in assur.__all__:
        thing = getattr(assur, name)
        if isinstance(thing, str):
            continue
        assert thing.__doc__, name
        for member, value in vars(thing).items() if isinstance(thing, type) else ():
            if not member.startswith("_") and (callable(value) or isinstance(value, property)):
                assert value.__doc__, f"{name}.{member}"


@pytest.mark.parametrize("path", ["README.md", "python/README.md"])
def test_readmes_run(path: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(EXAMPLES.parent)
    text = (EXAMPLES.parent / path).read_text()
    blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    assert blocks, "a README begins with something to try"
    for block in blocks:
        assert len(block.strip().splitlines()) < 10, "a first picture in under ten lines"
        exec(compile(block, path, "exec"), {})


def test_the_guide_says_what_happens(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(EXAMPLES.parent)
    text = (EXAMPLES.parent / "docs" / "src" / "python.md").read_text()
    blocks = re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    session = doctest.DocTestParser().get_doctest("\n".join(blocks), {}, "python.md", "python.md", 0)
    assert len(session.examples) > 30
    failed, _ = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS).run(session)
    assert not failed
