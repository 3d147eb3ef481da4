"""Sweeps in this process and on a cluster of two processes, one of which dies half-way."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from pathlib import Path

import cloudpickle
import numpy as np
import pyarrow.dataset
import pyarrow.parquet
import pytest

import assur

from .conftest import EXAMPLES

ROBOT = assur.Manipulator.from_file(EXAMPLES / "3-rpr.toml")
MODES = "modes:14.98,15.38,12"


def designs(count: int) -> list[assur.Design]:
    return list(assur.vary(ROBOT, {"leg2.base.at.x": np.linspace(10, 20, count), "leg3.base.at.y": [9.0, 10.0]}))


def test_a_grid_of_designs() -> None:
    grid = assur.vary(ROBOT, {"leg2.base.at.x": [1.0, 2.0, 3.0], "leg1.platform.at.y": [5.0, 6.0]})
    assert len(grid) == 6
    assert dict(grid[3].parameters) == {"leg2.base.at.x": 2.0, "leg1.platform.at.y": 6.0}
    model = grid[3].manipulator.to_dict()
    assert model["leg"][1]["base"]["at"][0] == 2.0 and model["leg"][0]["platform"]["at"][1] == 6.0
    assert ROBOT.to_dict()["leg"][1]["base"]["at"][0] == 15.91, "the design to start from stays as it is"


def test_keys_that_name_nothing_are_refused() -> None:
    for key in ["leg4.base.at.x", "leg1.base", "leg1.base.at.z", "name", "leg1.joints", "", "leg1.limits.max"]:
        with pytest.raises(assur.InputError, match="no number of a design|there is no leg 4|no limits"):
            assur.vary(ROBOT, {key: [1.0]})
    with pytest.raises(assur.ModelError, match="must be finite"):
        ROBOT.with_numbers({"leg1.base.at.x": np.nan})
    rrr = assur.Manipulator.from_file(EXAMPLES / "3-rrr.toml")
    turned = rrr.with_numbers({"leg1.links1": 2.0, "leg2.base.angle": np.pi / 6}).to_dict()
    assert turned["leg"][1]["base"]["angle"] == 30.0, "a file in degrees"
    assert turned["leg"][0]["links"][0]["at"] == [2.0, 0.0]


def test_what_is_asked_is_checked() -> None:
    with pytest.raises(assur.InputError, match="report: 'speed' must be one of"):
        assur.sweep([ROBOT], "speed")
    with pytest.raises(assur.InputError, match="nothing is asked for"):
        assur.sweep([ROBOT], [])
    with pytest.raises(assur.InputError, match="chunk: 0 must be"):
        assur.sweep([ROBOT], "degree", chunk=0)


def test_in_this_process() -> None:
    found = assur.sweep(designs(10), ["degree", MODES, lambda robot: {"legs": len(robot.to_dict()["leg"])}])
    assert len(found) == 20 and (found["degree"] == 6).all() and (found["legs"] == 3).all()
    assert found["design"].tolist() == list(range(20))
    for row in (0, 7, 19):
        single = designs(10)[row].manipulator.forward([14.98, 15.38, 12])
        assert found["modes"][row] == len(single)
    assert "Sweep of 20 designs (0 with an error)" in repr(found)


def test_a_design_that_cannot_be_asked_is_a_row_with_a_reason() -> None:
    model = ROBOT.to_dict()
    model["leg"][0]["limits"] = {"2": [1.0, 2.0]}
    found = assur.sweep([ROBOT, assur.Manipulator.from_dict(model)], MODES)
    assert found["error"][0] is None and "outside limits" in found["error"][1]
    assert found["modes"][0] == 6 and np.isnan(found["modes"][1])


def test_fronts() -> None:
    columns = {"a": np.array([1.0, 2.0, 3.0, 2.0, np.nan]), "b": np.array([1.0, 3.0, 2.0, 2.0, 9.0]), "design": np.arange(5)}
    assert assur.Sweep(columns).pareto(least=["a"], most=["b"]).tolist() == [0, 1]


def test_a_stopped_sweep_goes_on(tmp_path: Path) -> None:
    all_designs, stopped = designs(10), tmp_path / "stopped"

    class Stop(Exception):
        pass

    asked = []

    def counting(robot: assur.Manipulator) -> dict[str, float]:
        asked.append(robot)
        if len(asked) == 11:
            raise Stop
        return {"x": robot.to_dict()["leg"][1]["base"]["at"][0]}

    with pytest.raises(Stop):
        assur.sweep(all_designs, counting, output=stopped, chunk=4)
    assert len(list(stopped.glob("part-*.parquet"))) == 2 and not list(stopped.glob("*.tmp"))
    found = assur.sweep(all_designs, counting, output=stopped, chunk=4)
    assert len(asked) == 11 + 12, "the two chunks that were there are not done again"
    assert found["design"].tolist() == list(range(20))
    assert found["x"].tolist() == [design.parameters["leg2.base.at.x"] for design in all_designs]
    with pytest.raises(assur.InputError, match="holds another sweep, with other report"):
        assur.sweep(all_designs, "degree", output=stopped, chunk=4)
    again = assur.sweep(all_designs, counting, output=stopped, chunk=4)
    assert len(asked) == 11 + 12 and again["x"].tolist() == found["x"].tolist()


def _slow(robot: assur.Manipulator) -> dict[str, float]:
    time.sleep(0.05)
    return {"pid": float(os.getpid()), "modes": float(len(robot.forward([14.98, 15.38, 12])))}


def test_a_worker_dies_and_nothing_is_lost_or_twice(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    all_designs = designs(30)
    expected = assur.sweep(all_designs, MODES)
    cluster = distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, local_directory=str(tmp_path / "dask")
    )
    with cluster, distributed.Client(cluster) as client:
        pids = list(client.run(os.getpid).values())
        assert len(pids) == 2
        # This module is none that workers could import: that is an error, and not a sweep that never ends.
        with pytest.raises(ModuleNotFoundError):
            assur.sweep(all_designs, [_slow], client)
        cloudpickle.register_pickle_by_value(sys.modules[__name__])

        def kill_half_way() -> None:
            # As soon as some chunks are there and others are not.
            while len(list((tmp_path / "out").glob("part-*.parquet"))) < 4:
                time.sleep(0.02)
            os.kill(pids[0], signal.SIGKILL)

        killer = threading.Thread(target=kill_half_way, daemon=True)
        killer.start()
        found = assur.sweep(all_designs, [_slow], client, output=tmp_path / "out", chunk=3)
        killer.join(timeout=10)
        assert not killer.is_alive(), "the worker was killed while there was work left"
        left = list(client.run(os.getpid).values())
        assert pids[0] not in left
    assert found["design"].tolist() == list(range(60))
    assert found["modes"].tolist() == expected["modes"].tolist()
    assert {int(pid) for pid in found["pid"]} >= {pids[1]}
    table = pyarrow.dataset.dataset(tmp_path / "out", format="parquet", exclude_invalid_files=True).to_table()
    assert sorted(table["design"].to_pylist()) == list(range(60))
    assert len(list((tmp_path / "out").glob("part-*.parquet"))) == 20


def test_datasets_are_of_one_schema(tmp_path: Path) -> None:
    model = ROBOT.to_dict()
    model["leg"][0]["limits"] = {"2": [1.0, 2.0]}
    assur.sweep([ROBOT, assur.Manipulator.from_dict(model)], MODES, output=tmp_path, chunk=1)
    schemas = [pyarrow.parquet.read_schema(path) for path in sorted(tmp_path.glob("part-*.parquet"))]
    table = pyarrow.dataset.dataset(sorted(map(str, tmp_path.glob("part-*.parquet")))).to_table()
    assert len(schemas) == 2 and table.num_rows == 2
