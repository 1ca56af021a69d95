# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel's message about a result that was edited by hand, and what to start from.

The check takes too long for each redraw, so its result is kept until Blender reports that a
mesh has changed, or may have changed.
"""

import bpy
from bpy.app.handlers import persistent

from ...solver import CubicCraftError
from .. import live, mesh_bridge
from ..environment import handlers
from ..environment.modes import MODES
from ..object_properties import object_properties
from ..run.posed_anew import is_posed_anew
from ..screen.kept import Kept
from ..screen.text_fit import room_for_text, wrapped

_REPLACED = "This shape replaces the original. Restore First brings that back until Apply"
_LOST = (
    "New vertices were moved by hand, so that the original can no longer be determined: Cubify"
    " starts from here"
)
_POSED = (
    "Posed anew since the last run: From Here starts from this pose, the others from the former"
)
_BOX = 1.0  # width of an icon, that a box takes from a line

_edited: Kept[bool] = Kept()
_lost: Kept[bool] = Kept()
_posed: Kept[bool] = Kept()
"""by the mesh"""


def draw(context: bpy.types.Context, layout: bpy.types.UILayout, obj: bpy.types.Object) -> None:
    """Offer what to start from if the mesh of the object was edited; nothing while Live runs."""
    if live.current() is not None or obj.mode not in MODES:
        return
    mesh = mesh_bridge.mesh_of(obj)
    if is_lost(mesh):
        _draw_text(context, layout.box(), _LOST)
        return
    if not has_edits(mesh):
        return
    properties = object_properties(obj)
    box = layout.box()
    box.label(text="Edited by hand: start", icon="INFO")
    column = box.column(align=True)  # side by side, three names would not fit
    column.use_property_split = False
    column.prop(properties, "start", expand=True)
    if properties.start == "HERE":
        _draw_text(context, box, _REPLACED)
    elif _found_out(mesh, _posed, lambda _: is_posed_anew(obj)):
        _draw_text(context, box, _POSED)


def has_edits(mesh: bpy.types.Mesh) -> bool:
    """Return whether the result was edited by hand, or has edits of earlier ones in it."""
    return mesh_bridge.has_strokes(mesh) or is_edited(mesh)


def is_edited(mesh: bpy.types.Mesh) -> bool:
    """Return whether the mesh was edited since it was cubified, and its original is still there."""
    return _found_out(mesh, _edited, mesh_bridge.is_edited)


def is_lost(mesh: bpy.types.Mesh) -> bool:
    """Return whether the original of the mesh can no longer be determined."""
    return _found_out(mesh, _lost, mesh_bridge.is_lost)


def _found_out(mesh, kept, find_out):
    if not mesh_bridge.has_traces(mesh):
        return False
    known = kept.get(mesh.session_uid)
    if known is not None:
        return known
    try:
        return kept.keep(mesh.session_uid, find_out(mesh))
    except CubicCraftError:
        return False


def _draw_text(context, layout, text):
    for line in wrapped(text, room_for_text(context, _BOX)):
        layout.label(text=line)


@persistent
def _on_update(_scene, depsgraph):
    for update in depsgraph.updates:
        if update.is_updated_geometry:
            # Also if the mesh itself is not named: our operator has changed the note.
            data = update.id.original
            mesh = data.data if isinstance(data, bpy.types.Object) else data
            if isinstance(mesh, bpy.types.Mesh):
                _edited.has_changed(mesh.session_uid)
                _lost.has_changed(mesh.session_uid)
                _posed.has_changed(mesh.session_uid)
            elif isinstance(data, bpy.types.Armature):
                _posed.forget()


@persistent
def _forget(*_):
    _edited.forget()
    _lost.forget()
    _posed.forget()


_HANDLERS = (
    ("depsgraph_update_post", _on_update),
    ("undo_post", _forget),
    ("redo_post", _forget),
    ("load_post", _forget),
)


def register():
    """Begin to listen to Blender."""
    handlers.install(_HANDLERS)


def unregister():
    """Listen no longer."""
    handlers.remove(_HANDLERS)
    _forget()
