"""Every answer is the command line's, letter by letter, on all shipped models and on random ones."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import assur

from .conftest import EXAMPLES, MODELS, in_radians, joined, random_inputs, random_model, written

Cli = Callable[..., str]
shipped = pytest.mark.parametrize("name", MODELS)


def _opened(name: str) -> tuple[Path, assur.Manipulator, list[float]]:
    path = EXAMPLES / name
    robot = assur.Manipulator.from_file(path)
    return path, robot, in_radians(robot, MODELS[name])


def _angle(robot: assur.Manipulator, phi: float) -> float:
    return math.radians(phi) if robot.angle_unit == "deg" else phi


@shipped
def test_forward_and_certify(cli: Cli, name: str) -> None:
    path, robot, inputs = _opened(name)
    asked = f"--inputs={joined(MODELS[name])}"
    assert robot.forward(inputs).to_json() == cli("forward", path, asked, "--json")
    assert robot.certify(inputs).to_json() == cli("forward", path, asked, "--certify", "--json")
    assert robot.forward(inputs, certify=True) == robot.certify(inputs)


@shipped
def test_pictures(cli: Cli, name: str, tmp_path: Path) -> None:
    path, robot, inputs = _opened(name)
    cli("forward", path, f"--inputs={joined(MODELS[name])}", "--svg", tmp_path / "modes.svg", "--json")
    assert robot.forward(inputs).svg() == (tmp_path / "modes.svg").read_text()


@shipped
def test_inverse_and_velocity(cli: Cli, name: str) -> None:
    path, robot, inputs = _opened(name)
    modes = robot.forward(inputs).modes
    assert modes, "the inputs a model says to try have a mode"
    x, y, phi = modes[0].pose
    shown = math.degrees(phi) if robot.angle_unit == "deg" else phi
    pose = [float(x), float(y), _angle(robot, float(shown))]
    asked = f"--pose={joined([x, y, shown])}"
    assert robot.inverse(pose).to_json() == cli("inverse", path, asked, "--json")
    signs = modes[0].signs or ""
    options = ["--rates=1,0.5,-0.25", "--accelerations=0.5,0,1", "--wrench=0,-10,2", "--length=2.5"]
    found = robot.velocity(
        pose, signs, rates=[1, 0.5, -0.25], accelerations=[0.5, 0, 1], wrench=[0, -10, 2], length=2.5
    )
    assert found.to_json() == cli("velocity", path, asked, f"--mode={signs}", *options, "--json")


@pytest.mark.parametrize("name", ["3-rpr.toml", "3-rrr.toml", "3-prp.toml"])
def test_singularities(cli: Cli, name: str) -> None:
    path, robot, _ = _opened(name)
    phi = 17.0 if robot.angle_unit == "deg" else 0.3
    mode = f"--mode={'+' * 3}"
    asked = ["--phi", phi, "--map", "dexterity", mode, "--no-polynomial", "--json"]
    found = robot.singularities(_angle(robot, phi), "+++", map="dexterity", polynomial=False)
    assert found.to_json() == cli("singularities", path, *asked)
    if name == "3-rpr.toml":
        assert robot.singularities(phi).to_json() == cli("singularities", path, "--phi", phi, "--json")


@shipped
def test_path(cli: Cli, name: str, tmp_path: Path) -> None:
    path, robot, inputs = _opened(name)
    rows = np.array([inputs]) + np.linspace(0, 0.05, 6)[:, np.newaxis] * np.array([1.0, -0.5, 0.25])
    # The file's own numbers are the degrees; Python gets what the command line makes of them.
    shown = rows.copy()
    first = np.array(MODELS[name])
    turned = first != np.array(inputs)
    shown[:, turned] = np.degrees(rows[:, turned])
    rows[:, turned] = np.radians(shown[:, turned])
    through = tmp_path / "path.csv"
    through.write_text("q1,q2,q3\n" + "\n".join(joined(row) for row in shown) + "\n")
    assert robot.follow(rows).to_json() == cli("path", path, "--through", through, "--json")


@shipped
def test_check_and_model_files(cli: Cli, name: str, tmp_path: Path) -> None:
    import json

    path, robot, inputs = _opened(name)
    assert robot.check() == json.loads(cli("check", path, "--json"))
    again = assur.Manipulator.from_dict(robot.to_dict())
    assert again == robot
    (tmp_path / "again.toml").write_text(robot.to_toml())
    assert assur.Manipulator.from_file(tmp_path / "again.toml").forward(inputs) == robot.forward(inputs)


def test_verify(cli: Cli, tmp_path: Path) -> None:
    path, robot, inputs = _opened("3-rpr.toml")
    answer = robot.forward(inputs)
    (tmp_path / "report.json").write_text(answer.to_json())
    found = robot.verify(answer)
    assert found.to_json() == cli("verify", tmp_path / "report.json", "--model", path, "--json")
    assert [claim.verdict for claim in found.claims] == ["proven"] * 6 and not found.missing
    poses = [[float(value) for value in pose] for pose in answer.poses[1:]]
    shorter = robot.verify({"inputs": inputs, "poses": [*poses, [0.0, 0.0, 0.0]]})
    assert [claim.verdict for claim in shorter.claims] == ["proven"] * 5 + ["refuted"]
    assert [missing.mode for missing in shorter.missing] == [1]


def test_groups(cli: Cli) -> None:
    seven, chain = EXAMPLES / "seven-link.json", EXAMPLES / "chain.json"
    assert assur.group(seven).to_json() == cli("group", seven, "--json")
    assert assur.group(seven, complex=True).to_json() == cli("group", seven, "--complex", "--json")
    assert assur.group(chain, inputs=[0.1]).to_json() == cli("group", chain, "--inputs=0.1", "--json")


def test_coupler(cli: Cli) -> None:
    file = EXAMPLES / "coupler.json"
    found = assur.coupler(file)
    assert found.to_json() == cli("coupler", file, "--json")
    assert found.points.shape == (8, 2)


def test_triad(cli: Cli, tmp_path: Path) -> None:
    import json

    _, robot, inputs = _opened("3-rpr.toml")
    problem = robot.forward(inputs).triad
    assert problem is not None
    (tmp_path / "triad.json").write_text(json.dumps(problem))
    assert assur.triad(problem).to_json() == cli("triad", tmp_path / "triad.json", "--json")
    proved = assur.triad(tmp_path / "triad.json", certify=True)
    assert proved.to_json() == cli("triad", tmp_path / "triad.json", "--certify", "--json")


def test_hana(cli: Cli) -> None:
    file = EXAMPLES / "hana.toml"
    robot = assur.Hana.from_file(file)
    pose = [-2.0, -12.0, math.radians(20.0)]
    assert robot.inverse(pose).to_json() == cli("hana", "inverse", file, "--pose=-2,-12,20", "--json")
    assert robot.forward([1, -0.5, 0.3]).to_json() == cli("hana", "forward", file, "--inputs=1,-0.5,0.3", "--json")
    found = robot.velocity(pose, rates=[1, 0, 0], accelerations=[0, 1, 0])
    options = ["--rates=1,0,0", "--accelerations=0,1,0", "--json"]
    assert found.to_json() == cli("hana", "velocity", file, "--pose=-2,-12,20", *options)
    assert robot.workspace().to_json() == cli("hana", "workspace", file, "reachable", "--json")
    between = robot.workspace(between=[math.radians(-10.0), math.radians(40.0)])
    options = ["reachable", "--from=-10", "--to=40", "--json"]
    assert between.to_json() == cli("hana", "workspace", file, *options)
    constant = robot.workspace("constant", phi=math.radians(20.0))
    assert constant.to_json() == cli("hana", "workspace", file, "constant", "--phi=20", "--json")
    tilts = robot.capability([-2, -12], strokes=[1, 2, 3])
    options = ["--at=-2,-12", "--strokes=1,2,3", "--json"]
    assert tilts.to_json() == cli("hana", "capability", file, *options)
    assert robot.capability(cells=12).to_json() == cli("hana", "capability", file, "--cells=12", "--json")


def test_tripod(cli: Cli) -> None:
    file = EXAMPLES / "tripod-cartesian.toml"
    robot = assur.Tripod.from_file(file)
    pose = [200.0, 260.0, 240.0, *(math.radians(angle) for angle in (10.0, 5.0, -3.0))]
    asked = "--pose=200,260,240,10,5,-3"
    found = robot.inverse(pose)
    assert found.to_json() == cli("tripod", "inverse", file, asked, "--json")
    assert robot.forward(found.inputs).to_json() == cli(
        "tripod", "forward", file, f"--inputs={joined(found.inputs)}", "--json"
    )
    assert robot.forward(found.inputs, certify=True).to_json() == cli(
        "tripod", "forward", file, f"--inputs={joined(found.inputs)}", "--certify", "--json"
    )
    moved = robot.velocity(pose, rates=[1, 0, 0, 0, 0, 0.5])
    assert moved.to_json() == cli("tripod", "velocity", file, asked, "--rates=1,0,0,0,0,0.5", "--json")
    place = [163.4, 163.4, 163.4]
    assert robot.tilt(place).to_json() == cli("tripod", "tilt", file, f"--at={joined(place)}", "--json")
    map_ = robot.tilt_map([0, 0, 0], [400, 400, 400], sections=2, cells=4)
    corners = ["--low=0,0,0", "--high=400,400,400", "--sections=2", "--cells=4"]
    assert map_.to_json() == cli("tripod", "tilt", file, *corners, "--json")


def test_tripods_with_fewer_motors(cli: Cli, tmp_path: Path) -> None:
    file = EXAMPLES / "tripod-5dof.toml"
    robot = assur.Tripod.from_file(file)
    assert (robot.motors, robot.degrees_of_freedom) == ((1, 3, 4, 5, 6), 5)
    place, direction = [200.0, 260.0, 240.0], [0.43, 0.43, 0.79]
    found = robot.pointed(place, direction)
    asked = [f"--pose={joined(place)}", f"--direction={joined(direction)}"]
    assert found.to_json() == cli("tripod", "inverse", file, *asked, "--json")
    assert found.status == "complete" and len(found) == 2
    turned = robot.pointing(direction)
    assert [way.torsion for way in turned] == [way.torsion for way in found]
    assert all(np.array_equal(a.rotation, b.pose.rotation) for a, b in zip(turned, found, strict=True))
    for way in found:
        five = way.inputs[[0, 2, 3, 4, 5]]
        assert robot.forward(five).to_json() == cli("tripod", "forward", file, f"--inputs={joined(five)}", "--json")
        assert robot.forward(five) == robot.forward(way.inputs)
        pose = [*place, *way.pose.rotation.ravel()]
        moved = robot.velocity(pose, rates=[1, 2, 3, 4, 5], accelerations=[0, 0, 1, 0, 0])
        options = ["--rates=1,2,3,4,5", "--accelerations=0,0,1,0,0", "--json"]
        assert moved.to_json() == cli("tripod", "velocity", file, f"--pose={joined(pose)}", *options)
        assert moved.rates is not None and moved.rates.inputs_if_pose is None and moved.rates.pose_if_inputs is not None
        # Sliders of the leg with one motor that part have no motion of the platform, and say so.
        parted = robot.velocity(pose, rates=[1, 0, 0, 0, 0, 0]).rates
        assert parted is not None and parted.pose_if_inputs is None and parted.reasons[0].startswith("leg 1")
    with pytest.raises(assur.InputError, match=r"inputs: shape \(4,\) must be \(5,\) or \(6,\)"):
        robot.forward([1, 2, 3, 4])
    with pytest.raises(assur.InputError, match="leg 1: has one motor") as refused:
        robot.forward([1, 2, 3, 4, 5, 6])
    assert (refused.value.leg, refused.value.field) == (1, "motors")
    # Where every torsion serves that is said, and no torsion is an empty answer.
    free = tmp_path / "free.toml"
    free.write_text(file.read_text().replace("tool_axis = [1.0, 1.0, 1.0]", "tool_axis = [0.0, 1.0, 0.0]"))
    along = assur.Tripod.from_file(free)
    every, none = along.pointed(place, [0, 0.8, 0.6]), along.pointed(place, [0.6, 0.8, 0])
    assert every.to_json() == cli("tripod", "inverse", free, asked[0], "--direction=0,0.8,0.6", "--json")
    assert (every.status, len(every), none.status, len(none)) == ("every_torsion", 1, "complete", 0)
    assert "every torsion serves" in repr(along.pointing([0, 0.8, 0.6]))

    four = assur.Tripod.from_file(EXAMPLES / "tripod-4dof.toml")
    pose = [200.0, 260.0, 240.0, 0.0, math.radians(5.0), 0.0]
    inputs = four.inverse(pose).inputs[[0, 2, 4, 5]]
    asked = [f"--inputs={joined(inputs)}", "--json"]
    assert four.forward(inputs).to_json() == cli("tripod", "forward", EXAMPLES / "tripod-4dof.toml", *asked)
    with pytest.raises(assur.InputError, match="5 degrees of freedom; this one has 4") as refused:
        four.pointing([1, 1, 1])
    assert refused.value.field == "motors"


@pytest.mark.parametrize("name", ["tripteron", "quadrupteron", "hexapteron"])
def test_multipterons(cli: Cli, name: str) -> None:
    file = EXAMPLES / f"{name}.toml"
    robot = assur.Multipteron.from_file(file)
    count = {"tripteron": 3, "quadrupteron": 4, "hexapteron": 6}[name]
    assert (robot.kind, robot.degrees_of_freedom) == (name, count)
    inputs = [0.8, 1.2, 0.9, 0.4, 1.1, 0.7][:count]
    asked = f"--inputs={joined(inputs)}"
    assert robot.forward(inputs).to_json() == cli("multipteron", "forward", file, asked, "--json")
    place = [1.0, 2.0, 3.0]
    found = robot.inverse(place)
    assert found.to_json() == cli("multipteron", "inverse", file, f"--pose={joined(place)}", "--json")
    picture = found.svg()
    assert picture is not None and "</svg>" in picture and "<img" in found._repr_html_()
    back = [mode.pose.position for mode in robot.forward(found.inputs)]
    assert any(np.allclose(position, place) for position in back)


def test_determinant_curves(cli: Cli) -> None:
    poses = [[0.0] * 6, [0.0, 0.0, 0.0, *(math.radians(angle) for angle in (10.0, 5.0, 0.0))]]
    found = assur.Tripod.determinant_curves("upright", poses, points=7)
    asked = ["--pose=0,0,0,0,0,0", "--pose=0,0,0,10,5,0", "--points=7", "--json"]
    assert found.to_json() == cli("tripod", "determinant", "upright", *asked)
    assert found.determinants.shape == (2, 7) and found.elevations[-1] == pytest.approx(math.pi / 2)
    with pytest.raises(assur.InputError, match="design: 'round' must be inclined or upright"):
        assur.Tripod.determinant_curves("round", poses)


def test_random_models(cli: Cli, tmp_path: Path, rng: np.random.Generator) -> None:
    modes = 0
    for _ in range(24):
        model = random_model(rng)
        robot, inputs = assur.Manipulator.from_dict(model), random_inputs(model, rng)
        path = written(model, tmp_path)
        asked = ("forward", path, f"--inputs={joined(inputs)}", "--json")
        try:
            answer = robot.forward(inputs)
        except assur.InputError as error:
            assert f"{path}: {error}" in cli(*asked, fails=True)
            continue
        assert answer.to_json() == cli(*asked)
        modes += len(answer)
        for mode in answer.modes[:1]:
            pose = f"--pose={joined(mode.pose)}"
            assert robot.inverse(mode.pose).to_json() == cli("inverse", path, pose, "--json")
            signs = mode.signs or ""
            moved = robot.velocity(mode.pose, signs, rates=[1, 2, 3]).to_json()
            assert moved == cli("velocity", path, pose, f"--mode={signs}", "--rates=1,2,3", "--json")
        batch = robot.forward(np.array([inputs]))
        np.testing.assert_allclose(batch[0], answer.poses, rtol=1e-7, atol=1e-7 * answer.size)
    assert modes > 10, "hardly a random model had a mode: they test nothing"


def test_batch_is_the_command_lines(cli: Cli, tmp_path: Path, rng: np.random.Generator) -> None:
    path, robot, inputs = _opened("3-rpr.toml")
    rows = np.array(inputs) * rng.uniform(0.8, 1.2, size=(200, 3))
    (tmp_path / "in.csv").write_text("q1,q2,q3\n" + "\n".join(joined(row) for row in rows) + "\n")
    cli("forward", path, "--batch", tmp_path / "in.csv", "--output", tmp_path / "out.csv")
    lines = (tmp_path / "out.csv").read_text().splitlines()[1:]
    batch = robot.forward(rows)
    for row, line in enumerate(lines):
        cells = line.split(",")
        assert int(cells[5]) == batch.counts[row]
        numbers = [float(cell) for cell in cells[6:] if cell]
        assert numbers == batch[row].ravel().tolist()
