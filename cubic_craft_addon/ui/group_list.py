# SPDX-License-Identifier: GPL-3.0-or-later
"""The lists of an object whose entries are about vertex groups: its handles and its regions."""

from typing import Any

import bpy

from ..handles.owner import panel_object
from ..object_properties import active_entry, object_properties

_ROWS = 3  # as high as the buttons beside the list


def draw_list(layout: Any, obj: bpy.types.Object, kind: str) -> Any:
    """Draw a list with its buttons, and return the entry that is active, or None.

    `kind`: "handle" or "region", by which properties and operators are named.
    """
    properties = object_properties(obj)
    row = layout.row()
    row.template_list(
        CUBIC_CRAFT_UL_groups.__name__,
        kind,
        *(properties, f"{kind}s"),
        *(properties, f"active_{kind}"),
        rows=_ROWS,
    )
    buttons = row.column(align=True)
    buttons.operator(f"cubic_craft.{kind}_add", icon="ADD", text="").group = ""
    buttons.operator(f"cubic_craft.{kind}_remove", icon="REMOVE", text="")
    buttons.menu(f"CUBIC_CRAFT_MT_{kind}_groups", icon="DOWNARROW_HLT", text="")
    return active_entry(obj, kind)


class CUBIC_CRAFT_UL_groups(bpy.types.UIList):
    """The handles or the regions of an object, a row for each."""

    def draw_item(self, context, layout, data, item, icon, active_data, active_property):
        """Draw the vertex group, and whether a handle is pinned or the form of a region."""
        row = layout.row(align=True)
        row.alert = item.group not in item.id_data.vertex_groups
        row.prop(item, "group", text="", emboss=False, icon="GROUP_VERTEX")
        if self.list_id == "handle":
            row.prop(item, "mode", text="", icon_only=True)
        else:
            row.prop(item, "form", text="", emboss=False)


class _Groups:
    """The vertex groups that can be added to a list, a line for each."""

    operator: str
    layout: Any

    def draw(self, context):
        """Draw the lines, each of which calls the operator with the name of its group."""
        layout, obj = self.layout, panel_object(context)
        if obj is None or not obj.vertex_groups:
            layout.label(text="The mesh has no vertex group")
            return
        for group in obj.vertex_groups:
            look = {"text": group.name, "icon": "GROUP_VERTEX", "translate": False}
            layout.operator(self.operator, **look).group = group.name


class CUBIC_CRAFT_MT_handle_groups(_Groups, bpy.types.Menu):
    """The vertex groups that can become handles."""

    bl_label, operator = "Add Handle", "cubic_craft.handle_add"


class CUBIC_CRAFT_MT_region_groups(_Groups, bpy.types.Menu):
    """The vertex groups that can become regions."""

    bl_label, operator = "Add Region", "cubic_craft.region_add"


register, unregister = bpy.utils.register_classes_factory(
    (CUBIC_CRAFT_UL_groups, CUBIC_CRAFT_MT_handle_groups, CUBIC_CRAFT_MT_region_groups)
)
