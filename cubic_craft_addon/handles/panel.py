# SPDX-License-Identifier: GPL-3.0-or-later
"""The section "Handles" of the panel: a list with its buttons, and the active handle."""

from .. import live
from ..ui.group_list import draw_list
from .pose import live_target

SECTION = "CUBIC_CRAFT_PT_handles"


def draw(layout, obj):
    """Draw the section for a mesh object."""
    handle = draw_list(layout, obj, "handle")
    layout.operator("cubic_craft.handle_pin_selection", icon="PINNED")
    if handle is not None:
        _draw_active(layout, obj, handle)
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
