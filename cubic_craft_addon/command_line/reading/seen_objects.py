# SPDX-License-Identifier: GPL-3.0-or-later
"""Put what is seen of the objects of the scene in their place, as meshes without modifiers."""

import contextlib
from collections.abc import Iterator
from typing import Any

import bpy

from ....solver.errors import CubicCraftError
from ... import mesh_bridge


def is_in_picture(obj: bpy.types.Object) -> bool:
    """Return whether an object of the scene is shown and rendered.

    What is not rendered is only a tool, such as what a Boolean modifier cuts with.
    """
    rendered = _rendered_collections(bpy.context.scene.collection)
    is_rendered = not obj.hide_render and any(obj.name in c.objects for c in rendered)
    return is_rendered and obj.visible_get()


def _rendered_collections(collection: bpy.types.Collection) -> Iterator[bpy.types.Collection]:
    if not collection.hide_render:
        yield collection
        for child in collection.children:
            yield from _rendered_collections(child)


def show_as_meshes(*, only_covered: bool = False) -> list[str]:
    """Replace all that is seen, rendered and not yet such a mesh, and return its names.

    Each new object has the name, the children and the place of the one that it stands for. What
    shows no faces stays as it is.

    `only_covered`: only meshes whose modifiers are known to show a shape of their own, whatever the
    mesh is.
    """
    pairs = []
    for obj in list(bpy.context.scene.objects):
        is_as_seen = obj.type == "MESH" and not obj.modifiers
        if is_as_seen or obj.type not in mesh_bridge.KINDS or not is_in_picture(obj):
            continue
        if only_covered and not (obj.type == "MESH" and mesh_bridge.covers(obj)):
            continue
        with contextlib.suppress(CubicCraftError):
            pairs.append((obj, mesh_bridge.make_seen(obj)))
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
