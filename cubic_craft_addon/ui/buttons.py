# SPDX-License-Identifier: GPL-3.0-or-later
"""The two buttons that are clicked most, Cubify and Live, and all while Cubify runs."""

from collections.abc import Callable, Iterable
from typing import Any

from .. import live
from ..job.watched import WatchedJob, current


def draw_progress(layout, running: WatchedJob, fit: Callable[[Iterable[str]], str]) -> None:
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


def draw(layout: Any, *, is_outdated: bool, has_icons: bool = True) -> None:
    """Draw both side by side; `is_outdated` says whether the settings have changed since."""
    session = live.current()
    cubify_icon = "FILE_REFRESH" if is_outdated else "MESH_CUBE"
    live_icon = "CHECKMARK" if session else "PLAY"
    operator(
        layout,
        "cubic_craft.cubify",
        text="Update" if is_outdated else "Cubify",
        icon=cubify_icon if has_icons else "NONE",
    )
    row = layout.row(align=True)
    operator(
        row,
        "cubic_craft.live",
        icon=live_icon if has_icons else "NONE",
        text="Confirm" if session else "Live",
        depress=session is not None,
    )
    if session:
        row.operator("cubic_craft.live_cancel", text="", icon="X")
