# SPDX-License-Identifier: GPL-3.0-or-later
"""Handles, regions and painted maps follow when their vertex group is renamed.

Settings refer to a vertex group by its name, and Blender does not report the old name. The
names are therefore compared after each update of an object: one that has changed while all others
stayed in place is a rename. Anything unclear is ignored, and the panel shows what is missing.

A group with the name of our attribute is first renamed, before Blender acts on the name
(`mesh_bridge.set_groups_aside`).

The names are kept in memory only. Renames are remembered, because an undo may bring the old name
back into the settings: Blender has saved the step before we could follow.
"""

import bpy
from bpy.app.handlers import persistent

from .. import mesh_bridge
from ..environment import handlers
from ..object_properties import has_properties, object_properties

_MAPS = ("map_group", "detail_group")
_names: dict[str, tuple[str, ...]] = {}
"""last known names of the vertex groups, by the full name of the object"""
_renames: dict[str, dict[str, str]] = {}
"""old name to new name, by the object's full name"""


@persistent
def _follow_updates(_scene, depsgraph):
    for update in depsgraph.updates:
        if isinstance(update.id, bpy.types.Object) and update.id.type == "MESH":
            _look_at(update.id.original)


@persistent
def _start_anew(*_):
    _names.clear()
    _renames.clear()
    for obj in bpy.data.objects:
        if obj.type == "MESH":
            _look_at(obj)


def _look_at(obj):
    mesh_bridge.set_groups_aside(obj)
    _follow(obj)


def _follow(obj):
    if not has_properties(obj):
        return
    properties = object_properties(obj)
    parts = [*properties.handles, *properties.regions]
    named = [(properties, name) for name in _MAPS] + [(part, "group") for part in parts]
    if not any(getattr(settings, name) for settings, name in named):
        return
    key = obj.name_full
    names = tuple(group.name for group in obj.vertex_groups)
    before = _names.get(key, names)
    _names[key] = names
    if names != before:
        _renames.setdefault(key, {}).update(_rename(before, names))
    renames = _renames.get(key)
    if not renames:
        return
    for settings, name in named:
        old = getattr(settings, name)
        new = _name_now(old, names, renames)
        if new != old:
            setattr(settings, name, new)


def _rename(before, now):
    """Return {old name: new name} if nothing else has changed, otherwise nothing."""
    if len(before) != len(now):
        return {}
    pairs = [(old, new) for old, new in zip(before, now, strict=True) if old != new]
    is_rename = len(pairs) == 1 and pairs[0][0] not in now and pairs[0][1] not in before
    return dict(pairs) if is_rename else {}


def _name_now(old, names, renames):
    """Return the current name of the vertex group `old`; the same name if unknown."""
    new, steps = old, 0
    while new and new not in names and new in renames and steps < len(renames):
        new, steps = renames[new], steps + 1
    return new if new in names else old


_HANDLERS = (("depsgraph_update_post", _follow_updates), ("load_post", _start_anew))


def register():
    """Add the handlers."""
    handlers.install(_HANDLERS)


def unregister():
    """Remove the handlers."""
    handlers.remove(_HANDLERS)
    _names.clear()
    _renames.clear()
