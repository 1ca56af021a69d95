# SPDX-License-Identifier: GPL-3.0-or-later
"""The section "Regions" of the panel: a list with its buttons, and the active region."""

import bpy

from .. import live
from ..form import panel as form_panel
from ..handles.owner import panel_object
from ..object_properties import object_properties
from ..ui.group_lines import draw_groups

SECTION = "CUBIC_CRAFT_PT_regions"
_ROWS = 3  # as high as the buttons beside the list


class CUBIC_CRAFT_UL_regions(bpy.types.UIList):
    """The regions of an object, a row for each."""

    def draw_item(self, context, layout, data, item, icon, active_data, active_property):
        """Draw a region: its vertex group and its form."""
        row = layout.row(align=True)
        row.alert = item.group not in item.id_data.vertex_groups
        row.prop(item, "group", text="", emboss=False, icon="GROUP_VERTEX")
        row.prop(item, "form", text="", emboss=False)


class CUBIC_CRAFT_MT_region_groups(bpy.types.Menu):
    """The vertex groups that can become regions."""

    bl_label = "Add Region"

    def draw(self, context):
        """Draw a line for each vertex group."""
        draw_groups(self.layout, panel_object(bpy.context), "cubic_craft.region_add")


def draw_switch(layout, obj):
    """Draw the switch for all regions in the header of the section."""
    layout.use_property_split = False
    layout.prop(live.own_properties(obj), "use_regions", text="")


def draw(layout, obj):
    """Draw the section for a mesh object."""
    properties = object_properties(obj)
    layout = layout.column()
    layout.active = live.own_properties(obj).use_regions
    row = layout.row()
    row.template_list(
        "CUBIC_CRAFT_UL_regions", "", properties, "regions", properties, "active_region", rows=_ROWS
    )
    buttons = row.column(align=True)
    buttons.operator("cubic_craft.region_add", icon="ADD", text="").group = ""
    buttons.operator("cubic_craft.region_remove", icon="REMOVE", text="")
    buttons.menu("CUBIC_CRAFT_MT_region_groups", icon="DOWNARROW_HLT", text="")
    layout.operator("cubic_craft.region_from_selection", icon="RESTRICT_SELECT_OFF")
    if properties.active_region < len(properties.regions):
        region = properties.regions[properties.active_region]
        layout.prop_search(region, "group", obj, "vertex_groups")
        form_panel.draw(layout, region, is_shared=False)
        layout.prop(region, "cubeness", slider=True)
        layout.prop(region, "orientation")


register, unregister = bpy.utils.register_classes_factory(
    (CUBIC_CRAFT_UL_regions, CUBIC_CRAFT_MT_region_groups)
)
