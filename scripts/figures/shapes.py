# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes that every Blender can make: what the figures show where no meshes are given."""

import math
from collections.abc import Callable

import bpy
from headless.load_meshes import load

__all__ = ("bear", "letter", "monkey", "ring")

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


def monkey() -> bpy.types.Object:
    """Return Blender's monkey, subdivided."""
    return load(None, None, verbose=False).objects[0]


def ring() -> bpy.types.Object:
    """Return a torus that stands on its rim."""
    bpy.ops.mesh.primitive_torus_add(
        major_segments=96, minor_segments=48, major_radius=1.0, minor_radius=0.38
    )
    torus = bpy.context.object
    torus.rotation_euler.x = math.pi / 2
    bpy.ops.object.transform_apply(location=False, rotation=True, scale=False)
    return torus


def bear() -> bpy.types.Object:
    """Return a teddy bear."""

    def ball(place: tuple[float, float, float], radii: tuple[float, float, float]) -> None:
        bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=24, location=place)
        bpy.context.object.scale = radii

    return _melted([lambda place=place, radii=radii: ball(place, radii) for place, radii in BEAR])


def letter() -> bpy.types.Object:
    """Return an ampersand with round edges."""

    def text() -> None:
        bpy.ops.object.text_add(rotation=(math.pi / 2, 0.0, 0.0))
        curve = bpy.context.object.data
        curve.body = "&"
        curve.size = 3.0
        curve.extrude = 0.25
        curve.bevel_depth = 0.12
        curve.bevel_resolution = 4
        bpy.ops.object.convert(target="MESH")

    return _melted([text])


def _melted(makers: list[Callable[[], None]]) -> bpy.types.Object:
    """Join what the makers make, each the active object, into one smooth closed surface."""
    made = []
    for make in makers:
        make()
        made.append(bpy.context.object)
    if len(made) > 1:
        for part in made:
            part.select_set(True)
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
