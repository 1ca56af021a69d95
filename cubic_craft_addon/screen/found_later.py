# SPDX-License-Identifier: GPL-3.0-or-later
"""What takes too long to be found at each redraw: found when nothing is drawn for a moment."""

from collections.abc import Callable, Hashable
from functools import partial
from typing import Any, Generic, TypeVar

import bpy

T = TypeVar("T")

PAUSE = 0.2
"""seconds without a redraw that asks for it"""
_OUTDATED = object()  # no key is equal to it
_MOST = 2  # objects of which it is kept: windows may show different scenes


class FoundLater(Generic[T]):
    """Something about objects, kept until it has changed.

    Parameters
    ----------
    find : callable
        Finds it for an object; a timer calls it, outside of drawing.
    key_of : callable
        Returns what it depends on besides what `has_changed` is called for; this is cheap.
    redraw : callable
        Draws what shows it.
    """

    def __init__(
        self,
        find: Callable[[Any], T],
        key_of: Callable[[Any], Hashable],
        redraw: Callable[[], None],
    ):
        self._find, self._key_of, self._redraw = find, key_of, redraw
        self._known: dict[int, tuple[Hashable, T]] = {}
        """the key and what was found with it, by ``session_uid`` of the object"""
        self._waiting: Callable[[], None] | None = None

    @property
    def is_waiting(self) -> bool:
        """Whether something is going to be found."""
        return self._waiting is not None and bpy.app.timers.is_registered(self._waiting)

    @property
    def is_empty(self) -> bool:
        """Whether nothing is known that could be forgotten."""
        return not self._known

    def now(self, obj: bpy.types.Object, *, or_before: bool = False) -> T | None:
        """Return what is known about an object; None if it is going to be found.

        With `or_before`, what was known before it had to be found again is returned meanwhile.
        """
        known = self._known.get(obj.session_uid)
        if known is not None and known[0] == self._key_of(obj):
            return known[1]
        if self._waiting is not None and self.is_waiting:
            bpy.app.timers.unregister(self._waiting)
        window = bpy.context.window.as_pointer() if bpy.context.window else 0
        self._waiting = partial(self.find, obj.session_uid, window)
        bpy.app.timers.register(self._waiting, first_interval=PAUSE)
        return known[1] if known is not None and or_before else None

    def find(self, uid: int, window: int = 0) -> None:
        """Find it now, if the object is still there.

        Parameters
        ----------
        uid : int
            ``session_uid`` of the object.
        window : int
            Address of the window whose scene is meant, 0 for the present one.
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
        found = self._key_of(obj), self._find(obj)
        self._known.pop(obj.session_uid, None)
        while len(self._known) >= _MOST:
            del self._known[next(iter(self._known))]
        self._known[obj.session_uid] = found
        self._redraw()

    def has_changed(self, uid: int | None = None) -> None:
        """Have it found again for an object, or for all."""
        for each in self._known if uid is None else {uid} & self._known.keys():
            self._known[each] = _OUTDATED, self._known[each][1]

    def forget(self) -> None:
        """Forget everything, and find nothing that was asked for."""
        self._known.clear()
        if self._waiting is not None and self.is_waiting:
            bpy.app.timers.unregister(self._waiting)
        self._waiting = None
