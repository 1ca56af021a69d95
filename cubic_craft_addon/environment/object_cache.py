# SPDX-License-Identifier: GPL-3.0-or-later
"""What is made from other objects is kept until Blender reports a change of the object.

The panel asks for the form and the normal capture at each redraw, and reading a mesh of half a
million vertices takes a good part of a second. Whatever changes what the viewport shows of an
object is evaluated by the dependency graph, which then reports the object: edits, modifiers and
what they depend on, shape keys, transforms. After undo, on another frame and in another file,
everything is made anew.
"""

from collections.abc import Callable, Hashable
from hashlib import blake2b
from typing import Any, NamedTuple, TypeVar

import bpy
import numpy as np
from bpy.app.handlers import persistent

from . import handlers

T = TypeVar("T")

_MOST = 16  # things kept


class _Kept(NamedTuple):
    data: int
    """``session_uid`` of the object's data"""
    made: Any


_kept: dict[tuple, _Kept] = {}
"""by the object's ``session_uid``, the scene's, the view layer, and what the caller has named"""
_of_arrays: dict[tuple, Any] = {}


def kept(obj: bpy.types.Object, what: Hashable, make: Callable[[], T]) -> T:
    """Return what is made from an object, made only if the object may have changed.

    `what`: hashable, what is made, and all besides the evaluated geometry that it depends on.
    `make`: makes it; what this raises is raised each time.
    """
    depsgraph = bpy.context.evaluated_depsgraph_get()  # evaluates, which may report changes
    if not _is_watched(obj, depsgraph):
        return make()
    scene, layer = depsgraph.scene, depsgraph.view_layer
    key = (obj.session_uid, scene.session_uid, layer.name, what)
    data = obj.data.session_uid
    if key not in _kept or _kept[key].data != data:
        _put(_kept, key, _Kept(data, make()))
    return _kept[key].made


def once(make: Callable[..., T], *arrays: np.ndarray) -> T:
    """Return the same for the same arrays, which are not kept: they may be large."""
    key = make, *(blake2b(array.tobytes()).digest() for array in arrays)
    if key not in _of_arrays:
        _put(_of_arrays, key, make(*arrays))
    return _of_arrays[key]


def _put(values, key, value):
    values.pop(key, None)
    while len(values) >= _MOST:
        del values[next(iter(values))]
    values[key] = value


def _is_watched(obj, depsgraph):
    """Return whether changes of an object are reported: not of one that is in no scene or hidden.

    Others may have removed our handlers, too.
    """
    if not handlers.are_installed(_HANDLERS) or obj.data is None:
        return False
    return obj.evaluated_get(depsgraph).is_evaluated and obj.visible_get()


@persistent
def _on_update(_scene, depsgraph):
    if not _kept:
        return
    uids = {update.id.original.session_uid for update in depsgraph.updates}
    for key in [key for key, found in _kept.items() if key[0] in uids or found.data in uids]:
        del _kept[key]


@persistent
def _forget(*_):
    _kept.clear()


_HANDLERS = (
    ("depsgraph_update_post", _on_update),
    *((name, _forget) for name in ("frame_change_post", "undo_post", "redo_post")),
    *((name, _forget) for name in ("load_pre", "load_post")),
)


def register():
    """Add the handlers."""
    handlers.install(_HANDLERS)


def unregister():
    """Remove the handlers and forget everything."""
    handlers.remove(_HANDLERS)
    _kept.clear()
