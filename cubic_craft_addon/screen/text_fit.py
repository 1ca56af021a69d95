# SPDX-License-Identifier: GPL-3.0-or-later
"""Texts that fit the sidebar: Blender truncates long text and does not wrap it."""

from collections.abc import Iterable
from typing import Any

import blf
import bpy

_FONT = 0  # that of the interface
_UNIT = 20  # pixels at scale 1: the height of a button, the width of an icon
_TABS = 1.0  # units, at the right edge
_MARGINS = 2.8  # units, left and right of a line of text together, with its padding
_BOX = 2.0  # units that a box and an icon in it take from a line
_NARROW = 8.0  # units for text: less than half of it holds no name of a setting


def room_for_text(context: bpy.types.Context, taken: float = 0.0) -> float:
    """Return how wide a line of text in the panel may be.

    `context`: of a panel that is being drawn. `taken`: width of the other items in the line, in
    widths of an icon. It is in the pixels of `width_of`.
    """
    view = context.region.view2d  # the artist may have zoomed the sidebar
    width = view.region_to_view(context.region.width, 0)[0] - view.region_to_view(0, 0)[0]
    unit = _UNIT * context.preferences.system.ui_scale
    return width - (_TABS + _MARGINS + taken) * unit


def is_narrow(context: bpy.types.Context) -> bool:
    """Return whether names and values of settings side by side would be cut off.

    `context`: of a panel that is being drawn.
    """
    return room_for_text(context) < _NARROW * _UNIT * context.preferences.system.ui_scale


def width_of(text: str) -> float:
    """Return the width of a text in the interface, in pixels."""
    preferences = bpy.context.preferences
    points = preferences.ui_styles[0].widget.points
    blf.size(_FONT, points * preferences.system.ui_scale)
    return blf.dimensions(_FONT, text)[0]


def longest_that_fits(texts: Iterable[str], room: float) -> str:
    """Return the first of some texts, from long to short, that fits; the last if none does."""
    text = ""
    for text in texts:
        if width_of(text) <= room:
            break
    return text


def wrapped(text: str, room: float) -> list[str]:
    """Return the lines of a text, broken between words; a word that is too long has its own."""
    lines: list[str] = []
    for word in text.split():
        longer = f"{lines[-1]} {word}" if lines else word
        if lines and width_of(longer) <= room:
            lines[-1] = longer
        else:
            lines.append(word)
    return lines


def draw_wrapped(
    context: bpy.types.Context, column: Any, text: str, icon: Any = "NONE", taken: float = _BOX
) -> None:
    """Draw a text, in as many lines as it needs, with an icon at the first.

    `context`: of a panel that is being drawn. `column`: an aligned column, of a box by default.
    `icon`: name of the icon. `taken`: as of `room_for_text`, of a box with an icon by default.
    """
    for line in wrapped(text, room_for_text(context, taken)):
        column.label(text=line, icon=icon)
        icon = "NONE" if icon == "NONE" else "BLANK1"
