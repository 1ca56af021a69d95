# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings that the panel and Adjust Last Operation show alike, line by line.

`properties` is what has them: an object, Live or the operator.
"""

from typing import Any


def draw_volume(layout: Any, properties: Any) -> None:
    """Draw what is kept of pose, details, thickness and parts."""
    layout.prop(properties, "keep_pose")
    row = layout.row(align=True, heading="Detail")
    row.prop(properties, "detail", text="", slider=True)
    row.prop(properties, "detail_strength", text="", slider=True)
    layout.prop(properties, "solidity", slider=True)
    layout.prop(properties, "keep_apart")
    layout.prop(properties, "together")


def draw_advanced(layout: Any, properties: Any) -> None:
    """Draw what is rarely changed."""
    layout.prop(properties, "refine")
    layout.prop(properties, "rotation")


def draw_solver(layout: Any, properties: Any) -> None:
    """Draw where it is computed, and when that ends."""
    layout.prop(properties, "device")
    layout.prop(properties, "max_iterations")
    layout.prop(properties, "tolerance")
