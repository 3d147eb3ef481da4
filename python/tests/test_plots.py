"""Every picture returns its axes, shows nothing, and has on it what the result says."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
import pytest
from matplotlib.axes import Axes

import assur

from .conftest import EXAMPLES
from .test_results import ANSWERS, HANA, INPUTS, ROBOT, TRIPOD


@pytest.fixture(autouse=True)
def closed(monkeypatch: pytest.MonkeyPatch) -> Any:
    def shown(*_: object, **__: object) -> None:
        raise AssertionError("a plot must not show itself")

    monkeypatch.setattr(plt, "show", shown)
    yield
    plt.close("all")


PLOTTED = [answer for answer in ANSWERS if hasattr(answer, "plot")]


@pytest.mark.parametrize("answer", PLOTTED, ids=lambda answer: type(answer).__name__)
def test_plots_return_their_axes(answer: Any, tmp_path: Path) -> None:
    ax = answer.plot()
    assert isinstance(ax, Axes)
    assert ax.lines or ax.collections or ax.images or ax.patches
    figure, given = plt.subplots()
    assert answer.plot(ax=given) is given
    figure.savefig(tmp_path / "plot.png", dpi=40)


def test_modes_each() -> None:
    axes = ROBOT.forward(INPUTS).plot_each()
    assert axes.shape == (6,)
    assert all(ax.get_title() for ax in axes)


def test_a_mode_is_drawn_where_it_is() -> None:
    answer = ROBOT.forward(INPUTS)
    ax = answer.plot()
    drawn = np.concatenate([np.asarray(line.get_xydata()) for line in ax.lines])
    for mode in answer:
        assert (np.abs(drawn - mode.pose[:2]).sum(axis=1) < 1e-9).any(), "leg 1 ends in the platform's origin"


def test_batch_and_nothing_to_draw() -> None:
    batch = ROBOT.forward(np.array(INPUTS) * np.linspace(0.8, 1.2, 50)[:, np.newaxis])
    ax = batch.plot()
    assert len(np.asarray(ax.collections[0].get_offsets())) == int(batch.counts.sum())
    assert isinstance(ROBOT.forward([1.0, 1.0, 100.0]).plot(), Axes)
    assert isinstance(ROBOT.forward(np.empty((0, 3))).plot(), Axes)


def test_workspaces_without_area_are_drawn() -> None:
    dextrous = assur.Manipulator.from_file(EXAMPLES / "workspaces" / "table1-4a.toml").workspace("dextrous")
    (part,) = dextrous.isolated
    ax = dextrous.plot()
    (line,) = ax.get_lines()
    assert part.start is not None and part.end is not None and "no area" in ax.get_title()
    drawn = np.asarray(line.get_xydata())
    assert np.allclose(drawn[0], part.start) and np.allclose(drawn[-1], part.end)
    nothing = assur.Manipulator.from_file(EXAMPLES / "workspaces" / "table1-1a.toml").workspace("dextrous").plot()
    assert [text.get_text() for text in nothing.texts] == ["empty"]


def test_an_animation_is_written(tmp_path: Path) -> None:
    rows = np.array([INPUTS]) * np.linspace(1, 0.97, 5)[:, np.newaxis]
    path = ROBOT.follow(rows)
    assert path.complete
    animation = path.animate(frames=3)
    animation.save(tmp_path / "path.gif", writer="pillow", dpi=40)
    assert (tmp_path / "path.gif").stat().st_size > 1000


def test_sections_and_sweeps() -> None:
    tilts = TRIPOD.tilt_map([100, 100, 100], [300, 300, 300], sections=2, cells=4)
    assert isinstance(tilts.plot(section=1), Axes)
    assert isinstance(HANA.capability(cells=6).plot(), Axes)
    robot, inputs = assur.Manipulator.of_family("3-RPR")
    designs = assur.vary(robot, {"leg2.base.at.x": [10.0, 12.0, 14.0]})
    found = assur.sweep(designs, ["degree", f"modes:{','.join(map(str, inputs))}"])
    front = found.pareto(least=["leg2.base.at.x"], most=["modes"])
    assert isinstance(found.plot("leg2.base.at.x", "modes", front=front), Axes)
