# SPDX-License-Identifier: GPL-3.0-or-later
"""`stylize` turns a mesh into a cubic sculpture, and `stylize_mesh` one of trimesh.

    from solver import ball, stylize

    V, F = ball()  # positions (n,3) and triangles (m,3)
    result = stylize(V, F, 0.4, form="octahedron")
    print(result.positions, result.converged)

All is as in Blender, unless it is told otherwise; `PAPER` is the method of the paper. Step by step,
`rest_mesh`, `Setup`, `Style` and `Stylization` lead to `run`; `piece_of` and `join_pieces` are for
several objects, handles, mirrors and regions. Blender is not needed: NumPy and SciPy are, and
Taichi or Quadrants are used if they are installed.

The names are imported on first use, so that Blender can show the panel of the extension without
loading SciPy, and even if SciPy is missing.
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .backends import DEVICES as DEVICES
    from .backends import engine_name as engine_name
    from .backends import problem_with_engine as problem_with_engine
    from .backends import set_cache_folder as set_cache_folder
    from .errors import CubicCraftError as CubicCraftError
    from .facets.flatten import Flattened as Flattened
    from .facets.flatten import flatten_facets as flatten_facets
    from .facets.low_poly import LowPoly as LowPoly
    from .facets.low_poly import low_poly as low_poly
    from .frames.sequence import FrameSequence as FrameSequence
    from .frames.sequence import SequenceState as SequenceState
    from .frames.steadiness import MOST_JUMPS as MOST_JUMPS
    from .frames.steadiness import Frames as Frames
    from .frames.steadiness import frame_of as frame_of
    from .frames.steadiness import least_width as least_width
    from .iteration.loading import loading_steps as loading_steps
    from .iteration.options import SolverOptions as SolverOptions
    from .iteration.pose import Pose as Pose
    from .iteration.progress import Progress as Progress
    from .iteration.result import Energy as Energy
    from .iteration.result import Result as Result
    from .iteration.runner import Run as Run
    from .iteration.setup import Setup as Setup
    from .iteration.stop_rule import StopRule as StopRule
    from .iteration.stylization import Stylization as Stylization
    from .limbs import KnownLimbs as KnownLimbs
    from .limbs import joined_limbs as joined_limbs
    from .limbs import limbs_of_bones as limbs_of_bones
    from .limbs import placed_limbs as placed_limbs
    from .mesh.ball import ball as ball
    from .mesh.edge_distances import edge_distances as edge_distances
    from .mesh.rest_measures import triangle_areas_and_normals as triangle_areas_and_normals
    from .meshes import stylize_mesh as stylize_mesh
    from .one_call import run as run
    from .one_call import stylize as stylize
    from .orientation.auto_orientation import auto_orient as auto_orient
    from .pieces.from_mesh import piece_of as piece_of
    from .pieces.handle_pose import HandlePose as HandlePose
    from .pieces.piece import Piece as Piece
    from .pieces.problem import Problem as Problem
    from .pieces.problem import join_pieces as join_pieces
    from .pieces.reflection import Reflection as Reflection
    from .pieces.reflection import flip as flip
    from .proxy.options import PAPER as PAPER
    from .proxy.options import ProxyOptions as ProxyOptions
    from .rotation_fit import svd_rotations as svd_rotations
    from .styles.cube import nearest_to_identity as nearest_to_identity
    from .styles.style import Style as Style
    from .surface.preparation import rest_mesh as rest_mesh
    from .surface.rest import RestMesh as RestMesh
    from .surface.symmetry import MATCHING as MATCHING
    from .surface.symmetry import NO_PARTNER as NO_PARTNER
    from .surface.symmetry import Mirror as Mirror
    from .surface.symmetry import commuting as commuting
    from .surface.symmetry import partners as partners

    __version__: str
else:
    _NAMES = {
        "backends": "DEVICES engine_name problem_with_engine set_cache_folder",
        "errors": "CubicCraftError",
        "facets.flatten": "Flattened flatten_facets",
        "facets.low_poly": "LowPoly low_poly",
        "frames.sequence": "FrameSequence SequenceState",
        "frames.steadiness": "MOST_JUMPS Frames frame_of least_width",
        "iteration.loading": "loading_steps",
        "iteration.options": "SolverOptions",
        "iteration.pose": "Pose",
        "iteration.progress": "Progress",
        "iteration.result": "Energy Result",
        "iteration.runner": "Run",
        "iteration.setup": "Setup",
        "iteration.stop_rule": "StopRule",
        "iteration.stylization": "Stylization",
        "limbs": "KnownLimbs joined_limbs limbs_of_bones placed_limbs",
        "mesh.ball": "ball",
        "mesh.edge_distances": "edge_distances",
        "mesh.rest_measures": "triangle_areas_and_normals",
        "meshes": "stylize_mesh",
        "one_call": "run stylize",
        "orientation.auto_orientation": "auto_orient",
        "pieces.from_mesh": "piece_of",
        "pieces.handle_pose": "HandlePose",
        "pieces.piece": "Piece",
        "pieces.problem": "Problem join_pieces",
        "pieces.reflection": "Reflection flip",
        "proxy.options": "PAPER ProxyOptions",
        "rotation_fit": "svd_rotations",
        "styles.cube": "nearest_to_identity",
        "styles.style": "Style",
        "surface.preparation": "rest_mesh",
        "surface.rest": "RestMesh",
        "surface.symmetry": "MATCHING NO_PARTNER Mirror commuting partners",
    }
    _MODULES = {name: f".{room}" for room, names in _NAMES.items() for name in names.split()}

    __all__ = sorted(_MODULES)

    def __getattr__(name):
        if name in _MODULES:
            from importlib import import_module

            value = getattr(import_module(_MODULES[name], __name__), name)
        elif name == "__version__":
            value = _version()
        else:
            raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
        globals()[name] = value
        return value

    def __dir__():
        return sorted({*__all__, "__version__", *(x for x in globals() if x.startswith("__"))})

    def _version():
        from importlib.metadata import PackageNotFoundError, version

        try:
            return version("cubic-craft")
        except PackageNotFoundError as error:
            raise AttributeError("the package cubic-craft is not installed") from error
