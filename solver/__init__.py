"""Cubic stylization without Blender: NumPy, SciPy and, where it is installed, Taichi."""

from .backends import DEVICES, set_cache_folder
from .errors import CubicCraftError
from .progress import Progress
from .rest_mesh import RestMesh, rest_mesh
from .rotation_fit import svd_rotations
from .setup import Setup
from .stop_rule import StopRule
from .stylization import Energy, Stylization
from .stylize import Result, run, stylize

__all__ = [
    "DEVICES",
    "CubicCraftError",
    "Energy",
    "Progress",
    "RestMesh",
    "Result",
    "Setup",
    "StopRule",
    "Stylization",
    "rest_mesh",
    "run",
    "set_cache_folder",
    "stylize",
    "svd_rotations",
]
