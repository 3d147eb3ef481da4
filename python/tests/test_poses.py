"""Many poses at once: row by row, to the last bit, what each pose alone gets."""

from __future__ import annotations

import pickle

import numpy as np
import pytest
from numpy.typing import NDArray

import assur
from assur.poses import SINGULARITIES

from .conftest import EXAMPLES, MODELS, in_radians, random_model

ROBOT = assur.Manipulator.from_file(EXAMPLES / "3-rpr.toml")
RRR = assur.Manipulator.from_file(EXAMPLES / "3-rrr.toml")

Floats = NDArray[np.float64]


def _near(robot: assur.Manipulator, inputs: list[float], rng: np.random.Generator, count: int) -> Floats:
    """Poses about those of the modes, some out of reach."""
    modes = robot.forward(inputs).poses
    size = np.array([robot.forward(inputs).size] * 2 + [3.0])
    away: Floats = rng.normal(size=(count, 3)) * size * rng.choice([0.0, 0.1, 1.0], size=(count, 1))
    return modes[rng.integers(len(modes), size=count)] + away


def _compare_inverse(robot: assur.Manipulator, poses: Floats) -> int:
    batch = robot.inverse(poses)
    modes = 0
    for row, pose in enumerate(poses):
        one = robot.inverse(pose.tolist())
        assert [batch.signs[k] for k in np.flatnonzero(~batch.mask[row])] == [mode.signs for mode in one]
        assert batch.counts[row] == len(one)
        for mode in one:
            place = batch.place(mode.signs)
            assert batch.joints.data[row, place].tolist() == mode.joints.tolist()
            assert batch.within[row, place] == (not mode.violations)
        misses = {leg.leg: leg.miss for leg in one.unreachable_legs}
        assert batch.misses[row].tolist() == [misses.get(leg, 0.0) for leg in range(1, batch.misses.shape[1] + 1)]
        modes += len(one)
    assert np.array_equal(batch.joints.mask.any(axis=(2, 3)), batch.mask)
    return modes


def _compare_velocity(robot: assur.Manipulator, poses: Floats, signs: str | None, rates: Floats) -> int:
    batch = robot.velocity(poses, signs, rates=rates)
    assert batch.inputs_if_pose is not None and batch.pose_if_inputs is not None
    found = 0
    for row, pose in enumerate(poses):
        try:
            one = robot.velocity(pose.tolist(), signs, rates=rates[row])
        except assur.InputError as error:
            assert batch.mask[row] and str(batch.errors[row]) == str(error)
            assert batch.dexterity.mask[row] and batch.pose_matrix.mask[row].all()
            continue
        found += 1
        assert batch.pose_matrix.data[row].tolist() == one.pose_matrix.tolist()
        assert batch.input_matrix.data[row].tolist() == one.input_matrix.tolist()
        for name in ("det_pose", "det_input", "sigma_min", "sigma_min_input", "dexterity"):
            assert getattr(batch, name)[row] == getattr(one, name), name
        assert SINGULARITIES[batch.singularities[row]] == one.singularity
        assert batch.signs[batch.modes[row]] == one.signs
        assert one.rates is not None
        for there, alone in ((batch.inputs_if_pose, one.rates.inputs_if_pose), (batch.pose_if_inputs, one.rates.pose_if_inputs)):
            assert there.mask[row].all() == (alone is None)
            assert alone is None or there.data[row].tolist() == alone.tolist()
    return found


@pytest.mark.parametrize("name", MODELS)
def test_shipped_models(name: str, rng: np.random.Generator) -> None:
    robot = assur.Manipulator.from_file(EXAMPLES / name)
    poses = _near(robot, in_radians(robot, MODELS[name]), rng, 40)
    assert _compare_inverse(robot, poses) > 0
    rates = rng.normal(size=poses.shape)
    signs = robot.inverse(poses).signs
    assert _compare_velocity(robot, poses, signs[-1], rates) > 0
    _compare_velocity(robot, poses, None, rates)


def test_random_models(rng: np.random.Generator) -> None:
    modes = 0
    for _ in range(12):
        robot = assur.Manipulator.from_dict(random_model(rng))
        size = np.abs(np.array([leg["base"]["at"] for leg in robot.to_dict()["leg"]])).max()
        poses = rng.uniform(-1, 1, size=(20, 3)) * [size, size, np.pi]
        modes += _compare_inverse(robot, poses)
        _compare_velocity(robot, poses, robot.inverse(poses).signs[0], rng.normal(size=poses.shape))
    assert modes > 50


def test_modes_found_have_the_inputs_back() -> None:
    inputs = [14.98, 15.38, 12.0]
    poses = ROBOT.forward(inputs).poses
    batch = ROBOT.inverse(poses)
    assert np.allclose(batch.inputs[:, batch.place("+++")], inputs, rtol=1e-12)
    assert batch.joints.shape == (6, 8, 3, 3) and batch.inputs.shape == (6, 8, 3)


def test_singularities_have_names() -> None:
    robot = assur.Manipulator.from_dict(
        {
            "schema": "assur/manipulator/1",
            "leg": [
                {"joints": "R_P_R", "base": {"at": a}, "platform": {"at": b}}
                for a, b in (([0.0, 0.0], [0.0, 1.0]), ([4.0, 0.0], [2.0, 1.0]), ([2.0, 4.0], [1.0, 3.0]))
            ],
        }
    )
    poses = np.array([[0.0, 0.0, 0.0], [1.1, 1.0, 0.2], [np.nan, 0.0, 0.0]])
    batch = robot.velocity(poses, "+++", rates=[1.0, 0.0, 0.0])
    assert batch.singularities.tolist() == [SINGULARITIES.index(robot.velocity(pose.tolist(), "+++").singularity) for pose in poses[:2]] + [5]
    assert batch.singularities[0] == 2, "the struts meet in a point"
    assert batch.pose_if_inputs is not None and batch.pose_if_inputs.mask[0].all() and not batch.pose_if_inputs.mask[1].any()


def test_accelerations_and_forces_are_those_of_one_pose(rng: np.random.Generator) -> None:
    poses = np.array([[3.0, 3.0, 0.1], [np.nan, 3.0, 0.1], [3.2, 2.9, -0.2], [1e9, 0.0, 0.0], [2.8, 3.1, 0.3]])
    rates, wrench = rng.normal(size=(5, 3)), rng.normal(size=(5, 3))
    accelerations = [0.5, -1.0, 2.0]
    for moving in (rates, None):
        batch = RRR.velocity(poses, "+++", rates=moving, accelerations=accelerations, wrench=wrench)
        found = [batch.input_accelerations_if_pose, batch.pose_accelerations_if_inputs, batch.actuator_forces]
        assert (batch.inputs_if_pose is None) == (moving is None)
        answered = 0
        for row, pose in enumerate(poses):
            arrays = [None if array is None else array[row] for array in found]
            assert all(array is not None for array in arrays)
            if row in batch.errors:
                assert all(array.mask.all() for array in arrays if array is not None)
                continue
            here = None if moving is None else moving[row]
            one = RRR.velocity(pose.tolist(), "+++", rates=here, accelerations=accelerations, wrench=wrench[row])
            assert one.accelerations is not None and one.wrench is not None
            both = [one.accelerations.inputs_if_pose, one.accelerations.pose_if_inputs, one.wrench.actuator_forces]
            for array, expected in zip(arrays, both, strict=True):
                assert array is not None and expected is not None and array.tolist() == expected.tolist()
                answered += 1
        assert list(batch.errors) == [1, 3] and answered == 9
    assert RRR.velocity(poses, "+++").actuator_forces is None


def test_a_singularity_masks_accelerations_and_forces() -> None:
    legs = (([0.0, 0.0], [0.0, 1.0]), ([4.0, 0.0], [2.0, 1.0]), ([2.0, 4.0], [1.0, 3.0]))
    described = [{"joints": "R_P_R", "base": {"at": a}, "platform": {"at": b}} for a, b in legs]
    robot = assur.Manipulator.from_dict({"schema": "assur/manipulator/1", "leg": described})
    poses = np.array([[0.0, 0.0, 0.0], [1.1, 1.0, 0.2]])
    batch = robot.velocity(poses, "+++", accelerations=[0.0, 0.0, 1.0], wrench=[1.0, 0.0, 0.0])
    forward, forces = batch.pose_accelerations_if_inputs, batch.actuator_forces
    assert forward is not None and forces is not None and batch.input_accelerations_if_pose is not None
    assert forward.mask.all(axis=1).tolist() == forces.mask.all(axis=1).tolist() == [True, False]
    assert not batch.input_accelerations_if_pose.mask.any()


def test_bad_rows_are_masked_with_their_reason() -> None:
    poses = np.array([[3.0, 3.0, 0.1], [np.nan, 3.0, 0.1], [1e9, 0.0, 0.0]])
    ways = RRR.inverse(poses)
    assert list(ways.errors) == [1] and ways.counts.tolist()[1:] == [0, 0] and ways.mask[1:].all()
    assert (ways.misses[2] > 1e8).all() and not ways.misses[1].any()
    moved = RRR.velocity(poses, "+++")
    assert list(moved.errors) == [1, 2] and "does not reach" in str(moved.errors[2])
    assert moved.errors[2].row == 2 and moved.errors[2].leg == 1 and moved.inputs_if_pose is None
    masked = np.ma.MaskedArray([[3.0, 3.0, 0.1]] * 2, mask=[[False] * 3, [True, False, False]])
    assert list(RRR.inverse(masked).errors) == [1]


def test_what_cannot_be_asked_is_named() -> None:
    poses = np.array([[3.0, 3.0, 0.1]])
    with pytest.raises(assur.InputError, match=r'mode "\+\*\+": must be 3 signs'):
        RRR.velocity(poses, "+*+")
    with pytest.raises(assur.InputError, match="length: -1 must be > 0"):
        RRR.velocity(poses, "+++", length=-1.0)
    with pytest.raises(assur.InputError, match=r"wrench: shape \(2,\) must be \(3,\) or \(1, 3\)"):
        RRR.velocity(poses, "+++", wrench=[0, 1])
    with pytest.raises(assur.InputError, match=r"rates: shape \(2, 3\) must be \(3,\) or \(1, 3\)"):
        RRR.velocity(poses, "+++", rates=np.zeros((2, 3)))
    with pytest.raises(assur.InputError, match=r"pose: shape \(2, 4\) must be \(3,\) or \(n, 3\)"):
        RRR.inverse(np.zeros((2, 4)))
    with pytest.raises(assur.InputError, match=r"mode: 'x' must be one of \+\+\+"):
        RRR.inverse(poses).place("x")


def test_nothing_and_copies() -> None:
    nothing = RRR.inverse(np.empty((0, 3)))
    assert len(nothing) == 0 and nothing.joints.shape == (0, 8, 3, 3) and "Working modes of 0 poses" in repr(nothing)
    assert RRR.velocity(np.empty((0, 3)), "+++", rates=[1, 0, 0]).dexterity.shape == (0,)
    poses = np.array([[3.0, 3.0, 0.1], [np.inf, 3.0, 0.1]])
    poses.flags.writeable = False
    for batch in (RRR.inverse(poses), RRR.velocity(poses, "+++")):
        assert np.shares_memory(batch.poses, poses)
        again = pickle.loads(pickle.dumps(batch))
        assert repr(again) == repr(batch) and str(again.errors[1]) == str(batch.errors[1])
        assert batch._repr_html_().startswith("<div><b>")
    with pytest.raises(ValueError, match="read-only"):
        RRR.inverse(poses).misses[0, 0] = 1.0
