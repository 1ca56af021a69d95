# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes that every Blender can make: what pictures show where no meshes are given.

Each function adds an object to the scene, selected and active, and returns it.
"""

import bmesh
import bpy
from mathutils import Matrix, Vector

from cubic_craft.cubic_craft_addon.command_line.reading.load_meshes import load

BEAR = (
    ((0.0, 0.0, -0.35), (0.55, 0.48, 0.62)),
    ((0.0, -0.03, 0.55), (0.50, 0.44, 0.44)),
    ((0.0, -0.42, 0.45), (0.22, 0.20, 0.17)),
    ((0.42, 0.0, 0.95), (0.20, 0.12, 0.20)),
    ((0.75, -0.12, -0.10), (0.42, 0.15, 0.16)),
    ((0.33, -0.42, -0.85), (0.20, 0.50, 0.20)),
    ((0.33, -0.86, -0.78), (0.22, 0.12, 0.28)),
)
"""center and radii of balls that are melted into one; those with x > 0 are on both sides: body,
head, snout, ear, arm, leg and foot"""
FOX = (
    ((0.0, 0.02, 0.0), (0.0, -0.02, 0.62), 0.36, 0.30),
    ((0.0, -0.02, 0.72), (0.0, -0.04, 0.95), 0.17, 0.16),
    ((0.0, -0.06, 1.26), (0.0, -0.1, 1.26), 0.43, 0.40),
    ((0.0, -0.42, 1.16), (0.0, -0.72, 1.08), 0.22, 0.12),
    ((0.26, -0.02, 1.48), (0.46, 0.04, 1.98), 0.17, 0.05),
    ((0.26, -0.02, 0.62), (0.78, -0.06, 0.14), 0.155, 0.125),
    ((0.78, -0.06, 0.14), (1.12, -0.26, -0.2), 0.125, 0.105),
    ((1.14, -0.28, -0.22), (1.24, -0.34, -0.32), 0.15, 0.13),
    ((0.2, 0.0, -0.2), (0.36, -0.04, -0.75), 0.2, 0.15),
    ((0.36, -0.04, -0.75), (0.46, 0.04, -1.3), 0.15, 0.125),
    ((0.46, 0.02, -1.36), (0.52, -0.3, -1.4), 0.15, 0.12),
    ((0.0, 0.3, -0.1), (-0.0, 0.85, 0.1), 0.12, 0.2),
    ((0.0, 0.85, 0.1), (-0.0, 1.15, 0.75), 0.2, 0.06),
)
"""ends and radii of rows of balls: body, neck, head, snout, ear, arm, hand, leg, foot and tail"""
FOX_FACE = (((0.17, -0.44, 1.36), (0.085, 0.06, 0.1)), ((0.0, -0.83, 1.1), (0.075, 0.06, 0.06)))
"""center and radii of the eyes and the nose, balls of their own"""
VOXEL = 0.035
SMOOTHING = 6
"""steps; they take the corners of the voxels away"""


def monkey() -> bpy.types.Object:
    """Add Blender's monkey, subdivided."""
    return load(None, None).objects[0]


def bear() -> bpy.types.Object:
    """Add a bear of one skin, round all over, with thin necks and limbs; it looks toward -Y."""
    return _melted_balls("Bear", BEAR)


def fox() -> bpy.types.Object:
    """Add a fox that stands like a person, arms and ears aslant, with eyes and a nose."""
    balls = [ball for row in FOX for ball in _row(*row)]
    obj = _melted_balls("Fox", tuple(balls), subdivisions=3)
    edited = bmesh.new()
    edited.from_mesh(obj.data)
    _add_balls(edited, FOX_FACE, subdivisions=3)
    edited.to_mesh(obj.data)
    edited.free()
    obj.data.shade_smooth()
    return obj


def _row(begin: tuple, end: tuple, radius: float, last: float) -> list[tuple]:
    """Return balls so near to each other that they melt into a limb."""
    a, b = Vector(begin), Vector(end)
    count = 2 + int((b - a).length / (0.3 * min(radius, last)))
    shares = [number / (count - 1) for number in range(count)]
    return [(tuple(a.lerp(b, s)), (radius + s * (last - radius),) * 3) for s in shares]


def _add_balls(edited: bmesh.types.BMesh, balls: tuple, subdivisions: int) -> None:
    for center, radii in balls:
        for side in (1.0, -1.0) if center[0] else (1.0,):
            place = Matrix.Translation((side * center[0], *center[1:]))
            matrix = place @ Matrix.Diagonal((*radii, 1.0))
            bmesh.ops.create_icosphere(edited, subdivisions=subdivisions, radius=1.0, matrix=matrix)


def _melted_balls(name: str, balls: tuple, subdivisions: int = 4) -> bpy.types.Object:
    edited = bmesh.new()
    _add_balls(edited, balls, subdivisions)
    mesh = bpy.data.meshes.new(name)
    edited.to_mesh(mesh)
    edited.free()
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    remesh = obj.modifiers.new("Remesh", "REMESH")
    remesh.mode, remesh.voxel_size = "VOXEL", VOXEL
    obj.modifiers.new("Smooth", "SMOOTH").iterations = SMOOTHING
    # Else its voxels would have it lean to a side.
    obj.modifiers.new("Mirror", "MIRROR").use_bisect_axis[0] = True
    for modifier in ("Remesh", "Smooth", "Mirror"):
        bpy.ops.object.modifier_apply(modifier=modifier)
    bpy.ops.object.shade_smooth()
    return obj
