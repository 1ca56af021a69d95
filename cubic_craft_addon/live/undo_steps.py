# SPDX-License-Identifier: GPL-3.0-or-later
"""Detect operators that push undo steps, including those that do not affect Live."""

import bpy

from .history import History


class UndoSteps:
    """Detects when the artist has done something that Blender can undo."""

    def __init__(self):
        self._last = _last_step()

    def tell(self, history: History) -> None:
        """Notify a history if the last step has changed since the last call."""
        before, self._last = self._last, _last_step()
        if self._last not in (before, 0):
            history.record_outside()


def _last_step():
    """Return an identifier of the last operator with an undo step, 0 for none."""
    steps = [op for op in bpy.context.window_manager.operators if "UNDO" in op.bl_options]
    return steps[-1].as_pointer() if steps else 0
