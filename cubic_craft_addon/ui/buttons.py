# SPDX-License-Identifier: GPL-3.0-or-later
"""The two buttons that are clicked most, Cubify and Live, for the panel and for the header."""

from typing import Any

from .. import live
from . import job_progress


def draw(layout: Any, *, is_outdated: bool, has_icons: bool = True) -> None:
    """Draw them side by side; `is_outdated` says whether the settings have changed since."""
    session = live.current()
    cubify_icon = "FILE_REFRESH" if is_outdated else "MESH_CUBE"
    live_icon = "CHECKMARK" if session else "PLAY"
    job_progress.operator(
        layout,
        "cubic_craft.cubify",
        text="Update" if is_outdated else "Cubify",
        icon=cubify_icon if has_icons else "NONE",
    )
    row = layout.row(align=True)
    job_progress.operator(
        row,
        "cubic_craft.live",
        icon=live_icon if has_icons else "NONE",
        text="Confirm" if session else "Live",
        depress=session is not None,
    )
    if session:
        row.operator("cubic_craft.live_cancel", text="", icon="X")
