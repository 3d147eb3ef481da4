"""Every assembly mode of planar mechanisms: solved completely, and proved on request.

>>> import assur
>>> robot, inputs = assur.Manipulator.of_family("3-RPR")
>>> answer = robot.forward(inputs)
>>> answer.status
'complete'

Lengths are in the model's unit, angles are radians, poses are ``x, y, phi`` of the platform in the base frame. Results are frozen, print as a table,
draw themselves in a notebook, and keep the report that the command line prints with ``--json`` (:meth:`to_json`).
"""

from ._assur import __version__
from ._spatial_batch import HanaVelocityBatch, TripodVelocityBatch
from .claims import Claim, Verification
from .errors import AssurError, InputError, ModelError
from .groups import CouplerCurve, GroupAssemblies, LinkageAssemblies, coupler, group, triad
from .hana import ArcRegion, Hana, HanaAssemblies, HanaTilts, HanaVelocity, HanaWays
from .loci import SingularityLoci
from .manipulator import Manipulator
from .modes import Account, AssemblyModes, Mode, ModesBatch
from .motion import Velocity, WorkingMode, WorkingModes
from .multipteron import Multipteron, MultipteronInputs, MultipteronPoses
from .paths import FollowedPath
from .poses import VelocityBatch, WorkingModesBatch
from .sweeps import Design, Sweep, sweep, vary
from .tripod import (
    DeterminantCurves,
    Pointed,
    Tilt,
    TiltMap,
    Torsions,
    Tripod,
    TripodAssemblies,
    TripodVelocity,
    TripodWay,
)
from .workspaces import Region, StrokeVoid

__all__ = [
    "Account",
    "ArcRegion",
    "AssemblyModes",
    "AssurError",
    "Claim",
    "CouplerCurve",
    "Design",
    "DeterminantCurves",
    "FollowedPath",
    "GroupAssemblies",
    "Hana",
    "HanaAssemblies",
    "HanaTilts",
    "HanaVelocity",
    "HanaVelocityBatch",
    "HanaWays",
    "InputError",
    "LinkageAssemblies",
    "Manipulator",
    "Mode",
    "ModelError",
    "ModesBatch",
    "Multipteron",
    "MultipteronInputs",
    "MultipteronPoses",
    "Pointed",
    "Region",
    "SingularityLoci",
    "StrokeVoid",
    "Sweep",
    "Tilt",
    "TiltMap",
    "Torsions",
    "Tripod",
    "TripodAssemblies",
    "TripodVelocity",
    "TripodVelocityBatch",
    "TripodWay",
    "Velocity",
    "VelocityBatch",
    "Verification",
    "WorkingMode",
    "WorkingModes",
    "WorkingModesBatch",
    "__version__",
    "coupler",
    "group",
    "sweep",
    "triad",
    "vary",
]
