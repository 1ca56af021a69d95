# SPDX-License-Identifier: GPL-3.0-or-later
"""Waiting until Blender has done something: on conditions, never on seconds."""

import collections
import functools
import time

import bpy

from .screen import area

_LOOK_STEP = 0.002  # seconds between two looks; what is waited for runs in the meantime

counts = collections.Counter()  # draws of the viewport's regions, and undo steps taken back


def wait_until(condition, timeout=300.0, what=None):
    """Wait until condition() is true and return its value; TimeoutError names `what`."""
    deadline = time.monotonic() + timeout
    while not (value := condition()):
        if time.monotonic() > deadline:
            raise TimeoutError(f"waited {timeout:g} s for {what or condition}")
        yield _LOOK_STEP
    return value


def wait_redraw(region_type="WINDOW"):
    """Redraw the viewport, and wait until this region of it is on the screen (WINDOW or UI)."""
    drawn = counts[region_type]
    area().tag_redraw()
    yield from wait_until(
        lambda: counts[region_type] > drawn, what=f"a redraw of region {region_type}"
    )


def start_counting():
    """Let Blender count its draws and undo steps in `counts`."""
    for region_type in ("WINDOW", "UI"):
        bpy.types.SpaceView3D.draw_handler_add(
            functools.partial(counts.update, [region_type]), (), region_type, "POST_PIXEL"
        )

    @bpy.app.handlers.persistent
    def count_undo(*_):
        counts["undo"] += 1

    bpy.app.handlers.undo_post.append(count_undo)
