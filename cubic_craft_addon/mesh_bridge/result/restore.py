# SPDX-License-Identifier: GPL-3.0-or-later
"""Restore the original, or keep the result and discard the original."""

import bpy

from ....solver.errors import CubicCraftError
from ..access.attributes import our_attributes
from ..access.checks import check_writable, mesh_of
from ..access.note import read_note, write_note
from ..access.shapes import Shapes, write_shapes
from ..access.sharp_edges import forget_edges, leave_edges
from ..memory.cubic_key import find_cubic_key, remove_cubic_key
from ..memory.first_original import drop_first, first_shapes, has_first
from ..memory.original import drop_stored, has_original, has_stored, original_shapes
from ..preview.store import end_preview
from .rollback import all_or_nothing


def restore(obj: bpy.types.Object) -> None:
    """Restore the original bits of a mesh and remove all our data but a first original from it.

    If the mesh has been transformed since, as a whole or in parts, so is the original. Edits by
    hand are lost.

    Raises CubicCraftError: nothing to restore, or a mesh that cannot be written, which is then
    unchanged.
    """
    mesh = mesh_of(obj)
    check_writable(mesh, obj.name)
    end_preview(mesh)
    if not has_original(mesh):
        if has_first(mesh) and not has_stored(mesh):
            raise CubicCraftError(
                f'"{obj.name}" has the shape that it was last cubified from: Restore First brings '
                "back the first original"
            )
        if has_traces(mesh):
            how = " so that its original can no longer be determined" if has_stored(mesh) else ""
            raise CubicCraftError(
                f'"{obj.name}" has been edited since it was cubified{how}, and its current shape '
                "is now the original: Apply removes the remains of the previous one"
            )
        raise CubicCraftError(f'"{obj.name}" has no original to restore: cubify it first')
    _put_back(mesh, original_shapes(mesh, "ORIGINAL"))


def restore_first(obj: bpy.types.Object) -> None:
    """Restore the original that *From Here* has replaced, and remove all our data from the mesh.

    It is transformed as `restore` does. The later originals, which were edited by hand, are lost.

    Raises CubicCraftError: there is no first original, or a mesh that cannot be written, which is
    then unchanged.
    """
    mesh = mesh_of(obj)
    check_writable(mesh, obj.name)
    end_preview(mesh)
    first = first_shapes(mesh)
    if first is None:
        how = "can no longer be determined" if has_first(mesh) else "is the only one"
        raise CubicCraftError(f'The first original of "{obj.name}" {how}: use Restore')
    _put_back(mesh, first, is_first=True)


def _put_back(mesh: bpy.types.Mesh, original: Shapes, *, is_first: bool = False) -> None:
    cubic_key = find_cubic_key(mesh)
    with all_or_nothing(mesh):
        write_shapes(mesh, original)
        drop_stored(mesh)
        if is_first:
            drop_first(mesh)
        forget_edges(mesh)
        remove_cubic_key(mesh, cubic_key)


def has_traces(mesh: bpy.types.Mesh | None) -> bool:
    """Return whether the mesh has any data of ours, valid or stale.

    It is cheap: it reads no positions. False if there is no mesh.
    """
    if not isinstance(mesh, bpy.types.Mesh):
        return False
    return bool(read_note(mesh)) or bool(our_attributes(mesh))


def discard_original(mesh: bpy.types.Mesh) -> None:
    """Keep the shape and remove all other data of ours, valid or stale.

    The shape key "Cubic" is kept; a leftover preview is not.

    Raises CubicCraftError: a mesh that cannot be written, which is then unchanged.
    """
    check_writable(mesh, mesh.name)
    end_preview(mesh)
    with all_or_nothing(mesh):
        drop_stored(mesh)
        drop_first(mesh)
        write_note(mesh, {})
        leave_edges(mesh)
