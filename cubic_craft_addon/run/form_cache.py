# SPDX-License-Identifier: GPL-3.0-or-later
"""The forms of other objects are kept until Blender reports a change of the object.

The panel asks for the form at each redraw, and reading a mesh of half a million vertices takes a
good part of a second. Whatever changes what the viewport shows of an object is evaluated by the
dependency graph, which then reports the object: edits, modifiers and what they depend on, shape
keys, transforms. Undo, another frame and another file make all forms anew.
"""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

from collections.abc import Callable, Hashable
from typing import NamedTuple

import bpy
from bpy.app.handlers import persistent

from ...solver.styles.polytope import Polytope

_MOST = 16  # forms kept


class _Kept(NamedTuple):
    data: int
    """``session_uid`` of the object's data"""
    form: Polytope


_forms: dict[tuple, _Kept] = {}
"""by the object's ``session_uid``, the scene's, the view layer, and what the caller has named"""


def form_kept(obj: bpy.types.Object, what: Hashable, make: Callable[[], Polytope]) -> Polytope:
    """Return the form of an object, made only if the object may have changed.

    Parameters
    ----------
    obj
    what : hashable
        All besides the evaluated geometry that the form depends on.
    make : callable
        Makes the form; what it raises is raised each time.
    """
    depsgraph = bpy.context.evaluated_depsgraph_get()  # evaluates, which may report changes
    if not _is_watched(obj, depsgraph):
        return make()
    scene, layer = depsgraph.scene, depsgraph.view_layer
    key = (obj.session_uid, scene.session_uid, layer.name, what)
    data = obj.data.session_uid
    kept = _forms.get(key)
    if kept is None or kept.data != data:
        form = make()
        while len(_forms) >= _MOST:
            del _forms[next(iter(_forms))]
        kept = _forms[key] = _Kept(data, form)
    return kept.form


def _is_watched(obj, depsgraph):
    """Return whether changes of an object are reported: not of one that is in no scene or hidden.

    Others may have removed our handlers, too.
    """
    installed = all(handler in getattr(bpy.app.handlers, name) for name, handler in _HANDLERS)
    if not installed or obj.data is None:
        return False
    return obj.evaluated_get(depsgraph).is_evaluated and obj.visible_get()


@persistent
def _on_update(_scene, depsgraph):
    if not _forms:
        return
    uids = {update.id.original.session_uid for update in depsgraph.updates}
    for key in [key for key, kept in _forms.items() if key[0] in uids or kept.data in uids]:
        del _forms[key]


@persistent
def _forget(*_):
    _forms.clear()


_HANDLERS = (
    ("depsgraph_update_post", _on_update),
    *((name, _forget) for name in ("frame_change_post", "undo_post", "redo_post")),
    *((name, _forget) for name in ("load_pre", "load_post")),
)


def register():
    """Add the handlers."""
    for name, handler in _HANDLERS:
        getattr(bpy.app.handlers, name).append(handler)


def unregister():
    """Remove the handlers and forget all forms."""
    for name, handler in _HANDLERS:
        installed = getattr(bpy.app.handlers, name)
        if handler in installed:
            installed.remove(handler)
    _forms.clear()
