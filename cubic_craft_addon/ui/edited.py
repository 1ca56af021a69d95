# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel's message about a result that was edited by hand, and what to start from.

The check takes too long for each redraw, so its result is kept until Blender reports that a
mesh has changed, or may have changed.
"""

from collections.abc import Iterable
from functools import partial
from typing import Any

import bpy

from ...solver import CubicCraftError
from .. import live, mesh_bridge
from ..environment.kept import Kept
from ..environment.modes import MODES
from ..object_properties import object_properties
from ..run.posed_anew import is_posed_anew
from ..screen.text_fit import draw_wrapped

_REPLACED = "This shape replaces the original. Restore First brings that back until Apply"
_LOST = (
    "New vertices were moved by hand, so that the original can no longer be determined: Cubify"
    " starts from here"
)
_POSED = (
    "Posed anew since the last run: From Here starts from this pose, the others from the former"
)
_BOX = 1.0  # width of an icon, that a box takes from a line


def _changed_meshes(update: Any) -> tuple[int, ...]:
    """Return the mesh of an object, too: our operator may have changed its note alone."""
    data = update.id.original
    mesh = data.data if isinstance(data, bpy.types.Object) else data
    is_changed = isinstance(mesh, bpy.types.Mesh) and update.is_updated_geometry
    return (mesh.session_uid,) if is_changed else ()


def _changed_poses(update: Any) -> Iterable[int]:
    is_rig = isinstance(update.id, bpy.types.Armature) and update.is_updated_geometry
    return _posed.uids if is_rig else _changed_meshes(update)


_edited: Kept[bool] = Kept(_changed_meshes)
_lost: Kept[bool] = Kept(_changed_meshes)
_posed: Kept[bool] = Kept(_changed_poses)
"""by the mesh"""


def draw(context: bpy.types.Context, layout: bpy.types.UILayout, obj: bpy.types.Object) -> None:
    """Offer what to start from if the mesh of the object was edited; nothing while Live runs."""
    if live.current() is not None or obj.mode not in MODES:
        return
    mesh = mesh_bridge.mesh_of(obj)
    if is_lost(mesh):
        draw_wrapped(context, layout.box(), _LOST, taken=_BOX)
        return
    if not (mesh_bridge.has_strokes(mesh) or is_edited(mesh)):  # also edits of earlier results
        return
    properties = object_properties(obj)
    box = layout.box()
    box.label(text="Edited by hand: start", icon="INFO")
    column = box.column(align=True)  # side by side, three names would not fit
    column.use_property_split = False
    column.prop(properties, "start", expand=True)
    if properties.start == "HERE":
        draw_wrapped(context, box, _REPLACED, taken=_BOX)
    elif _found_out(mesh, _posed, lambda _: is_posed_anew(obj)):
        draw_wrapped(context, box, _POSED, taken=_BOX)


def is_edited(mesh: bpy.types.Mesh) -> bool:
    """Return whether the mesh was edited since it was cubified, and its original is still there."""
    return _found_out(mesh, _edited, mesh_bridge.is_edited)


def is_lost(mesh: bpy.types.Mesh) -> bool:
    """Return whether the original of the mesh can no longer be determined."""
    return _found_out(mesh, _lost, mesh_bridge.is_lost)


def _found_out(mesh, kept, find_out):
    if not mesh_bridge.has_traces(mesh):
        return False
    try:
        return kept.made(mesh.session_uid, partial(find_out, mesh))
    except CubicCraftError:
        return False
