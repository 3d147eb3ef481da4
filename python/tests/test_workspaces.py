"""Workspaces: the command line's report, membership against the inverse problem, shapely's area, pictures."""

from __future__ import annotations

import math
import pickle
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

import assur

from .conftest import EXAMPLES

MODELS = sorted((EXAMPLES / "workspaces").glob("table1-*.toml"))
ROBOT = assur.Manipulator.from_file(EXAMPLES / "workspaces" / "table1-1a.toml")

#: Kinds with their angles in degrees, as the shipped models' files are written.
KINDS: dict[str, dict[str, float]] = {
    "constant": {"phi": 30.0},
    "maximal": {},
    "inclusive": {"lower": 0.0, "upper": 60.0},
    "total": {"lower": 30.0, "upper": 35.0},
    "dextrous": {},
}
OPTIONS = {"phi": "--phi", "lower": "--from", "upper": "--to"}


def _asked(kind: str) -> dict[str, Any]:
    return {name: math.radians(angle) for name, angle in KINDS[kind].items()}


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("path", MODELS, ids=lambda path: path.stem)
def test_reports_are_the_command_lines(cli: Callable[..., str], path: Path, kind: str, tmp_path: Path) -> None:
    robot = assur.Manipulator.from_file(path)
    options = [f"{OPTIONS[name]}={angle!r}" for name, angle in KINDS[kind].items()]
    found = robot.workspace(kind, **_asked(kind))
    svg = tmp_path / "workspace.svg"
    assert found.to_json() == cli("workspace", path, kind, *options, "--svg", svg, "--json")
    assert found.area == pytest.approx(sum(loop.area for loop in found.loops), abs=1e-9)
    signs = robot.workspace(kind, **_asked(kind), mode="+++")
    assert signs.to_json() == cli("workspace", path, kind, *options, "--mode=+++", "--json")


@pytest.mark.parametrize("kind", KINDS)
def test_membership_is_the_inverse_problems(kind: str, rng: np.random.Generator) -> None:
    region = ROBOT.workspace(kind, **_asked(kind))
    points = rng.uniform([-20, 0], [20, 30], size=(300, 2))
    found = region.memberships(points)
    assert np.array_equal(found.inside, region.contains(points)) and len(found.binding) == 300

    def allowed(x: float, y: float, phi: float) -> bool:
        return any(not mode.violations for mode in ROBOT.inverse([x, y, phi]))

    sure = np.abs(found.margin) > 0.05
    assert sure.sum() > 50
    for (x, y), inside in zip(points[sure][:60], found.inside[sure][:60], strict=True):
        if kind == "constant":
            assert allowed(x, y, math.radians(30.0)) == inside
        elif kind == "maximal" and not inside:
            assert not any(allowed(x, y, phi) for phi in np.linspace(-np.pi, np.pi, 90))


@pytest.mark.parametrize("kind", ["constant", "maximal", "inclusive"])
@pytest.mark.parametrize("path", MODELS[:4], ids=lambda path: path.stem)
def test_shapely_has_the_same_area(path: Path, kind: str) -> None:
    region = assur.Manipulator.from_file(path).workspace(kind, **_asked(kind))
    shape = region.to_shapely(points=400)
    assert isinstance(shape, shapely.MultiPolygon) and shape.is_valid
    assert shape.area == pytest.approx(region.area, rel=1e-4, abs=1e-6)
    if region.bbox is not None:
        assert np.allclose(shape.bounds, region.bbox, atol=1e-3)


def test_regions_travel_and_show_themselves() -> None:
    region = ROBOT.workspace("maximal")
    again = pickle.loads(pickle.dumps(region))
    points = np.array([[0.0, 20.0], [100.0, 0.0]])
    assert again == region and np.array_equal(again.contains(points), region.contains(points))
    assert "area" in repr(region) and (region.svg() or "").count("<svg") == 1
    ax = region.plot()
    assert ax.patches and ax.get_title().startswith("maximal")


def test_nothing_is_an_answer() -> None:
    empty = ROBOT.workspace("dextrous")
    assert empty.area == 0 and not empty.loops and "empty" in repr(empty)
    assert empty.to_shapely().is_empty and empty.plot() is not None
    assert not empty.contains([[0.0, 0.0]]).any()


def test_what_cannot_be_asked_is_named() -> None:
    with pytest.raises(assur.InputError, match="kind: 'whole' must be one of constant"):
        ROBOT.workspace("whole")
    with pytest.raises(assur.InputError, match="phi: the kind constant needs it"):
        ROBOT.workspace("constant")
    with pytest.raises(assur.InputError, match="upper: the kind maximal takes none"):
        ROBOT.workspace("maximal", upper=1.0)
    with pytest.raises(assur.InputError, match=r"points: shape \(3,\) must be \(n, 2\)"):
        ROBOT.workspace().contains([1.0, 2.0, 3.0])
    with pytest.raises(assur.InputError, match=r"points: row 1: \[nan, 0.0\] must be finite"):
        ROBOT.workspace().contains([[0.0, 0.0], [np.nan, 0.0]])
    with pytest.raises(assur.InputError, match="mode"):
        ROBOT.workspace(mode="+*+")
    with pytest.raises(assur.InputError) as caught:
        assur.Manipulator.from_file(EXAMPLES / "3-prp.toml").workspace()
    assert (caught.value.leg, caught.value.field) == (1, "joints")
    with pytest.raises(assur.InputError, match="not finite|must be finite"):
        ROBOT.workspace("constant", phi=np.nan)


def test_sweeps_measure_workspaces(cli: Callable[..., str], tmp_path: Path) -> None:
    path = EXAMPLES / "workspaces" / "table1-1a.toml"
    found = assur.sweep(
        assur.vary(ROBOT, {"leg1.platform.at.x": np.linspace(20, 30, 5)}), ["area:maximal", "holes:constant:0.5", "xmin:maximal"]
    )
    vary = ["--vary", "leg1.platform.at.x=20:30:5", "--report", "area:maximal,xmin:maximal", "--output", tmp_path / "out.csv"]
    cli("sweep", path, *vary)
    lines = [line.split(",") for line in (tmp_path / "out.csv").read_text().splitlines()]
    column = lines[0].index("area:maximal")
    assert [float(line[column]) for line in lines[1:]] == found["area:maximal"].tolist()
    assert (found["holes:constant:0.5"] >= 0).all() and (found["xmin:maximal"] < 0).all()
