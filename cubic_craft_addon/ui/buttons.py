# SPDX-License-Identifier: GPL-3.0-or-later
"""The two buttons that are clicked most, Cubify and Live, for the panel and for the header."""

from typing import Any

from .. import live
from . import job_progress


def draw(layout: Any, *, is_outdated: bool) -> None:
    """Draw them side by side; `is_outdated` says whether the settings have changed since."""
    session = live.current()
    job_progress.operator(
        layout,
        "cubic_craft.cubify",
        text="Update" if is_outdated else "Cubify",
        icon="FILE_REFRESH" if is_outdated else "MESH_CUBE",
    )
    row = layout.row(align=True)
    job_progress.operator(
        row,
        "cubic_craft.live",
        icon="CHECKMARK" if session else "PLAY",
        text="Confirm" if session else "Live",
        depress=session is not None,
    )
    if session:
        row.operator("cubic_craft.live_cancel", text="", icon="X")
