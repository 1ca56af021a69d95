# SPDX-License-Identifier: GPL-3.0-or-later
"""The bear of the pictures: one skin, round all over, with thin necks and limbs.

A monkey or a sphere would do for the cubeness, but not for what solidity does.
"""

import bmesh
import bpy
from mathutils import Matrix

__all__ = ("add_bear",)

_BALLS = (
    # name, centre, radii; those with x > 0 are on both sides
    ("body", (0.0, 0.0, -0.35), (0.55, 0.48, 0.62)),
    ("head", (0.0, -0.03, 0.55), (0.50, 0.44, 0.44)),
    ("snout", (0.0, -0.42, 0.45), (0.22, 0.20, 0.17)),
    ("ear", (0.42, 0.0, 0.95), (0.20, 0.12, 0.20)),
    ("arm", (0.75, -0.12, -0.10), (0.42, 0.15, 0.16)),
    ("leg", (0.33, -0.42, -0.85), (0.20, 0.50, 0.20)),
    ("foot", (0.33, -0.86, -0.78), (0.22, 0.12, 0.28)),
)
_VOXEL = 0.035
_SMOOTHING = 6  # steps; it takes the corners of the voxels away


def add_bear() -> bpy.types.Object:
    """Add the bear to the scene, selected and active; it looks toward -Y, as Blender's monkey."""
    edited = bmesh.new()
    for _, centre, radii in _BALLS:
        for side in (1.0, -1.0) if centre[0] else (1.0,):
            place = Matrix.Translation((side * centre[0], *centre[1:]))
            matrix = place @ Matrix.Diagonal((*radii, 1.0))
            bmesh.ops.create_icosphere(edited, subdivisions=4, radius=1.0, matrix=matrix)
    mesh = bpy.data.meshes.new("Bear")
    edited.to_mesh(mesh)
    edited.free()
    bear = bpy.data.objects.new("Bear", mesh)
    bpy.context.collection.objects.link(bear)
    bpy.context.view_layer.objects.active = bear
    bear.select_set(True)
    remesh = bear.modifiers.new("Remesh", "REMESH")
    remesh.mode, remesh.voxel_size = "VOXEL", _VOXEL
    bear.modifiers.new("Smooth", "SMOOTH").iterations = _SMOOTHING
    mirror = bear.modifiers.new("Mirror", "MIRROR")
    mirror.use_bisect_axis[0] = True  # else its voxels would have it lean to a side
    for modifier in ("Remesh", "Smooth", "Mirror"):
        bpy.ops.object.modifier_apply(modifier=modifier)
    bpy.ops.object.shade_smooth()
    return bear
