# SPDX-License-Identifier: GPL-3.0-or-later
"""Figure 6: one mesh, cubified toward cubes of different orientation, with each cube beside it."""

import math

import bmesh
import bpy
from mathutils import Euler

from cubic_craft.cubic_craft_addon.command_line.picture.gallery import Group
from cubic_craft.cubic_craft_addon.command_line.picture.studio import FINISHES, surface

from .figure_meshes import AS_IN_THE_PAPER, FigureMeshes, Model, stand_beside

CUBENESS = 0.6
ORIENTATIONS = {
    "not turned": (0.0, 0.0, 0.0),
    "45\N{DEGREE SIGN} about Z": (0.0, 0.0, 45.0),
    "45\N{DEGREE SIGN} about X": (45.0, 0.0, 0.0),
    "on a corner": (45.0, math.degrees(math.atan(math.sqrt(0.5))), 0.0),
}
"""label: Euler angles in degrees, relative to the mesh"""
EDGE = 0.2
"""of the cube, relative to the largest side of the mesh"""
BEVEL = 0.06
"""relative to the edge"""


def compose(meshes: FigureMeshes) -> list[Group]:
    """Return the cubic versions, each with the cube that it is turned toward."""
    (model,) = meshes.there(["bunny"], instead=["monkey"])
    clay = surface("Cube", *FINISHES["clay"])
    groups = []
    for label, angles in ORIENTATIONS.items():
        # Left free, the whole mesh would turn toward the cube.
        settings = AS_IN_THE_PAPER | {"rotation": "KEEP"}
        shape = meshes.cubified(model, CUBENESS, angles, **settings)
        group = meshes.group(model, shape, label, "green")
        _add_cube(group, model, angles, clay)
        groups.append(group)
    return groups


def _add_cube(
    group: Group, model: Model, angles: tuple[float, float, float], clay: bpy.types.Material
) -> None:
    axes = Euler([math.radians(angle) for angle in angles]).to_matrix()
    upright = model.place.to_3x3().normalized() @ axes
    stand_beside(group, _cube(EDGE * group.extent, clay), upright.to_4x4())


def _cube(edge: float, clay: bpy.types.Material) -> bpy.types.Object:
    edited = bmesh.new()
    bmesh.ops.create_cube(edited, size=edge)
    mesh = bpy.data.meshes.new("Cube")
    edited.to_mesh(mesh)
    edited.free()
    mesh.materials.append(clay)
    cube = bpy.data.objects.new("Cube", mesh)
    bevel = cube.modifiers.new("Bevel", "BEVEL")
    bevel.width, bevel.segments = BEVEL * edge, 3
    return cube
