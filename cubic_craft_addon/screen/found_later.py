# SPDX-License-Identifier: GPL-3.0-or-later
"""What takes too long to be found at each redraw: found when nothing is drawn for a moment."""

from collections.abc import Callable, Hashable
from functools import partial
from typing import Any

import bpy

from .kept import Kept, T

PAUSE = 0.2
"""seconds without a redraw that asks for it"""


class FoundLater(Kept[T]):
    """Something about objects, kept until it has changed.

    `find`: finds it for an object; a timer calls it, outside of drawing. `key_of`: returns what it
    depends on besides what `has_changed` is called for; this is cheap. `redraw`: draws what shows
    it.
    """

    def __init__(
        self,
        find: Callable[[Any], T],
        key_of: Callable[[Any], Hashable],
        redraw: Callable[[], None],
    ):
        super().__init__()
        self._find, self._key_of, self._redraw = find, key_of, redraw
        self._waiting: Callable[[], None] | None = None

    @property
    def is_waiting(self) -> bool:
        """Whether something is going to be found."""
        return self._waiting is not None and bpy.app.timers.is_registered(self._waiting)

    def now(self, obj: bpy.types.Object, *, or_before: bool = False) -> T | None:
        """Return what is known about an object; None if it is going to be found.

        With `or_before`, what was known before it had to be found again is returned meanwhile.
        """
        known = self.get(obj.session_uid, self._key_of(obj))
        if known is not None:
            return known
        if self._waiting is not None and self.is_waiting:
            bpy.app.timers.unregister(self._waiting)
        window = bpy.context.window.as_pointer() if bpy.context.window else 0
        self._waiting = partial(self.find, obj.session_uid, window)
        bpy.app.timers.register(self._waiting, first_interval=PAUSE)
        return self.before(obj.session_uid) if or_before else None

    def find(self, uid: int, window: int = 0) -> None:
        """Find it now, if the object is still there.

        `uid`: ``session_uid`` of the object. `window`: address of the window whose scene is meant,
        0 for the present one.
        """
        obj = next((obj for obj in bpy.data.objects if obj.session_uid == uid), None)
        if obj is None:
            return
        windows = {each.as_pointer(): each for each in bpy.context.window_manager.windows}
        if window not in windows:
            self._find_in_scene(obj)
            return
        with bpy.context.temp_override(window=windows[window]):
            self._find_in_scene(obj)

    def _find_in_scene(self, obj):
        key = self._key_of(obj)
        self.keep(obj.session_uid, self._find(obj), key)
        self._redraw()

    def forget(self) -> None:
        """Forget everything, and find nothing that was asked for."""
        super().forget()
        if self._waiting is not None and self.is_waiting:
            bpy.app.timers.unregister(self._waiting)
        self._waiting = None
