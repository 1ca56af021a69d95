# SPDX-License-Identifier: GPL-3.0-or-later
"""Write a result to a copy of the object; the source does not change, bit for bit."""

from collections.abc import Callable
from typing import Any

import bpy
import numpy as np

from ..access.any_mode import flush
from ..access.attributes import check_names
from ..access.checks import check_local, mesh_of
from ..access.note import check_note
from ..memory.original import Start
from .results import write_mesh


def write_new_object(
    obj: bpy.types.Object,
    positions: np.ndarray,
    rotations: np.ndarray,
    prepare: Callable[[bpy.types.Object], None] = lambda new: None,
    run: dict[str, Any] | None = None,
    start: Start = "HERE",
) -> bpy.types.Object:
    """Copy an object with its mesh and write a result to the copy's mesh.

    The copy is named "<name> Cubic", lies in the collections of the source, and is selected and
    active in its place, unless the source is in Weight Paint or another mode, which can be left
    only while it is active. It holds the original of the source, so it can be restored.

    `obj`: an object with a mesh, in any mode. `positions`: (n,3), object space. `rotations`:
    (n,3,3). `prepare`: called with the new object once it has the result, before it takes the place
    of `obj`. `run`: the note of the run (see `note`). `start`: what the result was made from if the
    mesh was edited by hand since the last one. Returns the new object. Raises CubicCraftError: as
    `write_mesh`. After any exception, there is no new object.
    """
    mesh = mesh_of(obj)
    check_local(mesh, obj.name)
    check_note(mesh)
    check_names(mesh)
    flush(obj)
    new_mesh, new = mesh.copy(), obj.copy()
    assert new_mesh is not None and new is not None
    try:
        new.data = new_mesh  # first, so that its active shape key is adjusted when ours is removed
        write_mesh(new_mesh, positions, rotations, run, start)
        new_mesh.name = f"{mesh.name} Cubic"
        new.name = f"{obj.name} Cubic"
        link_beside(obj, new)
        prepare(new)
        select_instead(obj, new)
    except BaseException:
        bpy.data.objects.remove(new)
        bpy.data.meshes.remove(new_mesh)
        raise
    return new


def link_beside(obj: bpy.types.Object, new: bpy.types.Object) -> None:
    """Link the new object to those collections of the old one that can be changed."""
    collections = [c for c in obj.users_collection if c.is_editable and not c.override_library]
    for collection in collections or [bpy.context.scene.collection]:
        # Copying a rigid body has linked the copy to their collection already.
        if collection not in new.users_collection:
            collection.objects.link(new)


def select_instead(obj: bpy.types.Object, new: bpy.types.Object) -> None:
    """Select the new object and make it active instead of the old one, if it is in the view layer.

    Not if the active object is in a mode other than Object Mode: it would be stuck there.
    """
    active = bpy.context.view_layer.objects.active
    is_free = obj.mode == "OBJECT" and (active is None or active.mode == "OBJECT")
    try:
        new.select_set(is_free)  # a copy has the selection state of its source
        if is_free:
            obj.select_set(False)
    except RuntimeError:  # none of its collections is in this view layer
        return
    if is_free:
        bpy.context.view_layer.objects.active = new
