# SPDX-License-Identifier: GPL-3.0-or-later
"""What a click on Cubify sets going: solved step by step, so that it can be watched and cancelled.

``job`` does the work, ``watched`` does it while Blender goes on; the operator in
``operators/cubify.py`` passes events on.
"""

from .job import Job, Step
from .watched import FIRST_SLICE, WatchedJob, current

__all__ = ("FIRST_SLICE", "Job", "Step", "WatchedJob", "current", "register", "unregister")


def register():
    """Nothing is there before the first click."""


def unregister():
    """End what runs."""
    running = current()
    if running is not None:
        running.cancel("CubicCraft was disabled")
