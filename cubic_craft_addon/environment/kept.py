# SPDX-License-Identifier: GPL-3.0-or-later
"""What takes too long to be found at each redraw: kept for a few objects until they change.

A `FoundLater` finds it when nothing is drawn for a moment, and `KeptFrom` keeps what is made from
other objects.
"""

from collections.abc import Callable, Hashable, Iterable
from functools import partial
from hashlib import blake2b
from typing import Any, Generic, TypeVar
from weakref import WeakSet

import bpy
import numpy as np
from bpy.app.handlers import persistent

from . import handlers

T = TypeVar("T")

MOST = 2
"""objects of which it is kept: windows may show different scenes"""
MOST_MADE = 16
"""things that are made from other objects, of a kind"""
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

    most = MOST
    """of them"""

    def __init__(self, changed: Callable[[Any], Iterable[int]] = changed_shapes):
        self.changed = changed
        self._known: dict[int, tuple[Hashable, T]] = {}
        """the key and what was found with it"""
        _all.add(self)

    @property
    def uids(self) -> Iterable[int]:
        """Of all that is known."""
        return list(self._known)

    def get(self, uid: int, key: Hashable = None) -> T | None:
        """Return what is known, if it was found with this key and nothing has changed since."""
        known = self._known.get(uid)
        return known[1] if known is not None and known[0] == key else None

    def keep(self, uid: int, found: T, key: Hashable = None) -> T:
        """Keep and return what was found, and forget what was kept longest if it is too much.

        The key is what it depends on besides what Blender reports.
        """
        _put(self._known, uid, (key, found), self.most)
        return found

    def made(self, uid: int, make: Callable[[], T], key: Hashable = None) -> T:
        """Return what is known, or else make and keep it; what making raises is raised each time.

        `key`: as of `keep`.
        """
        known = self.get(uid, key)
        return self.keep(uid, make(), key) if known is None else known

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
    for kept in [each for each in _all if each.uids]:
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

    def now(self, obj: bpy.types.Object) -> T | None:
        """Return what is known about an object; None if it is going to be found."""
        known = self.get(obj.session_uid, self._key_of(obj))
        if known is not None:
            return known
        if self._waiting is not None and self.is_waiting:
            bpy.app.timers.unregister(self._waiting)
        window = bpy.context.window.as_pointer() if bpy.context.window else 0
        self._waiting = partial(self.find, obj.session_uid, window)
        bpy.app.timers.register(self._waiting, first_interval=PAUSE)
        return None

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


class KeptFrom(Kept[T]):
    """What is made from other objects, kept until Blender reports a change of the object.

    The panel asks for the form at each redraw, and reading a mesh of half a
    million vertices takes a good part of a second. Whatever changes what the viewport shows of an
    object is evaluated by the dependency graph, which then reports the object: edits, modifiers and
    what they depend on, shape keys, transforms.
    """

    most = MOST_MADE

    def __init__(self):
        super().__init__(lambda update: (update.id.original.session_uid,))

    def of(self, obj: bpy.types.Object, make: Callable[[], T], key: Hashable = None) -> T:
        """Return what is made from an object, made only if the object may have changed.

        `key`: all besides the evaluated geometry that it depends on.
        """
        depsgraph = bpy.context.evaluated_depsgraph_get()  # evaluates, which may report changes
        if not _is_watched(obj, depsgraph):
            return make()
        place = depsgraph.scene.session_uid, depsgraph.view_layer.name, obj.data.session_uid
        return self.made(obj.session_uid, make, (place, key))


def _is_watched(obj, depsgraph):
    """Return whether changes of an object are reported: not of one that is in no scene or hidden.

    Others may have removed our handlers, too.
    """
    are_called = all(handler in getattr(bpy.app.handlers, name) for name, handler in _HANDLERS)
    if not are_called or obj.data is None:
        return False
    return obj.evaluated_get(depsgraph).is_evaluated and obj.visible_get()


_of_arrays: dict[tuple, Any] = {}


def once(make: Callable[..., T], *arrays: np.ndarray) -> T:
    """Return the same for the same arrays, which are not kept: they may be large."""
    key = make, *(blake2b(array.tobytes()).digest() for array in arrays)
    if key not in _of_arrays:
        _put(_of_arrays, key, make(*arrays), MOST_MADE)
    return _of_arrays[key]


def _put(values, key, value, most):
    """Set a value of a dict, without those that were set first if it is too much."""
    values.pop(key, None)
    while len(values) >= most:
        del values[next(iter(values))]
    values[key] = value
