# SPDX-License-Identifier: GPL-3.0-or-later
"""Read a mesh while the artist works on it, in Edit or Sculpt Mode too.

Both modes keep a copy of their own of what they edit. It is written to the mesh, as saving a file
does, and the mesh is read from a copy, which is in no mode.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from itertools import chain

import bmesh
import bpy
import numpy as np

from ....solver.errors import CubicCraftError
from .arrays import corner_vertices, read_position
from .checks import mesh_of

_OWN_COPY = ("EDIT", "SCULPT")


def remove_copy(new: bpy.types.Object) -> None:
    """Remove an object that was made here, and its mesh, which nothing else uses."""
    mesh = mesh_of(new)
    bpy.data.objects.remove(new)
    bpy.data.meshes.remove(mesh)


def copied(obj: bpy.types.Object) -> bpy.types.Object:
    """Return a copy of a mesh object with a copy of its mesh, in no scene."""
    mesh, new = mesh_of(obj).copy(), obj.copy()
    assert mesh is not None and new is not None
    new.data = mesh  # what is changed from here on, such as shape keys, is of the copy alone
    return new


@contextmanager
def passing_copy(new: bpy.types.Object, obj: bpy.types.Object) -> Iterator[bpy.types.Object]:
    """Provide a copy of an object to read from, and remove it.

    Raises CubicCraftError: what is raised while it is read, with the name of the object itself.
    """
    name = new.name
    try:
        yield new
    except CubicCraftError as error:
        raise CubicCraftError(str(error).replace(name, obj.name)) from error
    finally:
        remove_copy(new)


def flush(obj: bpy.types.Object) -> bool:
    """Write what is edited to the mesh; return whether Blender will report the mesh as changed."""
    if obj.mode not in _OWN_COPY:
        return False
    obj.update_from_editmode()
    return obj.mode == "EDIT"


@contextmanager
def in_no_mode(obj: bpy.types.Object) -> Iterator[bpy.types.Object]:
    """Provide an object with the same mesh, modifiers and place that can be read in any mode.

    It is the object itself in those modes in which it can be read.
    """
    if obj.mode not in _OWN_COPY:
        yield obj
        return
    flush(obj)
    with passing_copy(copied(obj), obj) as copy:
        yield copy


def glance(obj: bpy.types.Object) -> tuple[np.ndarray, np.ndarray | None]:
    """Read the present shape, without shape keys, and change nothing.

    Returns `positions`: (n,3) float32, object space; `corners`: (c,) int32 or None, the vertices of
    the face corners; None in Edit Mode, where this would take long.
    """
    mesh = mesh_of(obj)
    if mesh.is_editmode:
        vertices = bmesh.from_edit_mesh(mesh).verts
        values = chain.from_iterable([vertex.co[:] for vertex in vertices])
        return np.fromiter(values, np.float32, 3 * len(vertices)).reshape(-1, 3), None
    return read_position(mesh), corner_vertices(mesh)
