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

from ..access.attributes import (
    LIVE,
    add_attribute,
    our_attributes,
    read_attribute,
    remove_attribute,
)
from ..access.fingerprint import fingerprint_of_values
from ..access.note import read_note, write_note
from ..access.shapes import Shapes, carry
from ..access.sharp_edges import has_following_edges

POSITION = f"{LIVE}.position"  # only where it is not equal to the base


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


def drop_live_part(mesh: bpy.types.Mesh) -> None:
    """Remove the "live" part of the note; the others do not change."""
    note = read_note(mesh)
    note.pop("live", None)
    write_note(mesh, note)


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
