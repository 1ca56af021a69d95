# SPDX-License-Identifier: GPL-3.0-or-later
"""The object beside the original on which Live shows what a new object would look like.

The original is never written, so the artist can go on working on it. The follower has a preview of
its own, like any mesh that Live shows a shape on. What is left of it in the end is its place: the
result itself is a new object, as Cubify makes it.
"""

from contextlib import suppress
from dataclasses import dataclass

import bpy
from mathutils import Matrix, Vector

from .. import mesh_bridge
from ..environment.curves import animated_paths

_GAP, _NEAR = 1.2, 0.1  # of the width of the original
_MARK = "cubic_craft_follower"


@dataclass(frozen=True)
class _Place:
    basis: Matrix
    delta: Vector
    is_free: bool
    """without constraints, which would put it elsewhere"""
    is_selected: bool
    is_active: bool


class Follower:
    """A follower of one original; it keeps no reference to Blender's data, which undo frees.

    Parameters
    ----------
    is_as_seen : bool
        Whether it has the visible mesh, with modifiers.

    Attributes
    ----------
    mesh_uid : int
        ``session_uid`` of its mesh, 0 for none.
    """

    def __init__(self, *, is_as_seen: bool):
        self._is_as_seen = is_as_seen
        self._uid = self.mesh_uid = 0
        self._name = ""
        self._place: _Place | None = None

    def find(self) -> bpy.types.Object | None:
        """Return the object, None if it is gone."""
        found = bpy.data.objects.get(self._name)
        if found is None or found.session_uid != self._uid:  # the artist may have renamed it
            found = next((obj for obj in bpy.data.objects if obj.session_uid == self._uid), None)
            self._name = "" if found is None else found.name
        return found if found is not None and found.users_scene else None

    def make(self, source: bpy.types.Object) -> bpy.types.Object:
        """Make the object, where the artist has left it, or else beside the original."""
        if self._is_as_seen:
            new = mesh_bridge.make_seen(source)
            mesh = mesh_bridge.mesh_of(new)
        else:
            mesh_bridge.flush(source)
            own = mesh_bridge.mesh_of(source)
            mesh, new = own.copy(), source.copy()
            assert mesh is not None and new is not None
            new.data = mesh
            mesh.name, new.name = f"{own.name} Cubic", f"{source.name} Cubic"
        new[_MARK] = str(new.session_uid)
        mesh_bridge.link_beside(source, new)
        self._uid, self.mesh_uid = new.session_uid, mesh.session_uid
        self._name = new.name
        place = self._place
        if place is None:
            _put_beside(new, source)
        else:
            _put(new, place)
        with suppress(RuntimeError):  # none of its collections is in this view layer
            # a copy has the selection state of its source
            new.select_set(place is not None and place.is_selected)
            if place is not None and place.is_active:
                bpy.context.view_layer.objects.active = new
        return new

    def renew(self, source: bpy.types.Object) -> None:
        """Give it a new copy of the original's mesh, as it was last read."""
        obj = self.find()
        if obj is None:
            return
        before = mesh_bridge.mesh_of(obj)
        if self._is_as_seen:
            new = mesh_bridge.make_seen(source)
            mesh = mesh_bridge.mesh_of(new)
            obj.data = mesh
            bpy.data.objects.remove(new)
        else:
            mesh = mesh_bridge.mesh_of(source).copy()
            assert mesh is not None
            obj.data = mesh
        name = before.name
        bpy.data.meshes.remove(before)
        mesh.name = name
        self.mesh_uid = mesh.session_uid

    def remove(self) -> None:
        """Remove the object, and remember its place."""
        obj = self.find()
        if obj is not None:
            is_active = bpy.context.view_layer.objects.active == obj
            place = obj.matrix_basis.copy(), obj.delta_location.copy(), not obj.constraints
            self._place = _Place(*place, obj.select_get(), is_active)
            _remove(obj)
        self._uid = self.mesh_uid = 0

    def give_place(self, obj: bpy.types.Object) -> None:
        """Put a result where the follower was."""
        if self._place is not None:
            _put(obj, self._place)
        release(obj)


def remove_left() -> None:
    """Remove followers that nobody knows, as an undo or a redo brings them back.

    Copies that the artist has made of one stay, and so does what a file has.
    """
    for obj in [obj for obj in bpy.data.objects if _MARK in obj]:
        if obj[_MARK] == str(obj.session_uid):
            _remove(obj)
        else:
            release(obj)


def release(obj: bpy.types.Object) -> None:
    """Make a follower an object like any other."""
    if _MARK in obj:
        del obj[_MARK]


def _put(obj, place):
    if place.is_free:
        obj.constraints.clear()
    obj.delta_location, obj.matrix_basis = place.delta, place.basis


def _put_beside(obj, source):
    """Put an object beside the one that it is a copy of, whatever moves that one."""
    corners = [source.matrix_world @ Vector(corner) for corner in source.bound_box]
    places = [corner.x for corner in corners]
    width = max(places) - min(places)
    shift, world = Vector((_GAP * width, 0.0, 0.0)), source.matrix_world.copy()
    world.translation += shift
    if "location" in animated_paths(source):  # the delta is added to what the animation says
        space = source.matrix_world @ source.matrix_basis.inverted_safe()
        obj.delta_location += space.to_3x3().inverted_safe() @ shift
    else:
        obj.matrix_world = world
    bpy.context.view_layer.update()
    if (obj.matrix_world.translation - world.translation).length > _NEAR * width:
        obj.constraints.clear()
        obj.matrix_world = world


def _remove(obj):
    mesh = obj.data
    bpy.data.objects.remove(obj)
    if isinstance(mesh, bpy.types.Mesh) and not mesh.users:
        bpy.data.meshes.remove(mesh)
