# SPDX-License-Identifier: GPL-3.0-or-later
"""What Ctrl-Z undoes while Live runs. Without Blender.

The settings of Live are not in Blender's undo stack, what the artist does beside them is: moved
handles, strokes on the cubeness map. Ctrl-Z undoes whichever came last.
"""

from enum import Enum, auto
from typing import Any

PAUSE = 0.5
"""seconds; changes of the same settings with shorter pauses are one drag"""


class TakeBack(Enum):
    """What Ctrl-Z does if there are no settings to go back to."""

    LIVE = auto()
    """end Live: nothing has been done in it"""
    BLENDER = auto()
    """let Blender undo its last step"""


class History:
    """The previous settings.

    `values`: the settings at the start.
    """

    def __init__(self, values: dict[str, Any]):
        self._values = values
        self._earlier: list[dict[str, Any]] = []
        self._last = (frozenset(), float("-inf"))
        self._is_outside = False

    def record(self, values: dict[str, Any], now: float) -> None:
        """Record the current settings, at a time in seconds."""
        changed = frozenset(name for name in values if values[name] != self._values.get(name))
        if not changed:
            return
        names, time = self._last
        if not (changed == names and now - time < PAUSE and self._earlier):
            self._earlier.append(self._values)
        self._values = values
        self._last = (changed, now)

    def cut(self) -> None:
        """Make the next change a separate step, however soon it comes."""
        self._last = (frozenset(), float("-inf"))

    def record_outside(self) -> None:
        """Record another change, which is in Blender's undo stack."""
        self._earlier.clear()
        self._is_outside = True

    def record_undo(self, is_outside: bool) -> None:
        """Record that Blender has undone or redone a step.

        `is_outside`: whether Blender's state is one from after the start of Live.
        """
        self._is_outside = is_outside

    def take_back(self) -> dict[str, Any] | TakeBack:
        """Return the settings to go back to, or what else to do."""
        if self._earlier:
            self._values = self._earlier.pop()
            self.cut()
            return self._values
        return TakeBack.BLENDER if self._is_outside else TakeBack.LIVE
