# SPDX-License-Identifier: GPL-3.0-or-later
"""Redraw what Blender redraws by itself only after changes by the artist."""

import contextlib
from collections.abc import Callable, Iterator
from typing import Any

import bpy


def redraw_panels() -> None:
    """Draw the sidebars of all viewports with the next redraw."""
    for _, _, region in _sidebars():
        region.tag_redraw()


def redraw_views() -> None:
    """Redraw all 3D viewports."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


def draw_status(draw: Callable[[Any, bpy.types.Context], None] | None) -> None:
    """Draw the status bar with a function from now on, or with None as Blender does; now, too."""
    # A function, as opposed to a text, is shown in all workspaces: any of them will do.
    bpy.data.workspaces[0].status_text_set(draw)


@contextlib.contextmanager
def waiting(window: bpy.types.Window | None) -> Iterator[None]:
    """Show that Blender computes, if there is a window."""
    if window is None:
        yield
        return
    window.cursor_modal_set("WAIT")
    try:
        yield
    finally:
        window.cursor_modal_restore()


def find_button_under_mouse() -> None:
    """Let Blender look for the button under the mouse after the next redraw.

    A button that another one replaces there would get no click before the mouse moves. That Blender
    acts as if it did is a side effect of panning, here by nothing.
    """
    if bpy.app.background:
        return
    for window, area, region in _sidebars():
        with (
            contextlib.suppress(RuntimeError),
            bpy.context.temp_override(window=window, area=area, region=region),
        ):
            bpy.ops.view2d.pan(deltax=0, deltay=0)


def _sidebars() -> Iterator[tuple[bpy.types.Window, bpy.types.Area, bpy.types.Region]]:
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                for region in area.regions:
                    if region.type == "UI":
                        yield window, area, region
