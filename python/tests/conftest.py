"""Where the command line and the shipped models are; models at random; pictures into memory only."""

from __future__ import annotations

import json
import math
import os
import re
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
import pytest

import assur

matplotlib.use("Agg")

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"


def shipped() -> dict[str, list[float]]:
    """Every shipped manipulator with the inputs that its file says to try, in the file's unit."""
    found = {}
    for path in sorted(EXAMPLES.glob("*.toml")):
        text = path.read_text()
        if "assur/manipulator/1" in text and (asked := re.search(r"assur forward .*--inputs=(\S+)", text)):
            found[path.name] = [float(value) for value in asked[1].split(",")]
    assert len(found) >= 8, "the shipped models have gone elsewhere"
    return found


#: Shipped manipulators and inputs.
MODELS = shipped()


def in_radians(robot: assur.Manipulator, values: list[float]) -> list[float]:
    """Inputs of a model's file in radians, as Python takes them."""
    legs = robot.check()["legs"]
    kinds = [leg["joints"].replace("_", "")[joint - 1] for leg in legs for joint in leg["actuated"]]
    turned = robot.angle_unit == "deg"
    return [math.radians(value) if turned and kind == "R" else value for value, kind in zip(values, kinds, strict=True)]


@pytest.fixture(scope="session")
def cli() -> Callable[..., str]:
    """Runs the command line and gives back what it prints; fails where it fails."""
    program = Path(os.environ.get("ASSUR_CLI", ROOT / "target" / "release" / "assur"))
    if not program.exists():
        subprocess.run(["cargo", "build", "--release", "--bin", "assur"], cwd=ROOT, check=True)

    def run(*arguments: str | Path, fails: bool = False) -> str:
        done = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True, timeout=120)
        assert (done.returncode != 0) is fails, done.stderr
        return done.stderr if fails else done.stdout

    return run


@pytest.fixture
def rng() -> np.random.Generator:
    return np.random.default_rng(20261124)


#: Legs of every kind that a group left over can have, one actuator each.
LEGS = ["R_P_R", "_R_RR", "R_R_R", "_P_RR", "_R_RP", "RR_P_", "_P_RP", "_R_PR", "P_P_R", "RP_R_", "RR_R_", "P_R_R"]


def random_model(rng: np.random.Generator) -> dict[str, Any]:
    """A model of three legs at random, its numbers of all sizes."""
    scale = 10.0 ** rng.uniform(-3, 3)

    def point() -> list[float]:
        return [float(value) for value in rng.normal(size=2) * scale]

    def leg() -> dict[str, Any]:
        return {
            "joints": str(rng.choice(LEGS)),
            "base": {"at": point(), "angle": float(rng.uniform(-3, 3))},
            "links": [{"at": point(), "angle": float(rng.uniform(-3, 3))}, float(rng.uniform(0.5, 2) * scale)],
            "platform": {"at": point(), "angle": float(rng.uniform(-3, 3))},
        }

    return {"schema": "assur/manipulator/1", "name": "random", "leg": [leg(), leg(), leg()]}


def random_inputs(model: dict[str, Any], rng: np.random.Generator) -> list[float]:
    """Actuator values for a model: angles, and lengths of its size."""
    size = max(abs(value) for leg in model["leg"] for value in leg["platform"]["at"] + leg["base"]["at"])
    values = []
    for leg in model["leg"]:
        kind = leg["joints"].split("_")[1]
        values.append(float(rng.uniform(-3, 3) if kind == "R" else rng.uniform(-2, 2) * size))
    return values


def joined(values: Any) -> str:
    """Numbers as the command line takes them, to the last bit."""
    return ",".join(repr(float(value)) for value in np.asarray(values).ravel())


def written(model: dict[str, Any], folder: Path) -> Path:
    """A model as a file."""
    path = folder / "model.json"
    path.write_text(json.dumps(model))
    return path
