# SPDX-License-Identifier: GPL-3.0-or-later
"""Write a result to a copy of the object; the source does not change, bit for bit."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import Any

import bpy
import numpy as np

from ....solver.errors import CubicCraftError
from ..access.any_mode import copied, flush, passing_copy, remove_copy
from ..access.arrays import mark_moved, write_position
from ..access.attributes import check_names, our_attributes, remove_attribute
from ..access.checks import check_local, mesh_of
from ..access.note import NOTE, check_note, read_note
from ..memory.original import Start
from .restore import discard_original
from .results import write_mesh
from .rollback import after_errors

KINDS = ("MESH", "CURVE", "SURFACE", "FONT", "META")
"""types of objects with a visible mesh"""
_PLAIN_PARENTS = ("OBJECT", "BONE", "VERTEX", "VERTEX_3")


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
    new = copied(obj)
    with after_errors(partial(remove_copy, new)):
        write_mesh(mesh_of(new), positions, rotations, run, start)
        mesh_of(new).name = f"{mesh.name} Cubic"
        new.name = f"{obj.name} Cubic"
        show_beside(new, obj, prepare)
    return new


def show_beside(
    new: bpy.types.Object,
    source: bpy.types.Object | None,
    prepare: Callable[[bpy.types.Object], None] = lambda new: None,
) -> None:
    """Show a new object instead of its source, or in the scene if that is gone.

    `prepare`: as of `write_new_object`.
    """
    if source is None:
        bpy.context.scene.collection.objects.link(new)
    else:
        link_beside(source, new)
    prepare(new)
    if source is not None:
        select_instead(source, new)


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


def plain_copy(obj: bpy.types.Object, positions: np.ndarray) -> bpy.types.Object:
    """Copy an object and its mesh, and give the copy other positions.

    It keeps UVs, materials, vertex groups and modifiers, and is in no scene yet.

    `obj`: an object with a mesh, not in Edit Mode. `positions`: (n,3) float32, object space. Raises
    CubicCraftError: a mesh that cannot be written; no copy is left then.
    """
    new = copied(obj)
    with after_errors(partial(remove_copy, new)):
        _strip(new, mesh_of(new))
        move_vertices(new, positions)
    return new


def _strip(new: bpy.types.Object, mesh: bpy.types.Mesh) -> None:
    """Remove the shape keys and all data of ours, which do not fit fewer vertices."""
    if mesh.shape_keys is not None:
        name = mesh.shape_keys.name
        new.shape_key_clear()
        left = bpy.data.shape_keys.get((name, None))
        if left is not None:  # Blender counts a user too many for copied shape keys
            bpy.data.batch_remove((left,))
    new.active_shape_key_index = 0
    new.show_only_shape_key = False
    discard_original(mesh)


def make_seen(obj: bpy.types.Object) -> bpy.types.Object:
    """Return a new object with the visible mesh of another, in no scene yet.

    It has the materials, UVs, vertex groups and attributes of the evaluated mesh and the transform
    of the source, but no modifiers and shape keys, which are already applied.

    Raises CubicCraftError: the object has no visible faces; no new object is left then.
    """
    depsgraph = bpy.context.evaluated_depsgraph_get()
    try:
        mesh = bpy.data.meshes.new_from_object(
            obj.evaluated_get(depsgraph), preserve_all_data_layers=True, depsgraph=depsgraph
        )
    except RuntimeError as error:
        raise CubicCraftError(f'"{obj.name}" cannot be evaluated as a mesh') from error
    if not mesh.polygons:
        bpy.data.meshes.remove(mesh)
        raise CubicCraftError(
            f'"{obj.name}" shows no faces of its own: give a curve a bevel, and realize instances'
        )
    _forget_ours(mesh)
    mesh.name = f"{obj.data.name} Cubic" if obj.data else f"{obj.name} Cubic"
    new = _copy(obj, mesh) if obj.type == "MESH" else _stand_in(obj, mesh)
    new.name = f"{obj.name} Cubic"
    return new


@contextmanager
def as_seen(obj: bpy.types.Object) -> Iterator[bpy.types.Object]:
    """Provide an object made by `make_seen` to read from.

    Raises CubicCraftError: as `make_seen`; what is raised while it is read names the object itself.
    """
    with passing_copy(make_seen(obj), obj) as new:
        yield new


def write_seen(
    new: bpy.types.Object,
    source: bpy.types.Object | None,
    positions: np.ndarray,
    rotations: np.ndarray,
    prepare: Callable[[bpy.types.Object], None],
    run: dict[str, Any] | None,
) -> bpy.types.Object:
    """Write a result to an object made by `make_seen`, and show it beside the source.

    `new`, `source`: the source is None if it was deleted in the meantime. `positions`, `rotations`,
    `prepare`, `run`: as for `write_new_object`. Raises CubicCraftError: as `write_mesh`. After any
    exception, there is no new object.
    """
    with after_errors(partial(remove_copy, new)):
        write_mesh(mesh_of(new), positions, rotations, run)
        show_beside(new, source, prepare)
    return new


def move_vertices(new: bpy.types.Object, positions: np.ndarray) -> None:
    """Move the vertices of an object without shape keys to positions (n,3), for good."""
    mesh = mesh_of(new)
    write_position(mesh, positions)
    mark_moved(mesh)


def _forget_ours(mesh: bpy.types.Mesh) -> None:
    """Remove evaluated data of an earlier result, which belongs to another mesh."""
    for name in our_attributes(mesh):
        remove_attribute(mesh, name)
    if read_note(mesh):
        del mesh[NOTE]


def _copy(obj: bpy.types.Object, mesh: bpy.types.Mesh) -> bpy.types.Object:
    new = obj.copy()
    assert new is not None
    new.data = mesh
    new.modifiers.clear()
    new.active_shape_key_index = 0
    new.show_only_shape_key = False
    if new.parent_type not in _PLAIN_PARENTS:  # also deforms, which is already in the mesh
        new.parent_type = "OBJECT"
    return new


def _stand_in(obj: bpy.types.Object, mesh: bpy.types.Mesh) -> bpy.types.Object:
    new = bpy.data.objects.new(obj.name, mesh)
    new.parent = obj.parent
    if obj.parent_type in _PLAIN_PARENTS:
        new.parent_type, new.parent_bone = obj.parent_type, obj.parent_bone
    new.matrix_parent_inverse = obj.matrix_parent_inverse
    new.matrix_world = obj.matrix_world
    return new
