# SPDX-License-Identifier: GPL-3.0-or-later
"""Take results of ours back, or let them stand and forget where they came from."""

import bpy

from ...solver.errors import CubicCraftError
from .arrays import mark_moved
from .checks import check_writable, mesh_of
from .cubic_key import remove_cubic_key
from .note import read_note, write_note
from .original import drop_stored, has_original, original_shapes, stored_result
from .rollback import all_or_nothing
from .shapes import write_shapes


def restore(obj: bpy.types.Object) -> None:
    """Give a mesh its original bits back and remove everything of ours from it.

    Raises
    ------
    CubicCraftError
        Nothing to restore, or a mesh that cannot be written; it is then as it was before.
    """
    mesh = mesh_of(obj)
    check_writable(mesh, obj.name)
    if not has_original(mesh):
        if "mesh" in read_note(mesh):
            raise CubicCraftError(
                f"'{obj.name}' was edited after it was cubified, so its original is gone: "
                "undo the edit, or cubify it anew from its present shape"
            )
        raise CubicCraftError(f"'{obj.name}' has no original to restore: cubify it first")
    original = original_shapes(mesh)
    with all_or_nothing(mesh):
        if stored_result(mesh) is not None:
            write_shapes(mesh, original)
        drop_stored(mesh)
        remove_cubic_key(mesh)
        mark_moved(mesh)


def forget(mesh: bpy.types.Mesh) -> None:
    """Keep the shape and remove everything else of ours; the shape key "Cubic" stays.

    Raises
    ------
    CubicCraftError
        A mesh that cannot be written.
    """
    check_writable(mesh, mesh.name)
    drop_stored(mesh)
    write_note(mesh, {})
