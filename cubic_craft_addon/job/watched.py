# SPDX-License-Identifier: GPL-3.0-or-later
"""A job that is done in time slices, between which Blender draws and handles events.

The job is cancelled before Blender frees any of its data, by undo or by another file.
"""

from __future__ import annotations

import contextlib
import time
from collections.abc import Generator
from typing import Protocol

import bpy
from bpy.app.handlers import persistent

from ..environment import handlers
from ..run.failures import UNEXPECTED
from ..screen.redraw import draw_status, find_button_under_mouse, redraw_panels
from .job import Step

FIRST_SLICE = 0.7
"""seconds to work without a pause: most meshes are done by then, and nothing flickers"""
_SLICE = 0.05  # seconds per tick, plus the last phase of the solver
_TIMER_STEP = 0.01  # seconds between two ticks
_REDRAW_STEP = 0.1  # seconds between two redraws of the progress bar
_BAR_WIDTH = 12  # in units of the interface, wide enough for iteration and energy


class AnyJob(Protocol):
    """Work in steps, such as `Job`, that changes nothing before it is written."""

    cancel_text: str
    """what Esc does"""

    @property
    def obstacle(self) -> str:
        """Why it cannot continue after other code has run; or empty."""
        ...

    def steps(self) -> Generator[Step]:
        """Do the work."""
        ...

    def stop(self) -> bool:
        """End soon, so that what is done is written; return False if that is not possible."""
        ...

    def write(self, *, is_alone: bool) -> tuple[str, list[str]]:
        """Write the results, as `Job.write`."""
        ...

    def discard(self) -> None:
        """Remove what was made but not written."""
        ...


_current: WatchedJob | None = None


def current() -> WatchedJob | None:
    """Return the job that runs in the background, or None."""
    return _current


class WatchedJob:
    """A job in time slices.

    `step`: how far it has come. `is_solved`: whether only writing is left to do. `reason`: why it
    was cancelled, empty if the artist cancelled it; None if it was not cancelled.
    """

    def __init__(self, job: AnyJob):
        self._job: AnyJob | None = job
        self.cancel_text = job.cancel_text
        self._steps = job.steps()
        self._timer = None
        self._next_redraw = 0.0
        self.step = Step(("Preparing",), 0.0)
        self.is_solved = False
        self.reason: str | None = None

    def advance(self, seconds: float) -> None:
        """Work for a time slice, or until the next step takes so long that it must be announced."""
        deadline = time.perf_counter() + seconds
        for step in self._steps:
            self.step = step
            if step.is_long or time.perf_counter() >= deadline:
                return
        self.is_solved = True

    def watch(self, window: bpy.types.Window) -> None:
        """Show the progress, and make the window send the events for `tick`."""
        global _current
        _current = self
        handlers.install(_HANDLERS)
        self._timer = bpy.context.window_manager.event_timer_add(_TIMER_STEP, window=window)
        self._redraw()

    def tick(self) -> None:
        """Work for a time slice, unless it has become impossible."""
        assert self._job is not None
        obstacle = self._job.obstacle
        if obstacle:
            self.cancel(obstacle)
            return
        self.advance(_SLICE)
        if self.step.is_long or time.perf_counter() >= self._next_redraw:
            self._redraw()

    def write(self) -> tuple[str, list[str]]:
        """Write what was solved, as `Job.write`, and end."""
        assert self._job is not None
        is_alone = _current is not self
        try:
            return self._job.write(is_alone=is_alone)
        finally:
            self.close()
            if not is_alone:
                find_button_under_mouse()

    def stop(self) -> None:
        """Do what Esc does: cancel, or end soon with what is done."""
        if self._job is None or not self._job.stop():
            self.cancel()
            find_button_under_mouse()

    def cancel(self, reason: str = "") -> None:
        """Cancel; nothing has changed."""
        self.reason = reason
        self.close()

    def close(self) -> None:
        """Clean up."""
        global _current
        self._steps.close()
        if self._job is not None:
            with contextlib.suppress(*UNEXPECTED):  # written meshes need an undo step
                self._job.discard()
        self._job = None
        if _current is not self:
            return
        _current = None
        handlers.remove(_HANDLERS)
        if self._timer is not None:
            bpy.context.window_manager.event_timer_remove(self._timer)
        draw_status(None)
        redraw_panels()

    def _redraw(self) -> None:
        self._next_redraw = time.perf_counter() + _REDRAW_STEP
        draw_status(_draw_status)
        redraw_panels()


def _draw_status(header, _context):
    if _current is None:
        return
    layout = header.layout
    layout.label(text=_current.cancel_text, icon="EVENT_ESC")
    row = layout.row()
    row.ui_units_x = _BAR_WIDTH
    row.progress(text=_current.step.texts[0], factor=_current.step.factor)


@persistent
def _on_undo(*_):
    if _current is not None:
        _current.cancel("another step was undone or redone")


@persistent
def _on_load(*_):
    if _current is not None:
        _current.cancel("another file was opened")


_HANDLERS = (("undo_pre", _on_undo), ("redo_pre", _on_undo), ("load_pre", _on_load))
