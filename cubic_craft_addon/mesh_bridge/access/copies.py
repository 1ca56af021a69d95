# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects with a mesh of their own that are made for a while, and removed with it."""

from collections.abc import Iterator
from contextlib import contextmanager

import bpy

from ....solver.errors import CubicCraftError
from .checks import mesh_of


def remove_copy(new: bpy.types.Object) -> None:
    """Remove an object that was made here, and its mesh, which nothing else uses."""
    mesh = mesh_of(new)
    bpy.data.objects.remove(new)
    bpy.data.meshes.remove(mesh)


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
