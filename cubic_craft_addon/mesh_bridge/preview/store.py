# SPDX-License-Identifier: GPL-3.0-or-later
"""The shapes that a preview overwrites: stored on the mesh itself, and recovered from there.

They are in point attributes and in the "live" part of the note, like the original of a result. An
undo step, an autosave or a copy of the mesh made during a preview therefore includes everything
needed to end the preview, and no Python object has to outlive it.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import bpy
import numpy as np

from ....solver.errors import CubicCraftError
from ..access.attributes import (
    LIVE,
    add_attribute,
    our_attributes,
    read_attribute,
    remove_attribute,
)
from ..access.checks import is_linked
from ..access.note import fingerprint_of_values, read_note, write_note
from ..access.shapes import Shapes, carry, read_shapes, write_shapes
from ..access.sharp_edges import has_following_edges, leave_edges, let_edges_follow
from ..memory.affine import fit
from .edit_mode import EditedMesh

POSITION = f"{LIVE}.position"  # only where it is not equal to the base
_MOST = 64  # shapes kept; Blender keeps 32 undo steps by default


def store_live(mesh: bpy.types.Mesh, present: Shapes) -> None:
    """Store all shapes of a mesh that has no preview on it; nothing is stored if that fails."""
    remove_live_attributes(mesh)  # leftovers from joining meshes
    try:
        add_attribute(mesh, LIVE, present.base)
        if present.position.tobytes() != present.base.tobytes():
            add_attribute(mesh, POSITION, present.position)
        entries = []
        for number, name in enumerate(present.relative, start=1):
            # By number: the name of a key may be longer than that of an attribute.
            attribute = f"{LIVE}.key{number}"
            add_attribute(mesh, attribute, present.keys[name])
            entries.append({"name": name, "fingerprint": "", "attribute": attribute})
        part = {"fingerprint": "", "keys": entries, "has_edges": has_following_edges(mesh)}
        write_live_part(mesh, marked(part, present))
    except BaseException:
        remove_live_attributes(mesh)
        raise


def move_live(mesh: bpy.types.Mesh, moved: Callable[[np.ndarray], np.ndarray]) -> None:
    """Apply a function from points (n,3) to points to all stored data."""
    for name in our_attributes(mesh, (LIVE,)):
        values = read_attribute(mesh, name, 3)
        if values is not None:
            remove_attribute(mesh, name)
            add_attribute(mesh, name, moved(values))


def marked(part: dict[str, Any], shown: Shapes | None) -> dict[str, Any]:
    """Describe in the "live" part of the note what is on the mesh.

    `part`: the current part, which tells where everything is stored. `shown`: the shapes on the
    mesh; None while they are being written, when any shape counts as shown. Returns a new "live"
    part.
    """
    if shown is None:
        keys = [entry | {"fingerprint": ""} for entry in part["keys"]]
        return part | {"fingerprint": "", "keys": keys}
    base = fingerprint_of_values(shown.base)

    def seen(points: np.ndarray) -> str:  # shape keys that show the base share its array
        return base if points is shown.base else fingerprint_of_values(points)

    keys = [
        entry | {"fingerprint": seen(shown.keys[entry["name"]])}
        for entry in part["keys"]
        if entry["name"] in shown.keys
    ]
    return part | {"fingerprint": base, "keys": keys}


def write_live_part(mesh: bpy.types.Mesh, part: dict[str, Any]) -> None:
    """Replace the "live" part of the note."""
    write_note(mesh, read_note(mesh) | {"live": part})


def remove_live_attributes(mesh: bpy.types.Mesh) -> None:
    """Remove the attributes of a preview; also works in Edit Mode."""
    for name in our_attributes(mesh, (LIVE,)):
        remove_attribute(mesh, name)


def shapes_before(
    present: Shapes, part: dict[str, Any], read: Callable[[str], np.ndarray | None]
) -> Shapes | None:
    """Recover the shapes from before the preview.

    A shape key that the artist has edited or added since is carried onto the earlier base.

    `present`: the current shapes. `part`: the "live" part of the note. `read`: reads the (n,3)
    values of one of our attributes, None if there is none. Returns Shapes, or None if the base is
    the artist's own, not the shape shown.
    """
    if part["fingerprint"] not in ("", fingerprint_of_values(present.base)):
        return None
    known = _known_keys(present, part, read)
    base, position = read(LIVE), read(POSITION)
    if base is None:  # the artist deleted it
        before = replace(present, keys=present.keys | known)
    else:
        unturned = np.broadcast_to(np.eye(3), (len(base), 3, 3))
        before = carry(present, base, unturned, known)
    has_own_position = position is not None and present.reference is not None
    return replace(before, position=position) if has_own_position else before


def _known_keys(
    present: Shapes, part: dict[str, Any], read: Callable[[str], np.ndarray | None]
) -> dict[str, np.ndarray]:
    """Find the earlier points of unchanged shape keys, including renamed ones."""
    by_name = {entry["name"]: entry for entry in part["keys"]}
    # Only for names that are gone: a new key may have the same shape as one of ours.
    gone = {e["fingerprint"]: e for e in part["keys"] if e["name"] not in present.keys}
    known = {}
    for name in present.relative:
        seen = fingerprint_of_values(present.keys[name])
        entry = by_name.get(name, gone.get(seen))
        if entry is None or entry["fingerprint"] not in ("", seen):
            continue
        points = read(entry["attribute"])
        if points is not None:
            known[name] = points
    return known


_shown: dict[str, np.ndarray] = {}
"""the shape shown when a mesh was transformed, by fingerprint, the latest last"""


def take_along(
    mesh: bpy.types.Mesh, part: dict[str, Any], present: Shapes, shown: np.ndarray | None = None
) -> dict[str, Any] | None:
    """Transform the data stored under a preview as the artist has transformed the visible mesh.

    Blender stores the undo step of an operator before it notifies handlers: with the transformed
    shape, and the earlier note and attributes. Going back to it requires finding the transform
    again, for which the note has only the fingerprint of the shape shown; so that is kept here.

    `mesh`: with a preview on it, in Object Mode. `part`: the "live" part of its note. `present`:
    the current shapes. `shown`: (n,3), the shape shown last, if known. Returns the "live" part that
    is on the mesh now; None if not all vertices were moved alike, and nothing has changed.
    """
    known = _shown.get(part["fingerprint"], shown)
    if known is None or len(known) != len(present.base):
        return None
    way = fit(known, present.base)
    if way is None:
        return None
    _remember(known)
    move_live(mesh, way.moved)
    moved = marked(part, present)
    write_live_part(mesh, moved)
    return moved


def _remember(shown: np.ndarray) -> None:
    fingerprint = fingerprint_of_values(shown)
    _shown[fingerprint] = _shown.pop(fingerprint, shown)
    while len(_shown) > _MOST:
        del _shown[next(iter(_shown))]


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
    may_be_undone = _ended_in_edit_mode and our_attributes(mesh, (LIVE,))
    if is_linked(mesh) or not (has_preview(mesh) or may_be_undone):
        return False
    edited = EditedMesh(mesh) if mesh.is_editmode else None
    try:
        present = edited.read_shapes() if edited else read_shapes(mesh)
    except CubicCraftError:  # a script has left shape keys that do not fit: not our preview
        present = None
    part = read_note(mesh).get("live")
    if part is None and present is not None:  # without its note where an undo has brought it back
        part = _ended_in_edit_mode.get(fingerprint_of_values(present.base))
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
    note = read_note(mesh)
    note.pop("live", None)
    write_note(mesh, note)
    remove_live_attributes(mesh)
    return True


def end_all_previews() -> list[str]:
    """End the preview on every mesh of the file; return the names of those that had one."""
    return [mesh.name for mesh in list(bpy.data.meshes) if end_preview(mesh)]
