# SPDX-License-Identifier: GPL-3.0-or-later
"""A copy of all that a file holds, in plain values: `snapshot` for everything at once."""

import bpy
from snapshot import plain_properties, snapshot_object

# Windows and libraries hold nothing of the artist's that we could touch.
_NOT_DATA = ("window_managers", "screens", "workspaces", "libraries")


def snapshot_world():
    """Take every data-block by name, and of each object all that is in it and its settings."""
    taken = {"blocks": block_names()}
    for obj in bpy.data.objects:
        values = snapshot_object(obj) if obj.type == "MESH" else plain_properties(obj)
        values |= {f"settings/{name}": value for name, value in _settings(obj).items()}
        taken |= {f"{obj.name}/{path}": value for path, value in values.items()}
    for scene in bpy.data.scenes:
        taken |= {f"{scene.name}/{name}": v for name, v in plain_properties(scene).items()}
    active = bpy.context.view_layer.objects.active
    taken["active"] = active and active.name
    taken["mode"] = bpy.context.mode
    return taken


def block_names():
    """Return the names of all data-blocks by the name of their collection."""
    names = {}
    for prop in bpy.data.bl_rna.properties:
        if prop.type == "COLLECTION" and prop.identifier not in _NOT_DATA:
            names[prop.identifier] = sorted(b.name_full for b in getattr(bpy.data, prop.identifier))
    return names


def _settings(obj):
    values = plain_properties(obj.cubic_craft)
    for number, handle in enumerate(obj.cubic_craft.handles):
        values |= {f"handle {number}/{k}": v for k, v in plain_properties(handle).items()}
    return values
