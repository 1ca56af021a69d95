# SPDX-License-Identifier: GPL-3.0-or-later
"""Coarse meshes as modellers make them: a handful of large faces, n-gons, caps."""

import bpy
import numpy as np
from art_objects import add
from art_parts import ball, box, moved, revolved
from mathutils import Matrix


def sphere():
    """Return a UV sphere of 16 segments and 8 rings."""
    return [add("Sphere", ball(segments=16, rings=8))]


def torus(major=24, minor=10, radius=0.25):
    """Return a torus about the Z axis, its centre line a circle of radius 1."""
    bpy.ops.mesh.primitive_torus_add(
        major_segments=major, minor_segments=minor, minor_radius=radius
    )
    return [bpy.context.object]


def cylinder(sides=24):
    """Return a cylinder with an n-gon at each end."""
    bpy.ops.mesh.primitive_cylinder_add(vertices=sides)
    return [bpy.context.object]


def cone(sides=24):
    """Return a cone on an n-gon."""
    bpy.ops.mesh.primitive_cone_add(vertices=sides)
    return [bpy.context.object]


def car(sides=14):
    """Return body, bonnet, cabin and four wheels, 136 vertices, all touching or overlapping."""
    parts = [
        box((4.0, 1.6, 0.5), (0, 0, 0.65), top=(0.97, 0.92)),
        box((1.3, 1.45, 0.25), (1.25, 0, 0.99), top=(0.7, 0.85)),
        box((2.0, 1.45, 0.62), (-0.45, 0, 1.2), top=(0.62, 0.8)),
    ]
    wheel = revolved([(0, -0.14), (0.42, -0.14), (0.42, 0.14), (0, 0.14)], sides)
    sideways = Matrix.Rotation(np.pi / 2, 3, "X")
    for x in (1.2, -1.25):
        for y in (0.9, -0.9):
            parts.append(moved(wheel, sideways, (x, y, 0.42)))
    return [add("Car", *parts, is_smooth=False)]


def text(body="Cubic"):
    """Return a word with a little depth, as a mesh."""
    bpy.ops.object.text_add()
    obj = bpy.context.object
    obj.data.body = body
    obj.data.extrude = 0.05
    bpy.ops.object.convert(target="MESH")
    return [bpy.context.object]


def cuboid(size=(2, 2, 2), axis=(0, 0, 1), degrees=0, bevel=0.0):
    """Return a box of 8 vertices, or with beveled edges; these are turned, not the object."""
    turn = Matrix.Rotation(np.radians(degrees), 3, axis)
    obj = add("Box", moved(box(size), turn), is_smooth=False)
    if bevel:
        modifier = obj.modifiers.new("Bevel", "BEVEL")
        modifier.width, modifier.segments = bevel, 3
        bpy.context.view_layer.objects.active = obj
        bpy.ops.object.modifier_apply(modifier=modifier.name)
    return [obj]


def house(pitch=45):
    """Return a house of 10 vertices whose roof has this pitch in degrees."""
    V, (floor, _, front, right, back, left) = box((3, 2, 1.6), (0, 0, 0.8))
    ridge = 1.6 + np.tan(np.radians(pitch))
    V = np.concatenate([V, [(-1.5, 0, ridge), (1.5, 0, ridge)]])
    roof = [(4, 5, 9, 8), (6, 7, 8, 9)]
    gables = [(*right[:3], 9, right[3]), (*left[:3], 8, left[3])]
    return [add("House", (V, [floor, front, back, *gables, *roof]), is_smooth=False)]
