# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings that the panel and Adjust Last Operation show alike, line by line.

`properties` is what has them: an object, Live or the operator.
"""

from typing import Any


def draw_volume(layout: Any, properties: Any) -> None:
    """Draw what is kept of pose, details, thickness and parts."""
    layout.prop(properties, "keep_pose")
    _draw_detail(layout, properties)
    layout.prop(properties, "solidity", slider=True)
    layout.prop(properties, "keep_apart")
    layout.prop(properties, "together")


def _draw_detail(layout, properties):
    """Draw the size and the strength of details in one row: split as Blender splits properties."""
    split = layout.split(factor=0.4, align=True)
    label = split.row()
    label.alignment = "RIGHT" if layout.use_property_split else "LEFT"
    label.label(text="Detail")
    row = split.row(align=True)
    row.use_property_split = False
    row.prop(properties, "detail", text="", slider=True)
    row.prop(properties, "detail_strength", text="", slider=True)


def draw_advanced(layout: Any, properties: Any) -> None:
    """Draw what is rarely changed."""
    layout.prop(properties, "refine")
    layout.prop(properties, "rotation")


def draw_solver(layout: Any, properties: Any) -> None:
    """Draw where it is computed, and when that ends."""
    layout.prop(properties, "device")
    layout.prop(properties, "max_iterations")
    layout.prop(properties, "tolerance")
