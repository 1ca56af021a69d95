# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks whether objects can be cubified: refusals that name the object and the remedy."""

import bpy
import numpy as np

from ....solver.errors import CubicCraftError
from .arrays import check_fits, read_key, read_position
from .attributes import check_names
from .note import check_note


def check_editable(obj: bpy.types.Object) -> None:
    """Check that an object is a mesh that can be read, solved and written.

    Raises CubicCraftError: as `check_usable`, or coordinates that are not finite.
    """
    check_usable(obj)
    check_finite(mesh_of(obj), obj.name)


def check_usable(obj: bpy.types.Object) -> None:
    """Do the checks of `check_editable` that are cheap enough for each redraw: no coordinates.

    Raises CubicCraftError: not a mesh, linked or overridden data, hidden, in Edit or Sculpt Mode,
    fewer than three vertices, no faces, shape keys that do not fit, or a name conflict with our
    note or attributes.
    """
    mesh = mesh_of(obj)
    if mesh.is_editmode and obj.mode != "EDIT":
        raise CubicCraftError(
            f'"{obj.name}" shares its mesh with an object that is in Edit Mode: go back to Object '
            "Mode first"
        )
    check_writable(mesh, obj.name)
    if obj.mode == "SCULPT":
        # Sculpt Mode keeps its own copy of what it edits.
        raise CubicCraftError(f'"{obj.name}" is in Sculpt Mode: go back to Object Mode first')
    if obj.users_scene and not obj.visible_get():  # objects in no scene are ours, see `make_seen`
        raise CubicCraftError(f'"{obj.name}" {_why_hidden(obj)}')
    if len(mesh.vertices) < 3:
        raise CubicCraftError(
            f'"{obj.name}" has fewer than 3 vertices: add geometry with faces first'
        )
    if not mesh.polygons:
        raise CubicCraftError(f'"{obj.name}" has no faces: fill some in Edit Mode first')
    for key in mesh.shape_keys.key_blocks if mesh.shape_keys is not None else ():
        check_fits(mesh, key)
    check_note(mesh)
    check_names(mesh)


def mesh_of(obj: bpy.types.Object) -> bpy.types.Mesh:
    """Return the mesh of an object.

    Raises CubicCraftError: the object is not a mesh.
    """
    if not isinstance(obj.data, bpy.types.Mesh):
        raise CubicCraftError(
            why_no_mesh(obj)
            or f'"{obj.name}" is not a mesh: select a mesh or convert it (Object > Convert > Mesh)'
        )
    return obj.data


def why_no_mesh(obj: bpy.types.Object) -> str:
    """Return why an object that looks like a mesh, or was one, is none; empty for others."""
    if obj.is_missing:
        return _missing(obj, obj.name)
    if obj.instance_type == "COLLECTION" and obj.instance_collection is not None:
        return (
            f'"{obj.name}" shows instances of a collection, not a mesh of its own: make them real '
            "first (Object > Apply > Make Instances Real)"
        )
    return ""


def check_relative_keys(obj: bpy.types.Object) -> None:
    """Check that a mesh object can take a shape key as a result.

    Raises CubicCraftError: it has absolute shape keys.
    """
    keys = mesh_of(obj).shape_keys
    if keys is not None and not keys.use_relative:
        raise CubicCraftError(
            f'"{obj.name}" has absolute shape keys, which have no value to adjust: enable '
            "Relative (Object Data > Shape Keys) or choose another result"
        )


def check_writable(mesh: bpy.types.Mesh, name: str) -> None:
    """Check that changes to the mesh persist; `name` is used in the message.

    Raises CubicCraftError: as `check_local`, or Edit Mode.
    """
    check_local(mesh, name)
    if mesh.is_editmode:
        raise CubicCraftError(f'"{name}" is in Edit Mode: go back to Object Mode first')


def check_local(mesh: bpy.types.Mesh, name: str) -> None:
    """Check that the mesh is one of this file; `name` is used in the message.

    Blender itself does not object to writes to linked data and only loses them on saving.

    Raises CubicCraftError: linked, missing or overridden data.
    """
    if mesh.is_missing:
        raise CubicCraftError(_missing(mesh, name))
    if is_linked(mesh):
        raise CubicCraftError(
            f'"{name}" has mesh data linked from another file: make it local first '
            "(Object > Relations > Make Local)"
        )


def is_linked(mesh: bpy.types.Mesh) -> bool:
    """Return whether the mesh is linked or overridden data, to which changes do not persist."""
    return mesh.library is not None or mesh.override_library is not None or not mesh.is_editable


def check_finite(mesh: bpy.types.Mesh, name: str) -> None:
    """Check that the mesh and each of its shape keys have finite coordinates.

    Raises CubicCraftError: the message names the shape and the first wrong vertex.
    """
    shapes = {"": read_position(mesh)}
    if mesh.shape_keys is not None:
        shapes |= {
            f' in shape key "{key.name}"': read_key(mesh, key) for key in mesh.shape_keys.key_blocks
        }
    for where, positions in shapes.items():
        broken = np.flatnonzero(~np.isfinite(positions).all(axis=1))
        if len(broken):
            raise CubicCraftError(
                f'"{name}" has coordinates that are not finite{where} (vertex {broken[0]}, '
                f"the first of {len(broken)}): delete those vertices in Edit Mode first"
            )


def _why_hidden(obj: bpy.types.Object) -> str:
    if obj.name not in bpy.context.view_layer.objects:
        return "is not in this view layer: show its scene, or enable its collection there first"
    if obj.hide_viewport:
        return "is hidden in viewports: click its monitor icon in the Outliner first"
    if obj.hide_get():
        return "is hidden: show it first (Object > Show/Hide > Show Hidden Objects)"
    return "is in a hidden collection: show the collection first"


def _missing(block: bpy.types.ID, name: str) -> str:
    path = block.library.filepath if block.library is not None else "another file"
    return (
        f'"{name}" is linked from {path}, where it is missing: bring the file back, or set its '
        "path (Outliner > Blender File)"
    )
