# SPDX-License-Identifier: GPL-3.0-or-later
"""What a click on Cubify starts: solved step by step, so that it can be watched and cancelled.

``job`` does the work, ``watched`` does it while Blender stays responsive; the operator in
``operators/cubify.py`` passes events on.
"""

from .job import Job, Step
from .watched import FIRST_SLICE, AnyJob, WatchedJob, current


def unregister():
    """End a running job."""
    running = current()
    if running is not None:
        running.cancel("CubicCraft was disabled")
