# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubic stylization without Blender: NumPy, SciPy and, if installed, Taichi or Quadrants.

The names below are imported on first use, so that Blender can show the panel of the extension
without loading SciPy, and even if SciPy is missing.
"""

from importlib import import_module
from typing import TYPE_CHECKING

from .errors import CubicCraftError

if TYPE_CHECKING:
    from .backends import DEVICES, engine_name, problem_with_engine, set_cache_folder
    from .energy import Energy
    from .flatten import Flattened, flatten_facets
    from .frames.sequence import Sequence, SequenceState
    from .frames.steadiness import MOST_JUMPS, Frames, frame_of, least_width
    from .limbs import KnownLimbs, joined_limbs, limbs_of_bones, placed_limbs
    from .limbs.frames import pose_frames
    from .loading import loading_steps
    from .mesh.edge_distances import edge_distances, nearest_distances
    from .mesh.rest_measures import triangle_areas_and_normals
    from .normal_capture import NormalCapture
    from .orientation.auto_orientation import auto_orient
    from .progress import Progress
    from .proxy.options import PAPER, ProxyOptions
    from .rest import RestMesh, rest_mesh
    from .rotation_fit import svd_rotations
    from .runner import Result, Run, run, stylize
    from .setup import Setup
    from .stop_rule import StopRule
    from .styles.cube import nearest_to_identity
    from .stylization import Stylization
    from .symmetry import MATCHING, NO_PARTNER, Mirror, commuting, partners

__all__ = [
    "DEVICES",
    "MATCHING",
    "MOST_JUMPS",
    "NO_PARTNER",
    "PAPER",
    "CubicCraftError",
    "Energy",
    "Flattened",
    "Frames",
    "KnownLimbs",
    "Mirror",
    "NormalCapture",
    "Progress",
    "ProxyOptions",
    "RestMesh",
    "Result",
    "Run",
    "Sequence",
    "SequenceState",
    "Setup",
    "StopRule",
    "Stylization",
    "auto_orient",
    "commuting",
    "edge_distances",
    "engine_name",
    "flatten_facets",
    "frame_of",
    "joined_limbs",
    "least_width",
    "limbs_of_bones",
    "loading_steps",
    "nearest_distances",
    "nearest_to_identity",
    "partners",
    "placed_limbs",
    "pose_frames",
    "problem_with_engine",
    "rest_mesh",
    "run",
    "set_cache_folder",
    "stylize",
    "svd_rotations",
    "triangle_areas_and_normals",
]

_MODULES = {
    "DEVICES": "backends",
    "Energy": "energy",
    "Flattened": "flatten",
    "Frames": "frames.steadiness",
    "KnownLimbs": "limbs",
    "Mirror": "symmetry",
    "MATCHING": "symmetry",
    "MOST_JUMPS": "frames.steadiness",
    "NO_PARTNER": "symmetry",
    "NormalCapture": "normal_capture",
    "PAPER": "proxy.options",
    "Progress": "progress",
    "ProxyOptions": "proxy.options",
    "RestMesh": "rest",
    "Result": "runner",
    "Run": "runner",
    "Sequence": "frames.sequence",
    "SequenceState": "frames.sequence",
    "Setup": "setup",
    "StopRule": "stop_rule",
    "Stylization": "stylization",
    "auto_orient": "orientation.auto_orientation",
    "commuting": "symmetry",
    "edge_distances": "mesh.edge_distances",
    "engine_name": "backends",
    "flatten_facets": "flatten",
    "frame_of": "frames.steadiness",
    "joined_limbs": "limbs",
    "least_width": "frames.steadiness",
    "limbs_of_bones": "limbs",
    "loading_steps": "loading",
    "nearest_distances": "mesh.edge_distances",
    "nearest_to_identity": "styles.cube",
    "partners": "symmetry",
    "pose_frames": "limbs.frames",
    "placed_limbs": "limbs",
    "problem_with_engine": "backends",
    "rest_mesh": "rest",
    "run": "runner",
    "set_cache_folder": "backends",
    "stylize": "runner",
    "svd_rotations": "rotation_fit",
    "triangle_areas_and_normals": "mesh.rest_measures",
}


def __getattr__(name):
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f".{_MODULES[name]}", __name__), name)
    globals()[name] = value
    return value
