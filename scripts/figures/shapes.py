# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes that every Blender can make: what pictures show where no meshes are given.

Each function adds an object to the scene, selected and active, and returns it.
"""

import math

import bmesh
import bpy
from headless.load_meshes import load
from mathutils import Matrix

__all__ = ("bear", "duck", "letter", "monkey")

BEAR = (
    ((0.0, 0.0, -0.35), (0.55, 0.48, 0.62)),
    ((0.0, -0.03, 0.55), (0.50, 0.44, 0.44)),
    ((0.0, -0.42, 0.45), (0.22, 0.20, 0.17)),
    ((0.42, 0.0, 0.95), (0.20, 0.12, 0.20)),
    ((0.75, -0.12, -0.10), (0.42, 0.15, 0.16)),
    ((0.33, -0.42, -0.85), (0.20, 0.50, 0.20)),
    ((0.33, -0.86, -0.78), (0.22, 0.12, 0.28)),
)
"""body, head, snout, ear, arm, leg and foot"""
DUCK = (
    ((0.0, 0.10, 0.66), (0.68, 1.00, 0.66)),
    ((0.0, 1.05, 1.12), (0.34, 0.42, 0.22)),
    ((0.0, -0.52, 1.68), (0.52, 0.52, 0.50)),
    ((0.0, -1.10, 1.60), (0.26, 0.36, 0.12)),
    ((0.64, 0.16, 0.80), (0.18, 0.56, 0.34)),
)
"""centre and radii of balls that are melted into one; those with x > 0 are on both sides"""
VOXEL = 0.035
SMOOTHING = 6
"""steps; they take the corners of the voxels away"""


def monkey() -> bpy.types.Object:
    """Add Blender's monkey, subdivided."""
    return load(None, None, verbose=False).objects[0]


def bear() -> bpy.types.Object:
    """Add a bear of one skin, round all over, with thin necks and limbs; it looks toward -Y."""
    return _melted_balls("Bear", BEAR)


def duck() -> bpy.types.Object:
    """Add a rubber duck."""
    return _melted_balls("Duck", DUCK)


def letter() -> bpy.types.Object:
    """Add an ampersand with round edges."""
    bpy.ops.object.text_add(rotation=(math.pi / 2, 0.0, 0.0))
    curve = bpy.context.object.data
    curve.body, curve.size = "&", 3.0
    curve.extrude, curve.bevel_depth, curve.bevel_resolution = 0.25, 0.12, 4
    bpy.ops.object.convert(target="MESH")
    bpy.ops.object.transform_apply()
    _melt(bpy.context.object)
    return bpy.context.object


def _melted_balls(name: str, balls: tuple) -> bpy.types.Object:
    edited = bmesh.new()
    for centre, radii in balls:
        for side in (1.0, -1.0) if centre[0] else (1.0,):
            place = Matrix.Translation((side * centre[0], *centre[1:]))
            matrix = place @ Matrix.Diagonal((*radii, 1.0))
            bmesh.ops.create_icosphere(edited, subdivisions=4, radius=1.0, matrix=matrix)
    mesh = bpy.data.meshes.new(name)
    edited.to_mesh(mesh)
    edited.free()
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    _melt(obj)
    # Else its voxels would have it lean to a side.
    obj.modifiers.new("Mirror", "MIRROR").use_bisect_axis[0] = True
    bpy.ops.object.modifier_apply(modifier="Mirror")
    return obj


def _melt(obj: bpy.types.Object) -> None:
    """Make the active object one smooth closed surface."""
    remesh = obj.modifiers.new("Remesh", "REMESH")
    remesh.mode, remesh.voxel_size = "VOXEL", VOXEL
    obj.modifiers.new("Smooth", "SMOOTH").iterations = SMOOTHING
    for modifier in ("Remesh", "Smooth"):
        bpy.ops.object.modifier_apply(modifier=modifier)
    bpy.ops.object.shade_smooth()
