# SPDX-License-Identifier: GPL-3.0-or-later
"""Notice the operators that push undo steps, also those that do not matter to Live."""

import bpy

from .history import History


class UndoSteps:
    """What tells when the artist has done something that Blender can undo."""

    def __init__(self):
        self._last = _last_step()

    def tell(self, history: History) -> None:
        """Tell a history if there is another last step than when it was told before."""
        before, self._last = self._last, _last_step()
        if self._last not in (before, 0):
            history.record_outside()


def _last_step():
    """Return what tells the last operator with an undo step from others, 0 for none."""
    steps = [op for op in bpy.context.window_manager.operators if "UNDO" in op.bl_options]
    return steps[-1].as_pointer() if steps else 0
