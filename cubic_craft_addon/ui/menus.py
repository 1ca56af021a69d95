# SPDX-License-Identifier: GPL-3.0-or-later
"""The menu Object > Cubic Craft, also on right click: F3 and Quick Favorites search menus."""

from typing import Any

import bpy

from .. import mesh_bridge
from ..handles.owner import panel_object
from ..object_properties import object_properties

_PARENTS = ("VIEW3D_MT_object", "VIEW3D_MT_object_context_menu")
_RESTORE_FIRST = "cubic_craft.restore_first"  # only where there is one
# Names that say what they do where no panel stands around them.
_ENTRIES: tuple[tuple[str, str, Any] | None, ...] = (
    ("cubic_craft.cubify", "Cubify", "MESH_CUBE"),
    ("cubic_craft.live", "Cubify Live", "PLAY"),
    ("cubic_craft.auto_orient", "Auto Orient Cube", "ORIENTATION_GLOBAL"),
    None,
    ("cubic_craft.restore", "Restore Original Shape", "LOOP_BACK"),
    (_RESTORE_FIRST, "Restore First Original Shape", "REW"),
    ("cubic_craft.apply", "Apply Cubic Shape", "CHECKMARK"),
    None,
    ("cubic_craft.bake_animation", "Cubify Animation", "RENDER_ANIMATION"),
    ("cubic_craft.send_to", "Send Cubic Shape To", "EXPORT"),
)


class VIEW3D_MT_object_cubic_craft(bpy.types.Menu):
    """What can be done with the selected objects."""

    bl_label = "Cubic Craft"

    def draw(self, context):
        """Draw the entries, and the setting that characters need."""
        assert context is not None
        layout, obj = self.layout, panel_object(context)
        layout.operator_context = "INVOKE_REGION_WIN"
        for entry in _ENTRIES:
            if entry is None:
                layout.separator()
                continue
            identifier, text, icon = entry
            if identifier != _RESTORE_FIRST or (obj and mesh_bridge.has_first(obj.data)):
                layout.operator(identifier, text=text, icon=icon)
        if obj is not None:
            layout.separator()
            layout.prop(object_properties(obj), "keep_pose")


def _draw_entry(self: Any, _context: bpy.types.Context) -> None:
    self.layout.separator()
    self.layout.menu(VIEW3D_MT_object_cubic_craft.__name__, icon="MESH_CUBE")


def register() -> None:
    """Add the menu to those of Blender."""
    bpy.utils.register_class(VIEW3D_MT_object_cubic_craft)
    for name in _PARENTS:
        getattr(bpy.types, name).append(_draw_entry)


def unregister() -> None:
    """Undo `register`."""
    for name in _PARENTS:
        getattr(bpy.types, name).remove(_draw_entry)
    bpy.utils.unregister_class(VIEW3D_MT_object_cubic_craft)
