# SPDX-License-Identifier: GPL-3.0-or-later
"""The hint that clothes lie on the mesh without being selected, so that they would be left behind.

What lies on it is found when nothing is drawn for a moment, and kept until anything in the scene
has moved.
"""

from collections.abc import Iterable
from typing import Any

import bpy

from .. import job, live
from ..environment.kept import FoundLater
from ..object_properties import object_properties
from ..screen.redraw import redraw_panels
from ..screen.text_fit import draw_wrapped
from .found import worn_by

_NAMED = 2
"""objects that are named; of more, the number is told"""


def _names_worn_by(obj: Any) -> tuple[str, ...]:
    if live.current() or job.current():
        return ()
    return tuple(other.name for other in worn_by(obj))


def _changed(update: Any) -> Iterable[int]:
    # A scene or a collection: something was added, hidden or selected.
    is_set = isinstance(update.id, (bpy.types.Scene, bpy.types.Collection))
    return _worn.uids if is_set or update.is_updated_transform or update.is_updated_geometry else ()


_worn = FoundLater(
    _names_worn_by, lambda obj: bool(live.current() or job.current()), redraw_panels, _changed
)


def left_out(obj: bpy.types.Object) -> list[str]:
    """Return the names of what lies on an object and is not selected, as far as it is known."""
    is_together = object_properties(obj).together == "SELECTION"
    if not is_together or obj.mode != "OBJECT" or live.current() or job.current():
        return []
    objects = bpy.context.view_layer.objects
    found = [objects.get(name) for name in _worn.now(obj, or_before=True) or ()]
    return [other.name for other in found if other is not None and not other.select_get()]


def sentence(names: list[str]) -> str:
    """Return what is said about the objects of these names."""
    if len(names) > _NAMED:
        return f"{names[0]} and {len(names) - 1} more meshes lie on it and are not selected"
    verb, be = ("lies", "is") if len(names) == 1 else ("lie", "are")
    return f"{' and '.join(names)} {verb} on it and {be} not selected"


def draw(context: bpy.types.Context, layout: Any, obj: bpy.types.Object) -> None:
    """Say what is left out, and offer to select it, too."""
    names = left_out(obj)
    if not names:
        return
    box = layout.box()
    draw_wrapped(context, box.column(align=True), sentence(names), "INFO")
    box.operator("cubic_craft.select_worn", icon="RESTRICT_SELECT_OFF")
