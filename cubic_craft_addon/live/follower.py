# SPDX-License-Identifier: GPL-3.0-or-later
"""The object beside the original on which Live shows what a new object would look like.

The original is never written, so the artist can go on working on it. The follower has a preview of
its own, like any mesh that Live shows a shape on. In the end it becomes the result: it keeps what
the artist has given it, and gets the mesh of the new object that Cubify makes.
"""

from collections.abc import Collection, Iterable
from contextlib import ExitStack, contextmanager, suppress
from typing import Any

import bpy
import numpy as np
from mathutils import Vector

from .. import mesh_bridge
from ..environment.curves import animated_paths
from ..settings.rollback import copy_settings

_GAP, _NEAR = 1.2, 0.1  # of the width of the originals
_LEAST_LEVEL = 0.5  # of the view's right, which has no height unless the view is rolled
_STEP, _FARTHEST = 1.1, 4.0  # by which a view in perspective asks for a larger gap
_DEFORMING_PARENTS = ("ARMATURE", "LATTICE", "CURVE")
MODIFIER = "Beside"
"""name of the modifiers that show a follower beside its own place"""
_MARK = "cubic_craft_follower"


def shift_beside(objects: Iterable[bpy.types.Object]) -> Vector:
    """Return the way in world space from objects to where copies of all of them are seen beside.

    To the right in the view that the artist looks at, and along X where there is no window.
    """
    corners = np.array([obj.matrix_world @ Vector(c) for obj in objects for c in obj.bound_box])
    view = _view()
    right = np.array((1.0, 0.0, 0.0) if view is None else view.view_matrix[0][:3])
    way = right * (1.0, 1.0, 0.0)
    if np.linalg.norm(way) < _LEAST_LEVEL:
        way = right
    way = way / np.linalg.norm(way)
    shift = way * (_GAP * np.ptp(corners @ right) / (way @ right))
    if view is not None:
        farthest = _FARTHEST * np.linalg.norm(shift)
        while np.linalg.norm(shift) < farthest and _is_hidden(view, corners, corners + shift):
            shift = _STEP * shift
    return Vector(shift.tolist())


def put_beside(obj: bpy.types.Object, source: bpy.types.Object, shift: Vector) -> None:
    """Put an object beside the one that it is a copy of, whatever moves and deforms that one."""
    if _is_deformed_by_others(obj):
        _show_beside(obj, source, shift)
        return
    world = source.matrix_world.copy()
    world.translation += shift
    if "location" in animated_paths(source):  # the delta is added to what the animation says
        space = source.matrix_world @ source.matrix_basis.inverted_safe()
        obj.delta_location += space.to_3x3().inverted_safe() @ shift
    else:
        obj.matrix_world = world
    bpy.context.view_layer.update()
    if (obj.matrix_world.translation - world.translation).length > _NEAR * shift.length:
        obj.constraints.clear()
        obj.matrix_world = world


def _show_beside(obj, source, shift):
    """Leave an object in the place of the source, and move what is seen of it.

    In another place, an armature, a hook or a mirror object would give it another shape.
    """
    linear = source.matrix_world.to_3x3()
    # Blender takes the global axes to the object by the transpose, not the inverse.
    strengths = (linear @ linear.transposed()).inverted_safe() @ shift
    for axis, strength in zip("XYZ", strengths, strict=True):
        if abs(strength) > 1e-6 * strengths.length:
            modifier: Any = obj.modifiers.new(MODIFIER, "DISPLACE")
            modifier.direction, modifier.space = axis, "GLOBAL"
            modifier.mid_level, modifier.strength = 0.0, strength


def _is_deformed_by_others(obj):
    is_by_parent = obj.parent is not None and obj.parent_type in _DEFORMING_PARENTS
    return is_by_parent or any(_refers_to_others(modifier) for modifier in obj.modifiers)


def _refers_to_others(modifier):
    values = [
        getattr(modifier, prop.identifier)
        for prop in modifier.bl_rna.properties
        if prop.type == "POINTER"
    ]
    if modifier.type == "NODES":
        values += _given_to_nodes(modifier)
        values += _named_in(modifier.node_group)
    return any(isinstance(value, bpy.types.Object | bpy.types.Collection) for value in values)


def _given_to_nodes(modifier):
    """Return what the sockets of a node group get: before Blender 5.3, custom properties."""
    if not hasattr(modifier, "properties"):
        return [modifier.get(key) for key in modifier.keys()]  # noqa: SIM118 - of a modifier
    sockets = modifier.properties.inputs
    names = sockets.bl_rna.properties.keys() if sockets is not None else ()
    return [getattr(getattr(sockets, name), "value", None) for name in names]


def _named_in(tree):
    """Yield what the sockets of a node group, and of the groups in it, name."""
    for node in tree.nodes if tree is not None else ():
        yield from (getattr(socket, "default_value", None) for socket in node.inputs)
        yield from _named_in(getattr(node, "node_tree", None))


def _view() -> Any:
    """Return the view that the artist looks at: that of the context, or the largest one."""
    context: Any = bpy.context
    if bpy.app.background or context.window is None:
        return None
    areas = [area for area in context.window.screen.areas if area.type == "VIEW_3D"]
    if context.area in areas:
        areas = [context.area]
    largest: Any = max(areas, key=lambda area: area.width * area.height, default=None)
    return largest and largest.spaces.active.region_3d


def _is_hidden(view, one, other):
    """Return whether points (n,3) and others to the right of them overlap from left to right."""
    places = [_seen_at(view, points) for points in (one, other)]
    return all(x is not None for x in places) and places[1].min() <= places[0].max()


def _seen_at(view, points):
    """Return the places of points (n,3) from left to right; None if one is behind the view."""
    seen = np.c_[points, np.ones(len(points))] @ np.array(view.perspective_matrix).T
    return seen[:, 0] / seen[:, 3] if (seen[:, 3] > 0).all() else None


class Follower:
    """A follower of one original; it keeps no reference to Blender's data, which undo frees.

    `is_as_seen`: whether it has the visible mesh, with modifiers. `uid`, `mesh_uid`:
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
        else:
            mesh_bridge.flush(source)
            new = mesh_bridge.copied(source)
            mesh_bridge.mesh_of(new).name = f"{mesh_bridge.mesh_of(source).name} Cubic"
            new.name = f"{source.name} Cubic"
        new[_MARK] = str(new.session_uid)
        mesh_bridge.link_beside(source, new)
        self.uid, self.mesh_uid = new.session_uid, mesh_bridge.mesh_of(new).session_uid
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
