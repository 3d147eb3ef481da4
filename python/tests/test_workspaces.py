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

from .conftest import EXAMPLES, written

MODELS = sorted((EXAMPLES / "workspaces").glob("table1-*.toml"))
ROBOT = assur.Manipulator.from_file(EXAMPLES / "workspaces" / "table1-1a.toml")

#: Kinds with their angles in degrees, as the shipped models' files are written.
KINDS: dict[str, dict[str, float]] = {
    "constant": {"phi": 240.0},
    "maximal": {},
    "inclusive": {"lower": 200.0, "upper": 260.0},
    "total": {"lower": 250.0, "upper": 255.0},
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
            assert allowed(x, y, math.radians(240.0)) == inside
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


def _random_arm(rng: np.random.Generator) -> dict[str, Any]:
    """Three legs at random of those that workspaces are about, with limits of their own size."""

    def point(size: float) -> list[float]:
        return [float(value) for value in rng.uniform(-size, size, size=2)]

    def leg() -> dict[str, Any]:
        kind, low = str(rng.choice(["R_P_R", "_R_RR", "_P_RR"])), float(rng.uniform(1, 6))
        found: dict[str, Any] = {"joints": kind, "base": {"at": point(6)}, "platform": {"at": point(3)}}
        if kind == "R_P_R":
            found["limits"] = [low, low + float(rng.uniform(1, 6))]
        elif kind == "_R_RR":
            found |= {"links": [low, float(rng.uniform(2, 7))]}
        else:
            found["base"]["angle"] = float(rng.uniform(-3, 3))
            found |= {"links": [0.0, low + 2.0], "limits": [-low, float(rng.uniform(1, 8))]}
        return found

    return {"schema": "assur/manipulator/1", "leg": [leg(), leg(), leg()]}


def test_random_workspaces(cli: Callable[..., str], tmp_path: Path, rng: np.random.Generator) -> None:
    areas = []
    for _ in range(8):
        model = _random_arm(rng)
        robot, path = assur.Manipulator.from_dict(model), written(model, tmp_path)
        phi = float(rng.uniform(-3, 3))
        constant, maximal = robot.workspace("constant", phi=phi), robot.workspace()
        assert constant.to_json() == cli("workspace", path, "constant", f"--phi={phi!r}", "--json")
        assert maximal.to_json() == cli("workspace", path, "maximal", "--json")
        assert constant.area <= maximal.area * (1 + 1e-12)
        areas.append(maximal.area)
    assert sum(area > 0 for area in areas) > 4


def test_files_slices_slopes_and_optima(cli: Callable[..., str], tmp_path: Path) -> None:
    path = EXAMPLES / "workspaces" / "table1-1a.toml"
    keys = ["leg1.limits.max", "leg2.base.at.x"]
    asked: dict[str, Any] = {"slices": 5, "gradient": keys, "optimise": {"leg1.platform.at.x": (20.0, 30.0)}}
    found = ROBOT.workspace("inclusive", lower=math.radians(200.0), upper=math.radians(260.0), **asked)
    options = ["--slices=5", *(f"--gradient={key}" for key in keys), "--optimise=leg1.platform.at.x=20:30"]
    files = ["--dxf", tmp_path / "reach.dxf", "--csv", tmp_path / "reach.csv"]
    range_ = ["--from=200", "--to=260", "--json"]
    assert found.to_json() == cli("workspace", path, "inclusive", *range_, *options, *files)
    assert found.to_dxf() == (tmp_path / "reach.dxf").read_text()
    assert found.to_csv() == (tmp_path / "reach.csv").read_text()
    assert found.stack is not None and found.gradient is not None and found.optimum is not None
    assert [one.phi for one in found.stack.slices] == pytest.approx(np.linspace(math.radians(200), math.radians(260), 5))
    assert found.stack.volume / math.radians(60) == pytest.approx(np.mean([one.area for one in found.stack.slices]), rel=0.2)
    step = 1e-5
    moved = ROBOT.with_numbers({keys[0]: 12.0 + step})
    wider = moved.workspace("inclusive", lower=math.radians(200.0), upper=math.radians(260.0))
    assert (wider.area - found.area) / step == pytest.approx(found.gradient[keys[0]], rel=1e-4)
    best = ROBOT.with_numbers(found.optimum.values).workspace("inclusive", lower=math.radians(200.0), upper=math.radians(260.0))
    assert best.area == pytest.approx(found.optimum.area, rel=1e-12) and best.area >= found.area
    assert len(found.slice_outlines()) == 5 and pickle.loads(pickle.dumps(found)).slice_outlines(8) is not None
    ax = found.plot_slices()
    assert len(ax.lines) == sum(len(one.loops) for one in found.stack.slices)


def test_regions_over_one_another() -> None:
    ax = ROBOT.workspace().plot(label="maximal")
    assert ROBOT.workspace("constant", phi=4.2).plot(ax, label="constant") is ax
    assert ROBOT.workspace("dextrous").plot(ax, label="dextrous") is ax
    names = ax.get_legend_handles_labels()[1]
    assert names == ["maximal", "constant", "dextrous (empty)"]
    assert len({line.get_color() for line in ax.lines if not str(line.get_label()).startswith("_")}) == 3


def test_overlays(cli: Callable[..., str]) -> None:
    path = EXAMPLES / "workspaces" / "table1-2c.toml"
    robot = assur.Manipulator.from_file(path)
    overlays: list[str | tuple[Any, ...]] = ["dextrous", ("constant", math.radians(30.0)), ("total", math.radians(10.0), math.radians(20.0))]
    found = robot.workspace("inclusive", lower=0.0, upper=math.radians(90.0), overlays=overlays)
    options = ["--overlay", "dextrous", "--overlay", "constant:30", "--overlay", "total:10:20", "--json"]
    assert found.to_json() == cli("workspace", path, "inclusive", "--from=0", "--to=90", *options)
    assert [other.kind for other in found.overlays] == ["dextrous", "constant", "total"]
    alone = robot.workspace("constant", phi=math.radians(30.0))
    assert found.overlays[1].area == alone.area
    outlines = found.overlay_outlines()
    assert [len(loops) for loops in outlines] == [len(other.loops) for other in found.overlays]
    assert all(np.array_equal(a, b) for a, b in zip(outlines[1], alone.outlines(), strict=True))
    labels = found.plot().get_legend_handles_labels()[1]
    assert len(labels) == 4 and labels[0] == "inclusive" and labels[2].startswith("constant at phi")
    assert "constant, φ = 30" in (found.svg() or "")
    again = pickle.loads(pickle.dumps(found))
    assert again == found and again.overlay_outlines()[1][0].shape == outlines[1][0].shape
    bad: dict[str | tuple[Any, ...], str] = {"round": "overlays: 'round' must be", ("total", 1.0): "total has 1 angles, must have lower, upper"}
    for wrong, reason in bad.items():
        with pytest.raises(assur.InputError, match=reason):
            robot.workspace(overlays=[wrong])


def test_stroke_voids() -> None:
    robot = assur.Manipulator.from_file(EXAMPLES / "workspaces" / "prr-symmetric-radial-void.toml")
    voids = robot.stroke_voids()
    for void, leg in zip(voids, robot.to_dict()["leg"], strict=True):
        assert void is not None and void.kind == "lens" and void.points.shape == (2, 2) and void.area > 0
        # The tips are a link's length from both ends of the stroke, so twice the height of the lens is their distance.
        low, high = leg["limits"]["1"]
        link = float(np.hypot(*leg["links"][1]["at"]))
        apart = float(np.linalg.norm(np.subtract(*void.points)))
        assert apart == pytest.approx(2 * math.sqrt(link**2 - ((high - low) / 2) ** 2))
    assert assur.Manipulator.of_family("3-RPR")[0].stroke_voids() == (None, None, None)


def test_one_assembly_alone() -> None:
    robot = ROBOT.with_numbers({"leg1.limits.min": 11.5})
    whole = robot.workspace()
    places = np.mgrid[-15:15:0.5, 5:25:0.5].reshape(2, -1).T
    inside = places[np.argmax(whole.memberships(places).margin)]
    turns = np.linspace(0, 2 * np.pi, 3600)
    phi = next(phi for phi in turns if any(not mode.violations for mode in robot.inverse([*inside, phi])))
    one = robot.workspace(assembly=[*inside, phi])
    assert 0 < one.area < whole.area and one.assembly is not None
    with pytest.raises(assur.InputError, match="goes with the kind maximal"):
        robot.workspace("dextrous", assembly=[0.0, 0.0, 0.0])
    with pytest.raises(assur.InputError, match="not of one assembly"):
        one.contains([[0.0, 0.0]])


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
    with pytest.raises(assur.InputError, match="slices: 0 must be a whole number from 1"):
        ROBOT.workspace(slices=0)
    with pytest.raises(assur.InputError, match="optimise: leg1.limits.max: bounds 3.0, 2.0 must be finite and ascend"):
        ROBOT.workspace(optimise={"leg1.limits.max": (3.0, 2.0)})
    with pytest.raises(assur.InputError, match="no number of a design"):
        ROBOT.workspace(gradient="leg1.colour")
    with pytest.raises(assur.InputError, match="points: -1 must be a whole number from 2"):
        ROBOT.workspace().outlines(-1)
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
