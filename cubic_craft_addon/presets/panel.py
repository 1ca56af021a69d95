# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of the current preset, to choose another one, and its buttons."""

from typing import Any

from .selector import CUSTOM_NAME, preset_of

_SIZE, _SIZE_IN_LIST = 4.0, 5.0  # of the pictures, in buttons
_SHARE = 0.36  # of the width, so that the picture is square in a sidebar of the usual width


def draw(layout: Any, properties: Any) -> None:
    """Draw the selector for a group that has the settings."""
    row = layout.split(factor=_SHARE)
    row.template_icon_view(
        properties, "preset", show_labels=True, scale=_SIZE, scale_popup=_SIZE_IN_LIST
    )
    column = row.column()
    preset = preset_of(properties)
    title = column.row(align=True)
    title.label(text=preset.name if preset else CUSTOM_NAME)
    title.operator("cubic_craft.preset_add", text="", icon="ADD", emboss=False)
    title.operator("cubic_craft.preset_remove", text="", icon="REMOVE", emboss=False)
    column.operator("cubic_craft.reset", text="Defaults", icon="LOOP_BACK")
