"""Velocities of spatial robots in many poses: those of each pose alone, to the letter; bad rows masked with their reason."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest

import assur

from .conftest import EXAMPLES

HANA = assur.Hana.from_file(EXAMPLES / "hana.toml")
ROBOTS = {name: assur.Tripod.from_file(EXAMPLES / f"tripod-{name}.toml") for name in ("cartesian", "5dof", "upright")}


def _same(batch: Any, one: Any, row: int, names: tuple[str, ...]) -> None:
    for name in names:
        found, expected = getattr(batch, name)[row], getattr(one, name)
        assert np.asarray(found).tolist() == np.asarray(expected).tolist(), name
    for what, inputs, pose in (
        ("rates", "inputs_if_pose", "pose_if_inputs"),
        ("accelerations", "input_accelerations_if_pose", "pose_accelerations_if_inputs"),
    ):
        answered = getattr(one, what)
        for array, expected in ((inputs, "inputs_if_pose"), (pose, "pose_if_inputs")):
            found = getattr(batch, array)
            if answered is None:
                assert found is None
            elif getattr(answered, expected) is None:
                assert found[row].mask.all()
            else:
                assert found[row].tolist() == getattr(answered, expected).tolist(), array


def test_hana(rng: np.random.Generator) -> None:
    poses = np.column_stack([rng.uniform(-6, 5, 60), rng.uniform(-14, -8, 60), rng.uniform(-2, 2, 60)])
    poses[3], poses[4, 2] = np.nan, np.pi / 2
    poses[5] = [40.0, 0.0, 0.0]
    rates, accelerations = rng.normal(size=(60, 3)), [0.5, -1.0, 2.0]
    names = ("inputs", "pose_matrix", "input_matrix", "det_pose", "det_input", "sigma_min", "sigma_min_input", "dexterity")
    for moving, pushing in ((rates, accelerations), (None, accelerations), (rates, None), (None, None)):
        batch = HANA.velocity(poses, rates=moving, accelerations=pushing)
        answered = 0
        for row, pose in enumerate(poses.tolist()):
            if row in batch.errors:
                assert batch.mask[row] and batch.inputs.mask[row].all()
                with pytest.raises(assur.InputError):
                    HANA.velocity(pose)
                continue
            one = HANA.velocity(pose, rates=None if moving is None else moving[row], accelerations=pushing)
            assert batch.SINGULARITIES[batch.singularities[row]] == one.singularity
            _same(batch, one, row, names)
            answered += 1
        assert answered > 40 and {3, 5} <= set(batch.errors) and "does not reach" in str(batch.errors[5])
        assert batch.singularities[4] == 2
    with pytest.raises(assur.InputError, match='mode "+*+": must be 3 signs'.replace("+", r"\+").replace("*", r"\*")):
        HANA.velocity(poses, "+*+")


@pytest.mark.parametrize("name", ROBOTS)
def test_tripods(name: str, rng: np.random.Generator) -> None:
    robot = ROBOTS[name]
    turns = rng.uniform(-0.5, 0.5, size=(40, 3))
    poses = np.hstack([rng.uniform(100, 300, size=(40, 3)), turns])
    if name == "5dof":
        way = [solution.pose for solution in robot.pointed([200, 260, 240], [0.43, 0.43, 0.79])]
        poses = np.array([[*pose.position, *pose.rotation.ravel()] for pose in way] * 20)
    poses[7] = np.inf
    names = ("inputs", "jacobian", "det_jacobian", "position_volume", "orientation_volume")
    for width in {6, robot.degrees_of_freedom}:
        rates, accelerations = rng.normal(size=(40, width)), rng.normal(size=width)
        batch = robot.velocity(poses, rates=rates, accelerations=accelerations)
        answered = 0
        for row, pose in enumerate(poses.tolist()):
            if row in batch.errors:
                assert batch.mask[row]
                continue
            one = robot.velocity(pose, rates=rates[row], accelerations=accelerations)
            assert (batch.singularities[row] == 0) == (one.singularity == "none")
            _same(batch, one, row, names)
            answered += 1
        assert 7 in batch.errors and answered > 30


def test_singular_poses() -> None:
    # Level axes on vertical rails leave the platform free to turn and to move while it is level.
    upright = ROBOTS["upright"].to_dict()
    for leg in upright["legs"]:
        leg["v"] = [leg["v"][0], leg["v"][1], 0.0]
    robot = assur.Tripod.from_dict(upright)
    poses = np.array([[0.0, 0.0, 0.0, 0.0, 0.0, 0.3], [0.0, 0.0, 0.0, 0.31, 0.1, 0.0]])
    batch = robot.velocity(poses, rates=np.ones(6))
    assert [batch.SINGULARITIES[code] for code in batch.singularities] == ["both", "none"]
    assert [robot.velocity(pose).singularity for pose in poses.tolist()] == ["type 2", "none"]
    for volume in (batch.orientation_volume, batch.position_volume):
        assert abs(volume[0]) < 1e-9 < abs(volume[1])
    assert batch.pose_if_inputs is not None and batch.pose_if_inputs.mask.all(axis=1).tolist() == [True, False]


def test_rows_of_rates_that_cannot_be_asked() -> None:
    rates = np.ones((3, 3))
    rates[1, 2] = np.nan
    batch = HANA.velocity(np.tile([0.5, -9.0, 0.1], (3, 1)), rates=rates)
    assert list(batch.errors) == [1] and "rate 3" in str(batch.errors[1]) and batch.mask.tolist() == [False, True, False]
    for robot, pose in ((ROBOTS["cartesian"], np.array([[200.0, 260, 240, 0.1, 0, 0]])), (ROBOTS["5dof"], np.zeros((1, 12)))):
        with pytest.raises(assur.InputError, match="^rates: "):
            robot.velocity(pose, rates=[[1.0, 2.0], [3.0]])
        batch = robot.velocity(pose, accelerations=[np.inf] * 6)
        assert list(batch.errors) == [0] and "acceleration 1" in str(batch.errors[0])


def test_shapes_nothing_and_copies() -> None:
    robot = ROBOTS["cartesian"]
    assert robot.velocity(np.empty((0, 6)), rates=np.ones(6)).jacobian.shape == (0, 6, 6)
    assert HANA.velocity(np.empty((0, 3))).pose_matrix.shape == (0, 3, 3)
    batch = robot.velocity(np.array([[200.0, 260, 240, 0.1, 0, 0], [np.nan] * 6]))
    again = pickle.loads(pickle.dumps(batch))
    assert repr(again) == repr(batch) and again.jacobian.tolist() == batch.jacobian.tolist() and batch.inputs_if_pose is None
    assert "error" in repr(batch) and batch._repr_html_().startswith("<div><b>")
    with pytest.raises(assur.InputError, match=r"pose: shape \(2, 5\) must be \(n, 6\)"):
        robot.velocity(np.zeros((2, 5)))
    with pytest.raises(assur.InputError, match=r"rates: shape \(3, 6\) must be \(6,\) or \(2, 6\)"):
        robot.velocity(np.zeros((2, 6)), rates=np.zeros((3, 6)))
