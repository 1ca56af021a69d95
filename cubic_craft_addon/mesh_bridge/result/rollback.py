# SPDX-License-Identifier: GPL-3.0-or-later
"""Write all or nothing: restore a mesh if writing to it fails half-way."""

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager, contextmanager

import bpy
import numpy as np

from ..access.arrays import corner_vertices
from ..access.attributes import add_attribute, our_attributes, read_attribute, remove_attribute
from ..access.note import read_note, write_note
from ..access.shapes import read_shapes, write_shapes
from ..access.sharp_edges import has_following_edges, let_edges_follow
from ..memory.cubic_key import remove_keys


@contextmanager
def after_errors(put_back: Callable[[], object]) -> Iterator[None]:
    """Call a function if the block raises."""
    try:
        yield
    except BaseException:
        put_back()
        raise


def all_or_nothing(mesh: bpy.types.Mesh) -> AbstractContextManager[None]:
    """Undo what the block did to the mesh if it raises.

    It covers the positions, the points of shape keys, free normals, added shape keys, sharp edges
    that follow the shape, our attributes and the note. It cannot restore removed shape keys: remove
    those last.
    """
    return after_errors(_State(mesh).put_back)


@contextmanager
def mesh_untouched(mesh: bpy.types.Mesh) -> Iterator[None]:
    """Undo what the block did to the mesh in any case, as `all_or_nothing` does."""
    state = _State(mesh)
    try:
        yield
    finally:
        state.put_back()


def carry_result(mesh: bpy.types.Mesh, other: bpy.types.Mesh) -> bool:
    """Give another mesh of the same vertices the shapes of this one, and all that is ours on it.

    Returns whether it could be done: not if it has other vertices or faces, or lacks a shape key.
    """
    state = _State(mesh)
    there = other.shape_keys.key_blocks.keys() if other.shape_keys is not None else ()
    is_like = np.array_equal(corner_vertices(mesh), corner_vertices(other))
    counts = [(len(each.vertices), len(each.polygons)) for each in (mesh, other)]
    if not is_like or counts[0] != counts[1]:
        return False
    if not state.shapes.keys.keys() <= set(there):
        return False
    state.mesh = other
    state.put_back()
    return True


class _State:
    def __init__(self, mesh: bpy.types.Mesh) -> None:
        self.mesh = mesh
        self.shapes = read_shapes(mesh)
        self.note = read_note(mesh)
        self.has_edges = has_following_edges(mesh)
        self.ours = {}
        for name in our_attributes(mesh):
            domain = mesh.attributes[name].domain
            for size in (3, 4):
                values = read_attribute(mesh, name, size, domain)
                if values is not None:
                    self.ours[name] = values, domain

    def put_back(self) -> None:
        """Undo all changes since the state was taken."""
        mesh = self.mesh
        if mesh.shape_keys is not None:
            added = [k for k in mesh.shape_keys.key_blocks if k.name not in self.shapes.keys]
            remove_keys(mesh, added[::-1])
        for name in our_attributes(mesh):
            remove_attribute(mesh, name)
        for name, (values, domain) in self.ours.items():
            add_attribute(mesh, name, values, domain)
        write_note(mesh, self.note)
        let_edges_follow(mesh, self.has_edges)
        write_shapes(mesh, self.shapes)
