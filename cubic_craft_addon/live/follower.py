# SPDX-License-Identifier: GPL-3.0-or-later
"""The object beside the original on which Live shows what a new object would look like.

The original is never written, so the artist can go on working on it. The follower has a preview of
its own, like any mesh that Live shows a shape on. In the end it becomes the result: it keeps what
the artist has given it, and gets the mesh of the new object that Cubify makes.
"""

from collections.abc import Collection
from contextlib import ExitStack, contextmanager, suppress

import bpy
from mathutils import Vector

from .. import mesh_bridge
from ..settings.rollback import copy_settings
from .beside import put_beside

_MARK = "cubic_craft_follower"


class Follower:
    """A follower of one original; it keeps no reference to Blender's data, which undo frees.

    `is_as_seen`: whether it has the visible mesh, with modifiers.

    Attributes
    ----------
    uid, mesh_uid : int
        ``session_uid`` of it and of its mesh, 0 for none.
    """

    def __init__(self, *, is_as_seen: bool):
        self._is_as_seen = is_as_seen
        self.uid = self.mesh_uid = 0
        self._name = self._dress = ""

    def find(self) -> bpy.types.Object | None:
        """Return the object, None if it is gone."""
        found = bpy.data.objects.get(self._name)
        if found is None or found.session_uid != self.uid:  # the artist may have renamed it
            found = next((obj for obj in bpy.data.objects if obj.session_uid == self.uid), None)
            self._name = "" if found is None else found.name
        return found if found is not None and found.users_scene else None

    def make(self, source: bpy.types.Object, shift: Vector) -> None:
        """Make the object beside the original."""
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
        self.uid, self.mesh_uid = new.session_uid, mesh.session_uid
        self._name, self._dress = new.name, mesh_bridge.dress_of(new)
        put_beside(new, source, shift)
        with suppress(RuntimeError):  # none of its collections is in this view layer
            new.select_set(False)  # a copy has the selection state of its source

    def renew(self, source: bpy.types.Object) -> None:
        """Give it a new copy of the original's mesh, as it was last read."""
        obj = self.find()
        if obj is None:
            return
        before = mesh_bridge.mesh_of(obj)
        given = list(before.materials) if self._is_dressed(obj) else []
        if self._is_as_seen:
            new = mesh_bridge.make_seen(source)
            mesh = mesh_bridge.mesh_of(new)
            bpy.data.objects.remove(new)
        else:
            mesh = mesh_bridge.mesh_of(source).copy()
            assert mesh is not None
        obj.data = mesh
        self._dress = mesh_bridge.dress_of(obj)
        for slot, material in enumerate(given):
            if slot < len(mesh.materials):
                mesh.materials[slot] = material
            else:
                mesh.materials.append(material)
        name = before.name
        bpy.data.meshes.remove(before)
        mesh.name = name
        self.mesh_uid = mesh.session_uid

    def remove(self) -> None:
        """Remove the object, unless it is a result by now."""
        obj = self.find()
        if obj is not None:
            _remove(obj)
        self.uid = self.mesh_uid = 0

    def become(self, written: bpy.types.Object, undo: ExitStack | None) -> bpy.types.Object:
        """Become the result in place of a new object, which then is in no collection.

        `written`: as Cubify has made it. `undo`: what will take this back; None to remove the new
        object, as this is for good. Returns the object that is the result.
        """
        obj = self.find()
        if obj is None:
            return written
        with _in_object_mode(obj):
            own, mesh = mesh_bridge.mesh_of(obj), mesh_bridge.mesh_of(written)
            if self._is_dressed(obj):
                dressed = own.copy()
                assert dressed is not None
                if mesh_bridge.carry_result(mesh, dressed):
                    mesh = dressed
                else:
                    bpy.data.meshes.remove(dressed)
            copy_settings(written, obj)
            obj.data = mesh
        for collection in written.users_collection:
            collection.objects.unlink(written)
        mark = obj[_MARK]
        del obj[_MARK]

        def take_back():
            with _in_object_mode(obj):
                obj.data = own
            obj[_MARK] = mark
            if mesh != written.data:
                bpy.data.meshes.remove(mesh)

        if undo is not None:
            undo.callback(take_back)
            return obj
        self.uid = self.mesh_uid = 0
        _remove(written)
        name = own.name
        bpy.data.meshes.remove(own)
        mesh.name = name
        return obj

    def _is_dressed(self, obj):
        """Return whether the artist has given its mesh materials, weights or the like."""
        return mesh_bridge.dress_of(obj) != self._dress


def remove_left(known: Collection[int] = ()) -> None:
    """Remove followers that nobody knows, as an undo or a redo brings them back.

    Copies that the artist has made of one stay, and so does what a file has. `known` are the
    ``session_uid`` of those that stay followers.
    """
    for obj in [obj for obj in bpy.data.objects if _MARK in obj]:
        if obj[_MARK] != str(obj.session_uid):
            release(obj)
        elif obj.session_uid not in known:
            _remove(obj)


def release(obj: bpy.types.Object) -> None:
    """Make a follower an object like any other."""
    if _MARK in obj:
        del obj[_MARK]


@contextmanager
def _in_object_mode(obj):
    """Leave the mode that the artist works on it in: its mesh can be replaced in no other."""
    mode = obj.mode if obj == bpy.context.view_layer.objects.active else "OBJECT"
    if mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    try:
        yield
    finally:
        if mode != "OBJECT":
            bpy.ops.object.mode_set(mode=mode)


def _remove(obj):
    mesh = obj.data
    bpy.data.objects.remove(obj)
    if isinstance(mesh, bpy.types.Mesh) and not mesh.users:
        bpy.data.meshes.remove(mesh)
