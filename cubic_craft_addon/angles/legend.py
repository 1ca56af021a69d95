# SPDX-License-Identifier: GPL-3.0-or-later
"""The legend of the angles to the form: what their colors mean, in a corner of the viewport."""

from typing import Any

import blf
import bpy
import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

from ..screen.text_fit import width_of
from .measured import ALIGNED

TITLE = "Angle to the form"
LARGEST = 30.0
"""degrees; larger angles have the color of this one"""

# The upper three quarters of "viridis", whose steps look alike, to the color-blind and in gray too.
_STOPS = (
    np.array(
        [
            (0x3B, 0x52, 0x8B),
            (0x2C, 0x72, 0x8E),
            (0x21, 0x91, 0x8C),
            (0x28, 0xAE, 0x80),
            (0x5E, 0xC9, 0x62),
            (0xAD, 0xDC, 0x30),
            (0xFD, 0xE7, 0x25),
        ]
    )
    / 0xFF
)
_TICKS = (0, 10, 20, 30)  # degrees
_BACKDROP = (0.07, 0.07, 0.07, 0.9)
_TEXT = (0.92, 0.92, 0.92, 1.0)
_FONT = 0  # that of the interface
_UNIT = 20  # pixels at scale 1: the height of a line
# In units:
_BAR_WIDTH, _BAR_HEIGHT = 9.0, 0.6
_PADDING, _DISTANCE = 0.5, 0.5
_CORNER = 0.25  # radius
_SEGMENTS = 6  # of a corner of the backdrop


def colors_of(degrees: np.ndarray) -> np.ndarray:
    """Return the colors (m,4) float32 of angles (m,), RGBA as on the screen."""
    colors = np.ones((len(degrees), 4), np.float32)
    stops = np.linspace(0.0, LARGEST, len(_STOPS))
    for channel, values in enumerate(_STOPS.T):
        colors[:, channel] = np.interp(degrees, stops, values)
    return colors


def free_corner(area: bpy.types.Area, view: bpy.types.Region) -> tuple[int, int]:
    """Return the right and lower end of what no other region covers of the viewport, in its pixels.

    The sidebar may cover its right side, and the asset shelf or a header its lower one.
    """
    right, bottom = view.width, 0
    for region in area.regions:
        if region.type == "WINDOW" or min(region.width, region.height) <= 1:
            continue  # the other views of a quad view do not overlap
        if region.alignment == "RIGHT":
            right = min(right, region.x - view.x)
        elif region.alignment == "BOTTOM":
            bottom = max(bottom, region.y + region.height - view.y)
    return right, bottom


def draw(context: bpy.types.Context, share: float) -> None:
    """Draw the legend with the share of the area that is aligned, if there is room for it."""
    unit = _UNIT * context.preferences.system.ui_scale
    view = context.region
    right, bottom = free_corner(context.area, view)
    width, height = (_BAR_WIDTH + 2 * _PADDING) * unit, (3.4 + _BAR_HEIGHT + _PADDING) * unit
    left, bottom = right - _DISTANCE * unit - width, bottom + _DISTANCE * unit
    if left < 0 or bottom + height > view.height:
        return
    gpu.state.blend_set("ALPHA")
    _draw_backdrop(left, bottom, width, height, _CORNER * unit)
    left, y = left + _PADDING * unit, bottom + _PADDING * unit
    _write(f"{100 * share:.0f} % of the area within {ALIGNED:.0f}°", left, y)
    y += 1.2 * unit
    for degrees in _TICKS:
        text = f"{degrees}°" if degrees < LARGEST else f"{degrees}°+"
        _write(text, left + _across(degrees, unit, width_of(text)), y)
    y += 0.9 * unit
    _draw_bar(left, y, unit)
    _write(TITLE, left, y + (_BAR_HEIGHT + 0.4) * unit)
    gpu.state.blend_set("NONE")


def _across(degrees, unit, width):
    """Return where a text of some width begins: under its angle, but not beyond the bar."""
    middle = degrees / LARGEST * _BAR_WIDTH * unit
    return min(max(middle - width / 2, 0.0), _BAR_WIDTH * unit - width)


def _draw_backdrop(left, bottom, width, height, radius):
    middles = [(width - radius, height - radius), (radius, height - radius)]
    middles += [(radius, radius), (width - radius, radius)]
    turns = np.linspace(0.0, np.pi / 2, _SEGMENTS)
    outline = [
        (left + x + radius * np.cos(turn), bottom + y + radius * np.sin(turn))
        for quarter, (x, y) in enumerate(middles)
        for turn in turns + quarter * np.pi / 2
    ]
    shader = gpu.shader.from_builtin("UNIFORM_COLOR")
    fan = [(0, i, i + 1) for i in range(1, len(outline) - 1)]
    batch = batch_for_shader(shader, "TRIS", {"pos": outline}, indices=fan)
    shader.uniform_float("color", _BACKDROP)
    batch.draw(shader)


def _draw_bar(left, bottom, unit):
    """Draw the colors, and a line where the aligned area ends."""
    x = left + np.linspace(0.0, _BAR_WIDTH * unit, len(_STOPS))
    top = bottom + _BAR_HEIGHT * unit
    ends = np.array([(x, np.full_like(x, y)) for y in (bottom, top)]).transpose(2, 0, 1)
    colors = colors_of(np.linspace(0.0, LARGEST, len(_STOPS))).repeat(2, axis=0)
    shader = gpu.shader.from_builtin("SMOOTH_COLOR")
    corners: dict[str, Any] = {"pos": ends.reshape(-1, 2).tolist(), "color": colors.tolist()}
    batch_for_shader(shader, "TRI_STRIP", corners).draw(shader)
    middle, half = left + ALIGNED / LARGEST * _BAR_WIDTH * unit, 0.05 * unit
    line = [(middle + side * half, y) for side in (-1, 1) for y in (bottom, top)]
    shader = gpu.shader.from_builtin("UNIFORM_COLOR")
    shader.uniform_float("color", _TEXT)
    batch_for_shader(shader, "TRI_STRIP", {"pos": line}).draw(shader)


def _write(text, x, y):
    """Write a text; `width_of` sets the size."""
    width_of(text)
    blf.color(_FONT, *_TEXT)
    blf.position(_FONT, round(x), round(y), 0)
    blf.draw(_FONT, text)
