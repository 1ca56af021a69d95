# SPDX-License-Identifier: GPL-3.0-or-later
"""End a preview with the data on the mesh alone, wherever the mesh comes from."""

from collections.abc import Collection
from typing import Any

import bpy

from ....solver.errors import CubicCraftError
from ..access.attributes import LIVE, our_attributes, read_attribute
from ..access.checks import is_linked
from ..access.fingerprint import fingerprint_of_values
from ..access.note import read_note
from ..access.shapes import Shapes, read_shapes, write_shapes
from ..access.sharp_edges import has_following_edges, leave_edges, let_edges_follow
from .edit_mode import EditedMesh
from .moved import take_along
from .store import drop_live_part, marked, remove_live_attributes, shapes_before, write_live_part

_ended_in_edit_mode: dict[str, dict[str, Any]] = {}
"""the "live" part of the note by the fingerprint of the shape shown

Ended in Edit Mode, a preview is no longer in the note, but still in the mesh outside, and in the
undo steps of Edit Mode: entering it pushes one with the preview still on. An undo to such a step,
or out of Edit Mode, may bring all of the preview back but its part of the note. Like the undo
steps, this lasts until Blender ends.
"""


def has_preview(mesh: bpy.types.Mesh | None) -> bool:
    """Return whether a preview is on the mesh. It is cheap: it reads no positions."""
    return isinstance(mesh, bpy.types.Mesh) and "live" in read_note(mesh)


def end_preview(mesh: bpy.types.Mesh) -> bool:
    """Restore all shapes from before the preview, bit for bit; also works in Edit Mode.

    If the artist has edited the base since, that shape is kept. Edit Mode itself turns -0 into 0 in
    shape keys, and moves the `position` attribute onto the reference key.

    Returns whether there was a preview to end. Linked meshes are not changed.
    """
    if is_linked(mesh) or not (has_preview(mesh) or _may_be_undone(mesh)):
        return False
    edited = EditedMesh(mesh) if mesh.is_editmode else None
    try:
        present = edited.read_shapes() if edited else read_shapes(mesh)
    except CubicCraftError:  # a script has left shape keys that do not fit: not our preview
        present = None
    part = read_note(mesh).get("live") or _part_of_undone(present)
    if not part:
        return False
    if edited and part["fingerprint"]:
        _ended_in_edit_mode[part["fingerprint"]] = part
    read = edited.read_attribute if edited else lambda name: read_attribute(mesh, name, 3)
    before = shapes_before(present, part, read) if present is not None else None
    if before is None and present is not None and not edited:
        moved = take_along(mesh, part, present)
        if moved is not None:
            part, before = moved, shapes_before(present, moved, read)
    had_edges = part.get("has_edges", False)
    if not edited:
        let_edges_follow(mesh, had_edges)
    elif has_following_edges(mesh) and not had_edges:
        leave_edges(mesh)
        edited.smooth_edges()
    if before is not None:
        write_live_part(mesh, marked(part, None))
        if edited:
            edited.write_shapes(before)
        else:
            write_shapes(mesh, before)
    # First the note: without it, the rest of a preview does no harm.
    drop_live_part(mesh)
    remove_live_attributes(mesh)
    return True


def end_all_previews(except_meshes: Collection[bpy.types.Mesh] = ()) -> list[str]:
    """End the preview on every mesh of the file except some.

    Returns the names of the meshes that had one.
    """
    meshes = [mesh for mesh in bpy.data.meshes if mesh not in except_meshes]
    return [mesh.name for mesh in meshes if end_preview(mesh)]


def _may_be_undone(mesh: bpy.types.Mesh) -> bool:
    """Return whether an undo may have brought back a preview without its note."""
    return bool(_ended_in_edit_mode) and bool(our_attributes(mesh, (LIVE,)))


def _part_of_undone(present: Shapes | None) -> dict[str, Any] | None:
    """Find the part of the note by the current shape; None if we have not shown it."""
    if present is None:
        return None
    return _ended_in_edit_mode.get(fingerprint_of_values(present.base))
