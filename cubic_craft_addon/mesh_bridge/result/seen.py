# SPDX-License-Identifier: GPL-3.0-or-later
"""The visible mesh of an object, with its modifiers, as a new object; the source is kept.

It is in no scene until it is written. Texts, curves, surfaces and metaballs also become meshes.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import bpy
import numpy as np

from ....solver.errors import CubicCraftError
from ..access.arrays import mark_moved, write_position
from ..access.attributes import our_attributes, remove_attribute
from ..access.checks import mesh_of
from ..access.copies import passing_copy, remove_copy
from ..access.note import NOTE, read_note
from .new_object import link_beside, select_instead
from .results import write_mesh

KINDS = ("MESH", "CURVE", "SURFACE", "FONT", "META")
"""types of objects with a visible mesh"""

_PLAIN_PARENTS = ("OBJECT", "BONE", "VERTEX", "VERTEX_3")


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
    try:
        write_mesh(mesh_of(new), positions, rotations, run)
        if source is None:
            bpy.context.scene.collection.objects.link(new)
            prepare(new)
            return new
        link_beside(source, new)
        prepare(new)
        select_instead(source, new)
    except BaseException:
        remove_copy(new)
        raise
    return new


def move_seen(new: bpy.types.Object, positions: np.ndarray) -> None:
    """Move the vertices of an object made by `make_seen` to positions (n,3), for good."""
    mesh = mesh_of(new)
    write_position(mesh, positions)
    mark_moved(mesh)


def show_seen(new: bpy.types.Object, source: bpy.types.Object) -> None:
    """Show an object made by `make_seen` beside the source."""
    link_beside(source, new)
    select_instead(source, new)


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
