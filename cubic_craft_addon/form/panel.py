# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of the form, to choose another one, and its own settings."""

from typing import Any

import bpy

from .. import live
from ..settings.overrides import POINTERS
from .settings import form_settings

_SIZE, _SIZE_IN_LIST = 3.0, 5.0  # of the pictures, in buttons
_SHARE = 0.27  # of the width, so that the picture is square in a sidebar of the usual width
_WITH_OWN_LABEL = ("form_sides",)


def draw(layout: Any, properties: Any, is_shared: bool = True) -> None:
    """Draw the selector for a group that has the settings: those that Live shares, or others."""
    row = layout.split(factor=_SHARE)
    row.template_icon_view(
        properties, "form", show_labels=True, scale=_SIZE, scale_popup=_SIZE_IN_LIST
    )
    column = row.column()
    column.use_property_split = False
    column.prop(properties, "form", text="")
    for name in form_settings(properties.form):
        if name == "form_directions":
            _draw_directions(column, properties, is_shared)
            continue
        label = {} if name in _WITH_OWN_LABEL else {"text": ""}
        if is_shared and name in POINTERS and live.current():
            column.prop_search(properties, name, bpy.data, "objects", **label)
        else:
            column.prop(properties, name, **label)


def draw_count(layout: Any, properties: Any) -> None:
    """Draw how many directions were picked, instead of their numbers."""
    text = properties.form_directions
    count = text.count(",") + 1
    layout.label(text=f"{count} directions" if text.strip() else "No faces picked")


def _draw_directions(layout, properties, is_shared):
    """Draw those that were picked; a region has those of its object."""
    if not is_shared:
        properties = live.shared_properties(properties.id_data)
    layout.operator("cubic_craft.form_from_selection", icon="FACESEL", text="Use Selection")
    draw_count(layout, properties)
