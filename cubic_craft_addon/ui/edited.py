# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel's message about a mesh that was edited by hand since it was cubified.

The check takes too long for each redraw, so its result is kept until Blender reports that a
mesh has changed, or may have changed.
"""

import bpy
from bpy.app.handlers import persistent

from ...solver import CubicCraftError
from .. import live, mesh_bridge
from ..environment import handlers
from ..object_properties import object_properties

_known: dict[int, bool] = {}
"""whether a mesh is edited, by its ``session_uid``"""


def draw(layout: bpy.types.UILayout, obj: bpy.types.Object) -> None:
    """Offer what to start from if the mesh of the object was edited; nothing while Live runs."""
    if live.current() is not None or obj.mode not in ("OBJECT", "WEIGHT_PAINT"):
        return
    if not is_edited(mesh_bridge.mesh_of(obj)):
        return
    box = layout.box()
    box.label(text="Edited since Cubify: start", icon="INFO")
    row = box.row()
    row.use_property_split = False
    row.prop(object_properties(obj), "start", expand=True)


def is_edited(mesh: bpy.types.Mesh) -> bool:
    """Return whether the mesh was edited since it was cubified, and its original is still there."""
    if not mesh_bridge.has_traces(mesh):
        return False
    if mesh.session_uid not in _known:
        try:
            _known[mesh.session_uid] = mesh_bridge.is_edited(mesh)
        except CubicCraftError:
            return False
    return _known[mesh.session_uid]


@persistent
def _on_update(_scene, depsgraph):
    for update in depsgraph.updates:
        if update.is_updated_geometry:
            # Also if the mesh itself is not named: our operator has changed the note.
            data = update.id.original
            mesh = data.data if isinstance(data, bpy.types.Object) else data
            if isinstance(mesh, bpy.types.Mesh):
                _known.pop(mesh.session_uid, None)


@persistent
def _forget(*_):
    _known.clear()


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
    _known.clear()
