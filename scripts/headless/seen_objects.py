# SPDX-License-Identifier: GPL-3.0-or-later
"""Put what is seen of the objects of the scene in their place, as meshes without modifiers."""

from collections.abc import Callable
from typing import Any

import bpy

from .extension import Extension

__all__ = ("seen_objects",)


def seen_objects(extension: Extension) -> Callable[[], list[bpy.types.Object]]:
    """Return a function that does it, and returns all mesh objects that there are then.

    Each new object has the name, the children and the place of the one that it stands for. What
    shows no faces stays as it is.
    """

    def replace_all() -> list[bpy.types.Object]:
        bridge = extension.mesh_bridge
        pairs = []
        for obj in _to_replace(bridge.KINDS):
            try:
                pairs.append((obj, bridge.make_seen(obj)))
            except extension.solver.CubicCraftError:
                continue
        for obj, new in pairs:  # all have been evaluated: a modifier may need what goes here
            _replace(obj, new)
        bpy.context.view_layer.update()
        return [obj for obj in bpy.context.scene.objects if obj.type == "MESH"]

    return replace_all


def _to_replace(kinds: tuple[str, ...]) -> list[bpy.types.Object]:
    return [
        obj
        for obj in bpy.context.scene.objects
        if obj.type in kinds and obj.visible_get() and (obj.type != "MESH" or obj.modifiers)
    ]


def _replace(obj: bpy.types.Object, new: Any) -> None:
    name = obj.name
    for collection in obj.users_collection:
        collection.objects.link(new)
    for child in obj.children:
        child.parent = new  # its inverse of the parent's place stays
    bpy.data.objects.remove(obj)
    new.name = name
