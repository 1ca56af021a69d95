# SPDX-License-Identifier: GPL-3.0-or-later
"""What takes too long to be found at each redraw: kept for a few objects until they change.

A `FoundLater` finds it when nothing is drawn for a moment.
"""

from collections.abc import Callable, Hashable, Iterable
from functools import partial
from typing import Any, Generic, TypeVar
from weakref import WeakSet

import bpy
from bpy.app.handlers import persistent

from ..environment import handlers

T = TypeVar("T")

MOST = 2
"""objects of which it is kept: windows may show different scenes"""
PAUSE = 0.2
"""seconds without a redraw that asks for it"""
_OUTDATED = object()  # no key is equal to it


def changed_shapes(update: bpy.types.DepsgraphUpdate) -> Iterable[int]:
    """Return the ``session_uid`` of an object of which another shape is seen than before.

    Also where only one of its modifiers has changed.
    """
    data = update.id.original
    is_shape = isinstance(data, bpy.types.Object) and update.is_updated_geometry
    return (data.session_uid,) if is_shape else ()


class Kept(Generic[T]):
    """Something about objects or meshes, by their ``session_uid`` (int).

    `changed`: returns of what it has to be found again after an update of Blender's.
    """

    def __init__(self, changed: Callable[[Any], Iterable[int]] = changed_shapes):
        self.changed = changed
        self._known: dict[int, tuple[Hashable, T]] = {}
        """the key and what was found with it"""
        _all.add(self)

    @property
    def is_empty(self) -> bool:
        """Whether nothing is known that could be forgotten."""
        return not self._known

    @property
    def uids(self) -> Iterable[int]:
        """Of all that is known."""
        return list(self._known)

    def get(self, uid: int, key: Hashable = None) -> T | None:
        """Return what is known, if it was found with this key and nothing has changed since."""
        known = self._known.get(uid)
        return known[1] if known is not None and known[0] == key else None

    def before(self, uid: int) -> T | None:
        """Return what was known last, whatever has changed since."""
        known = self._known.get(uid)
        return None if known is None else known[1]

    def keep(self, uid: int, found: T, key: Hashable = None) -> T:
        """Keep and return what was found, and forget what was kept longest if it is too much.

        The key is what it depends on besides what Blender reports.
        """
        self._known.pop(uid, None)
        while len(self._known) >= MOST:
            del self._known[next(iter(self._known))]
        self._known[uid] = key, found
        return found

    def has_changed(self, uids: Iterable[int]) -> None:
        """Have it found again for some of them."""
        for each in self._known.keys() & uids:
            self._known[each] = _OUTDATED, self._known[each][1]

    def forget(self) -> None:
        """Forget everything."""
        self._known.clear()


_all: WeakSet[Kept] = WeakSet()


@persistent
def _on_update(_scene, depsgraph):
    for kept in [each for each in _all if not each.is_empty]:
        for update in depsgraph.updates:
            kept.has_changed(kept.changed(update))


@persistent
def _on_other_data(*_):
    for kept in _all:
        kept.has_changed(kept.uids)


@persistent
def _forget(*_):
    for kept in _all:
        kept.forget()


_HANDLERS = (
    *((name, _on_update) for name in ("depsgraph_update_post", "frame_change_post")),
    *((name, _on_other_data) for name in ("undo_post", "redo_post")),
    ("load_post", _forget),
)


def register():
    """Begin to listen to Blender."""
    handlers.install(_HANDLERS)


def unregister():
    """Listen no longer."""
    handlers.remove(_HANDLERS)
    _forget()


class FoundLater(Kept[T]):
    """Something about objects, kept until it has changed.

    `find`: finds it for an object; a timer calls it, outside of drawing. `key_of`: returns what it
    depends on besides what Blender reports; this is cheap. `redraw`: draws what shows it.
    `changed`: as of `Kept`.
    """

    def __init__(
        self,
        find: Callable[[Any], T],
        key_of: Callable[[Any], Hashable],
        redraw: Callable[[], None],
        changed: Callable[[Any], Iterable[int]] = changed_shapes,
    ):
        super().__init__(changed)
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
