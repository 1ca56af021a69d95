# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubify and Live at the right end of the viewport's header, while the panel is scrolled.

Blender scrolls a sidebar as a whole, so that open sections push its buttons out of sight. In the
header above, they stay where they are.

Blender does not redraw the header when the sidebar is scrolled or shows another tab. But then it
asks all panels of the sidebar whether they are shown, and ours calls `look_at`.
"""

from functools import partial
from typing import Any

import bpy

from .. import job, live
from ..mesh_bridge import last_run
from ..run.up_to_date import changes_since
from . import buttons

_FARTHEST = 80.0
"""pixels at scale 1 by which the panel can be scrolled until its buttons may be out of sight"""
_HEADERS = ("VIEW3D_HT_tool_header", "VIEW3D_HT_header")

_tab = ""
_drawn: dict[int, tuple[bool, ...] | None] = {}
"""what the buttons in the header of an area look like, by its address; None for no buttons"""


def is_scrolled(area: Any, scale: float) -> bool:
    """Return whether the sidebar of a viewport shows our tab, but maybe not its upper end.

    `scale`: of the interface.
    """
    sidebar = next((region for region in area.regions if region.type == "UI"), None)
    if sidebar is None or sidebar.width <= 1 or sidebar.active_panel_category != _tab:
        return False
    _, top = sidebar.view2d.region_to_view(0, sidebar.height)
    return -top > _FARTHEST * scale


def look_at(context: bpy.types.Context, tab: str) -> None:
    """Draw the header of the viewport anew, soon, if its buttons are to change.

    `context`: of a sidebar that is being drawn. `tab`: the one that has the panel.
    """
    global _tab
    _tab = tab
    if context.area is None:
        return
    address = context.area.as_pointer()
    if _look(context) != _drawn.get(address):
        # Not now: the layout of the header may be done already, and would be drawn as it is.
        bpy.app.timers.register(partial(_redraw, address), first_interval=0.0)


def _redraw(address):
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.as_pointer() == address:
                for region in area.regions:
                    if region.type in ("HEADER", "TOOL_HEADER"):
                        region.tag_redraw()


def _look(context):
    """Return whether the settings have changed, Live runs and Cubify runs; None for no buttons."""
    if not is_scrolled(context.area, context.preferences.system.ui_scale):
        return None
    session, obj = live.current(), live.panel_mesh(context)
    if obj is None:
        return None
    run = last_run(obj)
    is_outdated = run is not None and not session and bool(changes_since(obj, run))
    return is_outdated, session is not None, job.current() is not None


def _draw(self: Any, context: Any) -> None:
    is_tool_header = context.region.type == "TOOL_HEADER"
    if is_tool_header != context.space_data.show_region_tool_header:
        return  # the other one draws them
    look = _drawn[context.area.as_pointer()] = _look(context)
    if look is not None:
        buttons.draw(self.layout.row(), is_outdated=look[0])


def register() -> None:
    """Add the buttons to the headers."""
    for name in _HEADERS:
        getattr(bpy.types, name).append(_draw)


def unregister() -> None:
    """Remove them."""
    for name in _HEADERS:
        getattr(bpy.types, name).remove(_draw)
    _drawn.clear()
