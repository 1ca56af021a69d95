# SPDX-License-Identifier: GPL-3.0-or-later
"""The section "Regions" of the panel: a list with its buttons, and the active region."""

from ..form import panel as form_panel
from ..ui.group_list import draw_list

SECTION = "CUBIC_CRAFT_PT_regions"


def draw(layout, obj):
    """Draw the section for a mesh object."""
    region = draw_list(layout, obj, "region")
    layout.operator("cubic_craft.region_from_selection", icon="RESTRICT_SELECT_OFF")
    if region is not None:
        layout.prop_search(region, "group", obj, "vertex_groups")
        form_panel.draw(layout, region, is_shared=False)
        layout.prop(region, "cubeness", slider=True)
        layout.prop(region, "orientation")
