# SPDX-License-Identifier: GPL-3.0-or-later
"""An operator whose work takes time: scripts wait for it, from the interface it is watched."""

import contextlib
from collections.abc import Callable
from typing import Any

import bpy

from ...cubic_craft_addon import job
from ...cubic_craft_addon.run.failures import UNEXPECTED
from .selection import report_all
from .unexpected_errors import reporting

_PROGRESS_STEPS = 100


class WatchedOperator:
    """Mix in before `bpy.types.Operator`; it has a method `make_job`."""

    bl_label: str
    properties: Any
    report: Any
    make_job: Callable[[Any], job.AnyJob]
    """returns the work to be done, of the context"""
    _watched: job.WatchedJob

    @reporting
    def execute(self, context):
        work = self.make_job(context)
        manager = context.window_manager
        manager.progress_begin(0, _PROGRESS_STEPS)
        try:
            for step in work.steps():
                manager.progress_update(round(_PROGRESS_STEPS * step.factor))
            return report_all(self, *work.write(is_alone=True))
        finally:
            # Written meshes need their undo step, even if the cleanup fails.
            with contextlib.suppress(*UNEXPECTED):
                work.discard()
            manager.progress_end()

    def invoke(self, context, event):
        """Do the same, in the background if it takes longer than a moment."""
        if bpy.app.background or context.window is None:  # nobody to watch it
            return self.execute(context)
        return self._start(context)

    def modal(self, context, event):
        """Continue or end; pass all other events to Blender, so that the view can be orbited."""
        if self._watched.reason is None and _is_to_cancel(event):
            self._watched.stop()
        if self._watched.reason is not None:
            return self._report_cancel()
        return self._tick(context) if event.type == "TIMER" else {"PASS_THROUGH"}

    def cancel(self, context):
        """Handle cancellation by Blender: another file, or the window was closed."""
        self._watched.cancel("the window was closed")

    @reporting
    def _start(self, context):
        self._watched = job.WatchedJob(self.make_job(context))
        try:
            self._watched.advance(job.FIRST_SLICE)
            if self._watched.is_solved:
                return report_all(self, *self._watched.write())
            self._watched.watch(context.window)
            # With its area: without it, Adjust Last Operation is not shown.
            context.window_manager.modal_handler_add(self)
        except BaseException:
            self._watched.close()
            raise
        return {"RUNNING_MODAL"}

    @reporting
    def _tick(self, context):
        watched = self._watched
        try:
            watched.tick()
            if watched.is_solved:
                return report_all(self, *watched.write())
        except BaseException:
            watched.close()
            raise
        return self._report_cancel() if watched.reason is not None else {"RUNNING_MODAL"}

    def _report_cancel(self):
        reason = self._watched.reason
        if reason:
            text = f"{self.bl_label} was cancelled, nothing has changed: {reason}"
            self.report({"WARNING"}, text)
        else:
            self.report({"INFO"}, f"{self.bl_label} was cancelled, nothing has changed")
        return {"CANCELLED"}


def _is_to_cancel(event):
    if event.value != "PRESS":
        return False
    is_undo = event.type == "Z" and (event.ctrl or event.oskey) and not (event.shift or event.alt)
    return is_undo or event.type == "ESC"
