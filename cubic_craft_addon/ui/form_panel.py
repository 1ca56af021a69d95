# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of the form, to choose another one, and beside it the form's own settings."""

from typing import Any

import bpy

from .. import live
from ..settings.direction_text import count_directions
from ..settings.forms import form_settings
from ..settings.overrides import POINTERS

_SIZE, _SIZE_IN_LIST = 3.0, 5.0  # of the pictures, in buttons
_SHARE = 0.27  # of the width, so that the picture is square in a sidebar of the usual width
_WITH_OWN_LABEL = ("form_sides",)


def draw(layout: Any, properties: Any) -> None:
    """Draw the selector for a group that has the settings."""
    row = layout.split(factor=_SHARE)
    row.template_icon_view(
        properties, "form", show_labels=True, scale=_SIZE, scale_popup=_SIZE_IN_LIST
    )
    column = row.column()
    column.use_property_split = False
    column.prop(properties, "form", text="")
    for name in form_settings(properties.form):
        label = {} if name in _WITH_OWN_LABEL else {"text": ""}
        if name == "form_directions":
            column.operator("cubic_craft.form_from_selection", icon="FACESEL", text="Use Selection")
            draw_count(column, properties)
        elif name in POINTERS and live.current():
            column.prop_search(properties, name, bpy.data, "objects", **label)
        else:
            column.prop(properties, name, **label)


def draw_count(layout: Any, properties: Any) -> None:
    """Draw how many directions were picked, instead of their numbers."""
    count = count_directions(properties.form_directions)
    layout.label(text=f"{count} directions" if count else "No faces picked")
