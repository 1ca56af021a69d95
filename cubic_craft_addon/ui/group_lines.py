# SPDX-License-Identifier: GPL-3.0-or-later
"""The vertex groups of an object in a menu, for handles and for regions."""

from typing import Any


def draw_groups(layout: Any, obj: Any, operator: str) -> None:
    """Draw a line for each vertex group of an object, which calls an operator with its name."""
    if obj is None or not obj.vertex_groups:
        layout.label(text="The mesh has no vertex group")
        return
    for group in obj.vertex_groups:
        line = layout.operator(operator, text=group.name, icon="GROUP_VERTEX", translate=False)
        line.group = group.name
