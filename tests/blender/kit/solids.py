# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects that a form can be made from, and how much of a surface faces its sides."""

import bpy
import numpy as np


def add_solid(kind, name="Form", **where):
    """Add an object that a form can be made from."""
    {
        "cube": bpy.ops.mesh.primitive_cube_add,
        "ball": lambda **options: bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=4, **options),
        "plane": bpy.ops.mesh.primitive_plane_add,
        "cone": lambda **options: bpy.ops.mesh.primitive_cone_add(vertices=5, **options),
    }[kind](**where)
    bpy.context.object.name = name
    return bpy.context.object


def share_facing(obj, normals, angle=10.0, where=slice(None)):
    """Return the share of an object's surface, or of some faces, that faces one of the normals."""
    mesh = obj.data
    areas, found = np.empty(len(mesh.polygons)), np.empty((len(mesh.polygons), 3))
    mesh.polygons.foreach_get("area", areas)
    mesh.polygons.foreach_get("normal", found.ravel())
    near = (found @ np.asarray(normals).T).max(axis=1) > np.cos(np.radians(angle))
    return (areas * near)[where].sum() / areas[where].sum()
