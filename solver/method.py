# SPDX-License-Identifier: GPL-3.0-or-later
"""Every setting, once: its name, default, limits, words and who has it.

From here come Blender's properties and those of the operators, what a preset holds, the options of
both command lines, the library's defaults, and what the tables of the documentation are checked
against. Nothing here needs SciPy, without which the panel is shown, too.

Names, and the numbers of choices, are in files: only add to them.
"""

import math
from dataclasses import dataclass
from typing import Any

from .setting import declared, setting
from .styles.form_names import FORMS, WITH_SIDES

_XYZ = ("X", "Y", "Z")


@dataclass(frozen=True, kw_only=True)
class Style:
    """What the surface is turned toward, and how strongly."""

    cubeness: float = setting(0.4, metavar="L", limits=(0, 10), soft=(0, 1))(
        "Cubeness",
        "How strongly the surface turns toward the sides of the form. 0 keeps the shape, 0.1 moves"
        " it a third of the way, 0.4 most of it. You can type values beyond the slider, up to 10",
        "0 keeps the shape, 0.1 to 1 are common",
    )
    crispness: float = setting(0.9, metavar="C", limits=(0, 1), paper=0.0)(
        "Crispness",
        "How far the sides of the cubic shape are made flat and its edges straight. 0 is soft, 1"
        " is cut as with a knife; details stay on the sides",
        "how far sides are made flat and edges straight: from 0, soft, to 1",
    )
    form: str = setting("CUBE")(
        "Form",
        "What a ball would become: the surface turns toward the sides of this form",
        "what a ball would become",
        choices=FORMS,
    )
    form_sides: int = setting(6, metavar="N", limits=(3, 64), soft=(3, 12), of_forms=WITH_SIDES)(
        "Sides", "Number of walls or slopes around the Z axis", "of a prism or pyramid"
    )
    form_weights: tuple[float, float, float] = setting(
        (1.0,) * 3, metavar=_XYZ, limits=(0, 10), soft=(0, 2), subtype="XYZ", of_forms=("BOX",)
    )(
        "Weights",
        "How strongly the surface turns away from each axis of the box. (1, 1, 0) makes slabs,"
        " (0, 0, 1) upright walls",
        "of the axes of a box, whose sides count that much; 1 1 0 makes slabs",
    )
    orientation: tuple[float, float, float] = setting(
        (0.0, 0.0, 0.0), metavar=_XYZ, soft=(-math.pi / 4, math.pi / 4), subtype="EULER"
    )(
        "Orientation",
        "Rotation of the form",
        "Euler angles of the form in degrees: about X, then Y, then Z",
    )


@dataclass(frozen=True, kw_only=True)
class StyleInScene:
    """The same, where there are other objects and vertex groups."""

    form_directions: str = setting("", metavar="VECTORS", of_forms=("FACES",))(
        "Directions",
        "Directions that the sides of the form face, in its own axes: three numbers for each, such"
        ' as "0 0 1, 1 0 0". Directions from Selection writes them',
        'for --form faces the directions of its sides, three numbers for each: "0 0 1, 1 0 0";'
        " where they leave a side open, those opposite are added",
    )
    space: str = setting("WORLD")(
        "Relative To",
        "Axes that the rotation of the form is relative to",
        "what --orientation is relative to: the axes of the scene that the file is read into,"
        " where Z is up, or those of each object",
        choices={
            "OBJECT": "Object: The angles are relative to the object's own axes, so the form"
            " rotates with the object",
            "WORLD": "World: The angles are relative to the world axes, however the object is"
            " rotated",
            "FRAME": "Frame: The angles are relative to the axes of another object",
        },
    )
    map_group: str = setting("", option="map", metavar="GROUP", is_of_mesh=True)(
        "Vertex Group",
        "Vertex group whose weights scale the cubeness",
        "vertex group that scales the cubeness",
    )
    map_invert: bool = setting(False, is_of_mesh=True)(
        "Invert", "Invert the influence of the vertex group"
    )


@dataclass(frozen=True, kw_only=True)
class Kept:
    """What is kept of the shape."""

    keep_pose: bool = setting(True, paper=False)(
        "Keep Pose",
        "Turn limbs into boxes along themselves, so that a raised arm stays raised. When off,"
        " limbs turn toward the sides of the form too",
        "whether limbs become boxes along themselves, so that the pose stays",
    )
    detail: float = setting(0.05, metavar="SIZE", limits=(0, 1), soft=(0, 0.2), paper=0.0)(
        "Detail",
        "Features smaller than this, such as noses and toes, ride along instead of being"
        " flattened. It is a share of the largest dimension: 0.05 is a twentieth, on limbs less,"
        " and 0 flattens everything",
        "features smaller than this share of the largest extent ride along instead of being"
        " flattened; 0 flattens all",
    )
    detail_strength: float = setting(1.0, metavar="S", limits=(0, 10), soft=(0, 2), paper=1.0)(
        "Detail Strength",
        "How high details stand out: 0 leaves a smooth sculpture, 1 keeps them as they are, more"
        " exaggerates them",
        "how high these features stand out: 0 removes them, 2 doubles them",
    )
    solidity: float = setting(0.3, metavar="S", limits=(0, 10), soft=(0, 1), paper=0.0)(
        "Solidity",
        "How firmly limbs, necks and walls keep their thickness, and bodies their volume. At 0 the"
        " mesh is a hollow surface that may fold flat; higher values are less cubic",
        "how firmly limbs, walls and the volume keep their thickness; 0 is a hollow skin",
    )
    # Where it begins to take effect in an animation, surfaces would jump.
    keep_apart: bool = setting(True, paper=False, in_animation=False)(
        "Keep Apart",
        "Keep surfaces from growing into each other, such as fingers side by side. Those that"
        " already cross are not changed by this, and parts that would stay round may cross",
        "whether surfaces that do not cross are kept from crossing",
    )
    together: str = setting("SELECTION", paper="OFF", is_of_all_frames=True)(
        "Keep Together",
        "What moves along with the parts it touches: eyes with the head, buttons with the coat",
        "parts: the parts of a mesh stay on each other; selection: all meshes of the file do",
        choices={
            "OFF": "Off: Each part becomes cubic on its own, whatever it touches",
            "PARTS": "Parts: The parts of a mesh stay together, such as eyes in their sockets",
            "SELECTION": "Selection: Meshes that are selected together also stay together, such as"
            " clothes on a body",
        },
    )


@dataclass(frozen=True, kw_only=True)
class Advanced:
    """What is rarely changed."""

    refine: str = setting("AUTO", paper="OFF", is_of_all_frames=True)(
        "Refine",
        "How to solve meshes with few vertices",
        "auto: coarse meshes are solved on a finer copy",
        choices={
            "AUTO": "Auto: Solve a coarse mesh as if it were finer, so that it becomes as cubic as"
            " a dense one; it keeps its own vertices",
            "OFF": "Off: Solve the mesh as it is",
        },
    )
    # Number 0 was Auto, which Blender reads as the default.
    rotation: str = setting("KEEP", paper="FREE", numbers=(1, 2))(
        "Parts May Turn",
        "Whether parts may turn as a whole to fit the cube. Parts with handles are not affected",
        "whether each part is held in its orientation, or may turn as a whole",
        choices={
            "KEEP": "No: No part turns or leans as a whole: upright parts stay upright",
            "FREE": "Yes: A part may turn by some degrees, to fit the cube a little better",
        },
    )


@dataclass(frozen=True, kw_only=True)
class KeptInScene:
    """What is kept where there are objects, vertex groups and a ground."""

    detail_group: str = setting("", option="detail-map", metavar="GROUP", is_of_mesh=True)(
        "Detail Group",
        "Vertex group whose weights scale the strength of details, such as of a face",
        "vertex group that scales the strength of details",
    )
    # A pose is not symmetric, even if the character is.
    keep_symmetric: bool = setting(True, paper=False, in_animation=False)(
        "Keep Symmetric",
        "A mesh of which 99 % mirror each other about its origin, along X, Y or Z, stays"
        " symmetric, if its form and weights are, too. So do objects solved together, such as a"
        " body with clothes and eyes, about the plane that they share",
    )
    symmetry: tuple[bool, bool, bool] = setting(
        (False,) * 3, subtype="XYZ", in_animation=(False,) * 3
    )(
        "Symmetry",
        "Keep halves that mirror each other about the object's origin exactly symmetric. A Mirror"
        " modifier does not need this",
    )
    floor: str = setting("AUTO")(
        "Keep on Floor",
        "What keeps its height in the world, except for parts held by handles or the cubeness map",
        "what keeps its height: all that stands on feet or a base (auto, the default), whatever is"
        " lowest (on), or nothing",
        choices={
            "AUTO": "What Stands: All feet, paws, wheels and legs, or a wide base, if parts may not"
            " turn",
            "ON": "Lowest Point: Whatever is lowest, such as a ball, and all that stands",
            "OFF": "Off: Nothing",
        },
    )
    hold_rest: bool = setting(True, paper=False)(
        "Hold the Rest",
        "Where no handle is pinned, keep regions far from the moved handles in place as a whole;"
        " they still become cubic. When off, they move along",
        "whether what is far from handles that are moved stays where it is",
    )


@dataclass(frozen=True, kw_only=True)
class Computation:
    """Where it is computed, and when that ends."""

    device: str = setting("AUTO", keeps_result=True)(
        "Device",
        "Library and hardware to compute with",
        "",
        choices={
            "AUTO": "Auto: Taichi or Quadrants on the processor if it is installed, otherwise"
            " NumPy",
            "CPU": "CPU: Taichi or Quadrants on the processor",
            "GPU": "GPU: Taichi or Quadrants on the graphics card",
            "NUMPY": "NumPy: Neither Taichi nor Quadrants: slower, but works everywhere",
        },
    )
    max_iterations: int = setting(1000, metavar="N", limits=(1, 1_000_000), soft=(1, 5000))(
        "Max Iterations", "Stop after this many iterations, even if not converged", ""
    )
    tolerance: float = setting(0.001, metavar="T", limits=(1e-12, 1), digits=6)(
        "Tolerance",
        "Stop when an iteration moves no vertex by more than this fraction of the largest distance"
        " from the original, and the energy no longer falls",
        "",
    )


# Fields are collected from the last base to the first.
@dataclass(frozen=True, kw_only=True)
class Method(Computation, KeptInScene, Advanced, Kept, StyleInScene, Style):
    """The settings of a run as plain values, but for what is in Blender only."""


IN_LIBRARY = (Style, Kept, Advanced, Computation)
"""those that need no scene"""
SETTINGS = declared(Method)
"""by their names, as the panel has them from top to bottom"""
LOOK = tuple(n for n, each in SETTINGS.items() if each.paper is not None or n == "cubeness")
"""names of what a preset holds; the orientation belongs to a mesh, the device to a machine"""
PAPER: dict[str, Any] = {n: x.paper for n, x in SETTINGS.items() if x.paper is not None}
"""values as in the paper, which leaves the cubeness as it is"""
