# SPDX-License-Identifier: GPL-3.0-or-later
"""The section "Handles" of the panel: a list with its buttons, and the active handle."""

import bpy

from .. import live
from ..object_properties import object_properties
from ..ui.group_lines import draw_groups
from .owner import panel_object
from .pose import live_target

SECTION = "CUBIC_CRAFT_PT_handles"
_ROWS, _FEWEST_ROWS = 5, 3  # as high as the buttons beside the list


class CUBIC_CRAFT_UL_handles(bpy.types.UIList):
    """The handles of an object, a row for each."""

    def draw_item(self, context, layout, data, item, icon, active_data, active_property):
        """Draw a handle: its vertex group, and whether it is pinned or follows."""
        obj = item.id_data
        row = layout.row(align=True)
        row.alert = item.group not in obj.vertex_groups
        row.prop(item, "group", text="", emboss=False, icon="GROUP_VERTEX")
        row.prop(item, "mode", text="", icon_only=True)


class CUBIC_CRAFT_MT_handle_groups(bpy.types.Menu):
    """The vertex groups that can become handles."""

    bl_label = "Add Handle"

    def draw(self, context):
        """Draw a line for each vertex group."""
        draw_groups(self.layout, panel_object(bpy.context), "cubic_craft.handle_add")


def draw_switch(layout, obj):
    """Draw the switch for all handles in the header of the section."""
    layout.use_property_split = False
    layout.prop(live.own_properties(obj), "use_handles", text="")


def draw(layout, obj):
    """Draw the section for a mesh object."""
    properties = object_properties(obj)
    layout = layout.column()
    layout.active = live.own_properties(obj).use_handles
    handles = properties.handles
    row = layout.row()
    row.template_list(
        "CUBIC_CRAFT_UL_handles",
        "",
        properties,
        "handles",
        properties,
        "active_handle",
        rows=_ROWS if len(handles) > 1 else _FEWEST_ROWS,
    )
    buttons = row.column(align=True)
    buttons.operator("cubic_craft.handle_add", icon="ADD", text="").group = ""
    buttons.operator("cubic_craft.handle_remove", icon="REMOVE", text="")
    buttons.menu("CUBIC_CRAFT_MT_handle_groups", icon="DOWNARROW_HLT", text="")
    if len(handles) > 1:
        buttons.separator()
        buttons.operator("cubic_craft.handle_move", icon="TRIA_UP", text="").direction = "UP"
        buttons.operator("cubic_craft.handle_move", icon="TRIA_DOWN", text="").direction = "DOWN"
    layout.operator("cubic_craft.handle_pin_selection", icon="PINNED")
    if properties.active_handle < len(handles):
        _draw_active(layout, obj, handles[properties.active_handle])
    layout.prop(live.shared_properties(obj), "hold_rest")
    layout.operator("cubic_craft.handle_reset_pose", icon="LOOP_BACK")


def _draw_active(layout, obj, handle):
    column = layout.column()
    column.prop_search(handle, "group", obj, "vertex_groups")
    column.prop(handle, "threshold", slider=True)
    column.prop(handle, "is_cubic")
    if handle.mode == "FOLLOW":
        column.prop(handle, "target")
        if live_target(handle) is None:
            column.label(text="Stays in place: no target", icon="INFO")
    if live_target(handle) is None:
        column.operator("cubic_craft.handle_follow", icon="EMPTY_AXIS")


register, unregister = bpy.utils.register_classes_factory(
    (CUBIC_CRAFT_UL_handles, CUBIC_CRAFT_MT_handle_groups)
)
