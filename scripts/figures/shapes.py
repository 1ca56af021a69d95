# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes that every Blender can make: what the figures show where no meshes are given."""

import math

import bpy
from headless.load_meshes import load

__all__ = ("bear", "duck", "letter", "monkey")

VOXELS = 70
"""along the largest side of a shape that is remeshed"""
BEAR = (
    # centre, radii; the bear looks along -Y
    ((0.0, 0.0, 0.95), (0.80, 0.68, 0.90)),
    ((0.0, -0.05, 2.15), (0.68, 0.62, 0.60)),
    ((0.0, -0.62, 2.02), (0.28, 0.30, 0.22)),
    ((-0.52, 0.0, 2.70), (0.26, 0.16, 0.26)),
    ((0.52, 0.0, 2.70), (0.26, 0.16, 0.26)),
    ((-0.88, -0.25, 1.30), (0.26, 0.34, 0.52)),
    ((0.88, -0.25, 1.30), (0.26, 0.34, 0.52)),
    ((-0.48, -0.50, 0.20), (0.34, 0.62, 0.30)),
    ((0.48, -0.50, 0.20), (0.34, 0.62, 0.30)),
)
"""ellipsoids that are melted into one"""
DUCK = (
    ((0.0, 0.10, 0.66), (0.68, 1.00, 0.66)),
    ((0.0, 1.05, 1.12), (0.34, 0.42, 0.22)),
    ((0.0, -0.52, 1.68), (0.52, 0.52, 0.50)),
    ((0.0, -1.10, 1.60), (0.26, 0.36, 0.12)),
    ((-0.64, 0.16, 0.80), (0.18, 0.56, 0.34)),
    ((0.64, 0.16, 0.80), (0.18, 0.56, 0.34)),
)


def monkey() -> bpy.types.Object:
    """Return Blender's monkey, subdivided."""
    return load(None, None, verbose=False).objects[0]


def bear() -> bpy.types.Object:
    """Return a teddy bear."""
    return _melted([_ball(*ellipsoid) for ellipsoid in BEAR])


def duck() -> bpy.types.Object:
    """Return a rubber duck."""
    return _melted([_ball(*ellipsoid) for ellipsoid in DUCK])


def letter() -> bpy.types.Object:
    """Return an ampersand with round edges."""
    bpy.ops.object.text_add(rotation=(math.pi / 2, 0.0, 0.0))
    curve = bpy.context.object.data
    curve.body = "&"
    curve.size = 3.0
    curve.extrude = 0.25
    curve.bevel_depth = 0.12
    curve.bevel_resolution = 4
    bpy.ops.object.convert(target="MESH")
    return _melted([bpy.context.object])


Triple = tuple[float, float, float]


def _ball(place: Triple, radii: Triple) -> bpy.types.Object:
    bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=24, location=place)
    bpy.context.object.scale = radii
    return bpy.context.object


def _melted(parts: list[bpy.types.Object]) -> bpy.types.Object:
    """Join parts, the last of which is active, into one smooth closed surface."""
    for part in parts:
        part.select_set(True)
    if len(parts) > 1:
        bpy.ops.object.join()
    joined = bpy.context.object
    bpy.ops.object.transform_apply()
    remesh = joined.modifiers.new("Remesh", "REMESH")
    remesh.mode = "VOXEL"
    remesh.voxel_size = max(joined.dimensions) / VOXELS
    bpy.ops.object.modifier_apply(modifier=remesh.name)
    smooth = joined.modifiers.new("Smooth", "SMOOTH")
    smooth.iterations = 12
    bpy.ops.object.modifier_apply(modifier=smooth.name)
    bpy.ops.object.shade_smooth()
    return joined
