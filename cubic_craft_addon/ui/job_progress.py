# SPDX-License-Identifier: GPL-3.0-or-later
"""The progress of Cubify in the panel, and what its buttons are meanwhile."""

from collections.abc import Callable, Iterable
from typing import Any

from ..job.watched import WatchedJob, current


def draw(layout, running: WatchedJob, fit: Callable[[Iterable[str]], str]) -> None:
    """Draw the bar, with the longest text that fits, and the button that ends it."""
    row = layout.row(align=True)
    row.progress(text=fit(running.step.texts), factor=running.step.factor)
    row.operator("cubic_craft.cubify_cancel", text="", icon="X")


def operator(layout: Any, identifier: str, **look: Any) -> Any:
    """Draw the button of an operator that cannot be used while something runs.

    Meanwhile another operator stands in its place: the button under the mouse, such as the one that
    was clicked, would keep the gray of the run until the mouse leaves it (Blender 4.3), because
    Blender takes it for the same button, and only ever adds to that what grays it.
    """
    return layout.operator(identifier if current() is None else "cubic_craft.busy", **look)
