# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects to work on, and short names for what is done to them."""

import contextlib
import io

import bmesh
import bpy
import numpy as np
from mathutils import Euler, Matrix
from rich_mesh import position_of


def add_monkey(name="Suzanne", **where):
    bpy.ops.mesh.primitive_monkey_add(**where)
    obj = bpy.context.object
    obj.name = name
    return obj


def add_empty(name, **where):
    """Add an object without data; `where` are its location, rotation_euler or matrix_world."""
    empty = bpy.data.objects.new(name, None)
    bpy.context.collection.objects.link(empty)
    for attribute, value in where.items():
        setattr(empty, attribute, value)
    return empty


def add_copy(obj, *, is_linked=False):
    """Add a copy of an object, which shares its mesh if `is_linked`."""
    copy = obj.copy()
    if not is_linked:
        copy.data = obj.data.copy()
    bpy.context.collection.objects.link(copy)
    return copy


def add_triangles():
    """Add a shape without symmetry, in one part and of triangles only."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=4)
    obj = bpy.context.object
    V = position_of(obj.data)
    V *= 1 + 0.3 * np.sin(3 * V[:, :1] + 0.4) * np.cos(2 * V[:, 1:2])
    obj.data.vertices.foreach_set("co", V.ravel())
    obj.data.transform(Euler((0.1, 0.2, 0.05)).to_matrix().to_4x4())
    obj.data.update()
    return obj


@contextlib.contextmanager
def bmesh_of(mesh):
    """Edit a mesh from outside of Edit Mode."""
    edited = bmesh.new()
    edited.from_mesh(mesh)
    edited.verts.ensure_lookup_table()
    yield edited
    edited.to_mesh(mesh)
    edited.free()


@contextlib.contextmanager
def edit_mode(obj):
    """Enter Edit Mode, leave it in the end; yields what is edited there."""
    bpy.context.view_layer.objects.active = obj
    bpy.ops.object.mode_set(mode="EDIT")
    edited = bmesh.from_edit_mesh(obj.data)
    edited.verts.ensure_lookup_table()
    yield edited
    bmesh.update_edit_mesh(obj.data)
    bpy.ops.object.mode_set(mode="OBJECT")


def select(*objects):
    bpy.ops.object.select_all(action="DESELECT")
    for obj in objects:
        obj.select_set(True)
    bpy.context.view_layer.objects.active = objects[0]


QUICK = {"refine": "OFF", "keep_apart": False}
"""a finer copy takes several times as long, and Keep Apart twice as long"""


def change_settings(obj, **settings):
    for name, value in settings.items():
        setattr(obj.cubic_craft, name, value)


def cubify(**options):
    """Cubify in few iterations, and quickly unless the options say otherwise."""
    return bpy.ops.cubic_craft.cubify(**{"max_iterations": 30, **QUICK, **options})


def given(group, matrix=None, threshold=0.5):
    """Return a handle as Cubify takes it."""
    return {"name": group, "threshold": threshold, "matrix": matrix or Matrix()}


def reports_of(run):
    """Return what an operator prints when it is run: its reports, as bpy shows them."""
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        assert run() == {"FINISHED"}
    return printed.getvalue()
