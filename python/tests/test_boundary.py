"""Whatever is passed in: an exact message, a masked row, or an answer; never a crash, never a wrong number."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

import assur

from .conftest import EXAMPLES

ARM = assur.Manipulator.from_file(EXAMPLES / "workspaces" / "table1-1a.toml")
HEXAPTERON = assur.Multipteron.from_file(EXAMPLES / "hexapteron.toml")
ROBOT = assur.Manipulator.from_file(EXAMPLES / "3-rpr.toml")
INPUTS = [14.98, 15.38, 12.0]


def test_wrong_shapes_are_named() -> None:
    wrong: list[tuple[Any, tuple[int, ...]]] = [([1.0, 2.0], (2,)), (np.zeros((2, 4)), (2, 4)), (3.0, ())]
    for given_, shape in wrong:
        with pytest.raises(assur.InputError) as caught:
            ROBOT.forward(given_)
        assert str(caught.value) == f"inputs: shape {shape} must be (3,) or (n, 3)"
        assert (caught.value.field, caught.value.value) == ("inputs", shape)
    with pytest.raises(assur.InputError, match=r"pose: shape \(4,\) must be \(3,\)"):
        ROBOT.inverse([1, 2, 3, 4])
    with pytest.raises(assur.InputError, match=r"path: shape \(3,\) must be \(n, 3\)"):
        ROBOT.follow(INPUTS)


@pytest.mark.parametrize("dtype", ["complex128", "U3", "bool", "datetime64[s]", "object"])
def test_wrong_dtypes_are_named(dtype: str) -> None:
    values = np.ones((4, 3)).astype(dtype)
    with pytest.raises(assur.InputError, match="inputs: dtype .* must be real numbers"):
        ROBOT.forward(values)


def test_ragged_lists_and_texts_are_refused() -> None:
    with pytest.raises(assur.InputError, match="inputs: no array of numbers"):
        ROBOT.forward([[1.0, 2.0, 3.0], [1.0]])
    with pytest.raises(assur.InputError, match="must be real numbers"):
        ROBOT.forward("abc")


@pytest.mark.parametrize("dtype", ["float64", "float32", "float16", "int64", "uint8", ">f8"])
def test_real_dtypes_are_taken(dtype: str) -> None:
    rows = np.array([[15, 15, 12], [14, 16, 13]]).astype(dtype)
    expected = ROBOT.forward(rows.astype(np.float64))
    found = ROBOT.forward(rows)
    assert np.array_equal(found.poses.data, expected.poses.data) and np.array_equal(found.counts, expected.counts)


def _layouts(rows: np.ndarray[Any, np.dtype[np.float64]]) -> dict[str, np.ndarray[Any, np.dtype[np.float64]]]:
    wide = np.full((len(rows), 7), np.nan)
    wide[:, 1:7:2] = rows
    frozen = rows.copy()
    frozen.flags.writeable = False
    odd = np.frombuffer(b"x" + rows.tobytes(), dtype=np.uint8)[1:].view(np.float64).reshape(rows.shape)
    return {
        "strided": wide[:, 1:7:2],
        "Fortran": np.asfortranarray(rows),
        "reversed": rows[::-1].copy()[::-1],
        "read-only": frozen,
        "not aligned": odd,
        "subclass": rows.view(np.recarray).view(np.ndarray),
    }


def test_memory_layouts_change_nothing(rng: np.random.Generator) -> None:
    rows = np.array(INPUTS) * rng.uniform(0.9, 1.1, size=(50, 3))
    expected = ROBOT.forward(rows)
    for name, layout in _layouts(rows).items():
        found = ROBOT.forward(layout)
        assert np.array_equal(found.poses.data, expected.poses.data), name


def test_arrays_are_not_copied(rng: np.random.Generator) -> None:
    rows = np.array(INPUTS) * rng.uniform(0.9, 1.1, size=(5, 3))
    rows.flags.writeable = False
    found = ROBOT.forward(rows)
    assert found.inputs is rows or np.shares_memory(found.inputs, rows)
    assert found.poses.data.base is not None and found.poses.data.shape == (5, 6, 3)
    for array in (found.poses.data, found.counts, found.statuses, found.mask):
        assert not array.flags.writeable


def test_bad_rows_are_masked_with_their_reason() -> None:
    rows = np.array([INPUTS, [1.0, np.nan, 2.0], INPUTS, [np.inf, 0.0, 0.0]])
    found = ROBOT.forward(rows)
    assert list(found.errors) == [1, 3] and found.counts.tolist() == [6, 0, 6, 0]
    error = found.errors[1]
    assert str(error) == "leg 2: input of joint 2: NaN must be finite"
    assert (error.row, error.leg, error.joint, error.field) == (1, 2, 2, "inputs")
    assert error.value != error.value
    assert found.mask[1].all() and found.poses.mask[1].all() and not found.mask[0].any()
    assert found.statuses.tolist() == [0, 3, 0, 3]
    with pytest.raises(KeyError):
        found.errors[0]
    assert "2 rows with an error" in repr(found)


def test_masked_numbers_are_not_taken_for_numbers() -> None:
    rows = np.ma.MaskedArray([INPUTS, INPUTS], mask=[[False] * 3, [False, True, False]])
    found = ROBOT.forward(rows)
    assert found.counts.tolist() == [6, 0] and list(found.errors) == [1]


def test_limits_are_a_reason() -> None:
    model = ROBOT.to_dict()
    model["leg"][1]["limits"] = {"2": [10.0, 20.0]}
    robot = assur.Manipulator.from_dict(model)
    rows = np.array([INPUTS, [14.98, 25.0, 12.0]])
    assert str(robot.forward(rows).errors[1]) == "leg 2: input 25 of joint 2 is outside limits [10, 20]"
    with pytest.raises(assur.InputError) as caught:
        robot.forward(rows[1])
    assert (caught.value.leg, caught.value.value) == (2, 25.0)


def test_no_rows_are_no_error() -> None:
    found = ROBOT.forward(np.empty((0, 3)))
    assert len(found) == 0 and found.poses.shape == (0, 6, 3) and not found.errors


def test_more_rows_than_memory_is_a_memory_error() -> None:
    rows = np.broadcast_to(np.float64(1.0), (10**13, 3))
    with pytest.raises(MemoryError):
        ROBOT.forward(rows)


def test_rows_beyond_one_look_for_interrupts() -> None:
    rows = np.broadcast_to(np.array(INPUTS), ((1 << 18) + 5, 3)).copy()
    rows[-1, 0] = np.nan
    found = ROBOT.forward(rows)
    assert (found.counts[:-1] == 6).all() and list(found.errors) == [len(rows) - 1]
    assert np.array_equal(found.poses.data[-2], found.poses.data[0])


def test_threads_share_a_manipulator() -> None:
    from concurrent.futures import ThreadPoolExecutor

    rows = np.array(INPUTS) * np.linspace(0.9, 1.1, 2000)[:, np.newaxis]
    expected = ROBOT.forward(rows).poses.data
    with ThreadPoolExecutor(4) as pool:
        for found in pool.map(lambda _: ROBOT.forward(rows).poses.data, range(8)):
            assert np.array_equal(found, expected)


anything = st.one_of(
    hnp.arrays(
        dtype=st.sampled_from(["f8", "f4", "f2", "i8", "u2", "c16", "?", "U2", "M8[s]", "O"]),
        shape=hnp.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=4),
    ),
    hnp.arrays(np.float64, st.tuples(st.integers(0, 5), st.just(3)), elements=st.floats(width=64)),
    st.lists(st.floats(), max_size=5),
    st.lists(st.lists(st.integers(), max_size=4), max_size=3),
    st.text(max_size=3),
    st.none(),
    st.integers(),
    st.dictionaries(st.text(max_size=2), st.floats(), max_size=2),
)


@settings(max_examples=200, deadline=None, derandomize=True)
@given(anything)
def test_anything_as_inputs(value: Any) -> None:
    try:
        found = ROBOT.forward(value)
    except assur.InputError as error:
        assert str(error) and error.field == "inputs"
        return
    if isinstance(found, assur.ModesBatch):
        known = np.isfinite(np.asarray(value, dtype=np.float64)).all(axis=1)
        assert ((found.statuses == 3) == ~known).all() and len(found.errors) == (~known).sum()
        assert np.isfinite(found.poses.compressed()).all() and (found.counts <= 6).all()
    else:
        assert found.account.degree <= 6 and np.isfinite(found.poses).all()


@settings(max_examples=80, deadline=None, derandomize=True)
@given(anything, anything)
def test_anything_as_poses_and_paths(first: Any, second: Any) -> None:
    calls: list[Callable[[], object]] = [
        lambda: HEXAPTERON.forward(first),
        lambda: HEXAPTERON.inverse(second),
        lambda: ARM.workspace(assembly=first),
        lambda: ARM.workspace().contains(first),
        lambda: assur.Tripod.determinant_curves("inclined", [first], points=3),
        lambda: ROBOT.inverse(first),
        lambda: ROBOT.velocity(first, "+++", rates=second),
        lambda: ROBOT.follow(first, second),
        lambda: None if isinstance(first, int) else ROBOT.singularities(first, polynomial=False),
    ]
    for call in calls:
        try:
            call()
        except assur.AssurError as error:
            assert str(error)


json_like = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=4),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=6), inner, max_size=3),
    max_leaves=8,
)
keys = st.sampled_from(["schema", "name", "angle_unit", "leg", "joints", "base", "links", "platform", "limits", "at"])


@settings(max_examples=250, deadline=None, derandomize=True)
@given(st.dictionaries(keys | st.text(max_size=5), json_like, max_size=4), st.sampled_from(["", "leg"]), json_like)
def test_anything_as_a_model(changed: dict[str, Any], where: str, value: Any) -> None:
    model = ROBOT.to_dict()
    if where:
        model["leg"][0] |= changed
    else:
        model |= changed
    for read in (assur.Manipulator.from_dict, assur.Hana.from_dict, assur.Tripod.from_dict):
        try:
            read(model)
        except assur.ModelError as error:
            assert str(error)
    for ask in (assur.triad, assur.group, assur.coupler):
        try:
            ask({"schema": value, **changed})
        except assur.AssurError as error:
            assert str(error)


def test_errors_of_models_name_their_place() -> None:
    def error(change: Callable[[dict[str, Any]], None]) -> assur.ModelError:
        model = ROBOT.to_dict()
        change(model)
        with pytest.raises(assur.ModelError) as caught:
            assur.Manipulator.from_dict(model)
        return caught.value

    found = error(lambda model: model["leg"][1]["base"].update(at=[1.0]))
    assert (found.leg, found.field, found.file) == (2, "base.at", "dict.json")
    found = error(lambda model: model["leg"][2].update(joints="RRX"))
    assert (found.leg, found.field, found.value) == (3, "joints", "RRX")
    found = error(lambda model: model["leg"][0]["platform"].update(at=[np.nan, 0.0]))
    assert "must be finite" in str(found) and found.field == "leg[0].platform.at[0]"
    found = error(lambda model: model.update(leg=model["leg"][:1]))
    assert found.value == 1 and "leg: 1 given" in str(found)
    with pytest.raises(assur.ModelError) as caught:
        assur.Manipulator.from_file("no such file.toml")
    assert caught.value.file == "no such file.toml"


def test_errors_survive_pickling() -> None:
    import pickle

    with pytest.raises(assur.InputError) as caught:
        ROBOT.forward([1.0, np.inf, 2.0])
    again = pickle.loads(pickle.dumps(caught.value))
    assert (type(again), str(again)) == (assur.InputError, str(caught.value))
    assert (again.leg, again.joint, again.field, again.value) == (2, 2, "inputs", np.inf)
