# SPDX-License-Identifier: GPL-3.0-or-later
"""Take a preview back from what lies on the mesh alone, wherever that mesh has come from."""

from collections.abc import Collection

import bpy

from ...solver.errors import CubicCraftError
from .attributes import read_attribute
from .checks import is_linked
from .note import read_note
from .preview_edit_mode import EditedMesh
from .preview_store import (
    drop_live_part,
    marked,
    remove_live_attributes,
    shapes_before,
    write_live_part,
)
from .shapes import read_shapes, write_shapes


def has_preview(mesh: bpy.types.Mesh | None) -> bool:
    """Tell whether a preview is on the mesh. Cheap: it reads no positions."""
    return isinstance(mesh, bpy.types.Mesh) and "live" in read_note(mesh)


def end_preview(mesh: bpy.types.Mesh) -> bool:
    """Put all shapes back as they were before the preview, to the bit; works in Edit Mode too.

    An artist who has edited the base since keeps that shape. Edit Mode itself makes 0 of -0 in
    shape keys, and moves the `position` attribute onto the reference key.

    Returns
    -------
    Whether there was a preview to end. Linked meshes stay as they are.
    """
    if not has_preview(mesh) or is_linked(mesh):
        return False
    part = read_note(mesh)["live"]
    edited = EditedMesh(mesh) if mesh.is_editmode else None
    try:
        present = edited.read_shapes() if edited else read_shapes(mesh)
    except CubicCraftError:  # a script has left shape keys that do not fit: not what we showed
        before = None
    else:
        read = edited.read_attribute if edited else lambda name: read_attribute(mesh, name, 3)
        before = shapes_before(present, part, read)
    if before is not None:
        write_live_part(mesh, marked(part, None))
        if edited:
            edited.write_shapes(before)
        else:
            write_shapes(mesh, before)
    # First the note: what is left of a preview without it does no harm.
    drop_live_part(mesh)
    remove_live_attributes(mesh)
    return True


def end_all_previews(except_meshes: Collection[bpy.types.Mesh] = ()) -> list[str]:
    """End the preview on every mesh of the file but some.

    Returns
    -------
    Names of the meshes that had one.
    """
    meshes = [mesh for mesh in bpy.data.meshes if mesh not in except_meshes]
    return [mesh.name for mesh in meshes if end_preview(mesh)]
