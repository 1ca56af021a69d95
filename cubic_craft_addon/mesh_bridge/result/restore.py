# SPDX-License-Identifier: GPL-3.0-or-later
"""Take our results back, or let them stand and forget where they came from."""

import bpy

from ....solver.errors import CubicCraftError
from ..access.attributes import our_attributes
from ..access.checks import check_writable, mesh_of
from ..access.note import read_note, write_note
from ..access.shapes import write_shapes
from ..memory.cubic_key import find_cubic_key, remove_cubic_key
from ..memory.original import drop_stored, has_original, has_stored, original_shapes
from ..preview.end import end_preview
from .rollback import all_or_nothing


def restore(obj: bpy.types.Object) -> None:
    """Give a mesh its original bits back and remove everything of ours from it.

    Where the mesh has been transformed since, as a whole or in parts, so is the original. Where it
    has been edited by hand, that is lost.

    Raises
    ------
    CubicCraftError
        Nothing to restore, or a mesh that cannot be written; it is then as it was before.
    """
    mesh = mesh_of(obj)
    check_writable(mesh, obj.name)
    end_preview(mesh)
    if not has_original(mesh):
        if has_traces(mesh):
            how = " so that its original can no longer be determined" if has_stored(mesh) else ""
            raise CubicCraftError(
                f'"{obj.name}" has been edited since it was cubified{how}, and its current shape '
                "is now the original: Apply removes the remains of the previous one"
            )
        raise CubicCraftError(f'"{obj.name}" has no original to restore: cubify it first')
    cubic_key = find_cubic_key(mesh)
    original = original_shapes(mesh, "ORIGINAL")
    with all_or_nothing(mesh):
        write_shapes(mesh, original)
        drop_stored(mesh)
        remove_cubic_key(mesh, cubic_key)


def has_traces(mesh: bpy.types.Mesh | None) -> bool:
    """Return whether we have left anything on the mesh, valid or stale.

    Cheap: it reads no positions. False where there is no mesh.
    """
    if not isinstance(mesh, bpy.types.Mesh):
        return False
    return bool(read_note(mesh)) or bool(our_attributes(mesh))


def discard_original(mesh: bpy.types.Mesh) -> None:
    """Keep the shape and remove everything else of ours, valid or stale.

    The shape key "Cubic" stays. Of a preview that has been left on, nothing is kept.

    Raises
    ------
    CubicCraftError
        A mesh that cannot be written; it is then as it was before.
    """
    check_writable(mesh, mesh.name)
    end_preview(mesh)
    with all_or_nothing(mesh):
        drop_stored(mesh)
        write_note(mesh, {})
