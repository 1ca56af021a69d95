# SPDX-License-Identifier: GPL-3.0-or-later
"""Put what is seen of the objects of the scene in their place, as meshes without modifiers."""

import contextlib
from typing import Any

import bpy

from .extension import Extension

__all__ = ("show_as_meshes",)


def show_as_meshes(extension: Extension, *, only_covered: bool = False) -> list[str]:
    """Replace all that is seen and not yet such a mesh, and return its names.

    Each new object has the name, the children and the place of the one that it stands for. What
    shows no faces stays as it is.

    Parameters
    ----------
    only_covered : bool
        Only meshes whose modifiers are known to show a shape of their own, whatever the mesh is.
    """
    pairs = []
    for obj in list(bpy.context.scene.objects):
        is_as_seen = obj.type == "MESH" and not obj.modifiers
        if is_as_seen or obj.type not in extension.mesh_bridge.KINDS or not obj.visible_get():
            continue
        if only_covered and not (obj.type == "MESH" and extension.mesh_bridge.covers(obj)):
            continue
        with contextlib.suppress(extension.solver.CubicCraftError):
            pairs.append((obj, extension.mesh_bridge.make_seen(obj)))
    for obj, new in pairs:  # all have been evaluated: a modifier may need what goes here
        _replace(obj, new)
    bpy.context.view_layer.update()
    return [new.name for _, new in pairs]


def _replace(obj: bpy.types.Object, new: Any) -> None:
    name = obj.name
    for collection in obj.users_collection:
        collection.objects.link(new)
    for child in obj.children:
        child.parent = new  # its inverse of the parent's place stays
    bpy.data.objects.remove(obj)
    new.name = name
