# SPDX-License-Identifier: GPL-3.0-or-later
"""The angles to the form of the mesh that the panel shows, kept until they change.

Reading a mesh takes too long for each redraw, so its angles are kept until Blender reports that the
mesh has changed, or its form or orientation is another one.
"""

import bpy
from bpy.app.handlers import persistent

from .. import live
from ..environment import handlers
from ..environment.requirements import check_requirements
from ..read.object_frame import placement_alone
from ..screen.kept import Kept
from .measured import Angles, remaining_angles

_known: Kept[Angles] = Kept()
"""by the object, with what they were measured with as the key"""


def angles_now(obj: bpy.types.Object) -> Angles:
    """Return the angles of a mesh object as it is seen; the same ones until they change.

    Raises CubicCraftError: SciPy is missing, the form or its orientation is not defined, because an
    object is not set, or the object has no surface.
    """
    check_requirements()
    settings = live.settings_now(obj)
    placement = placement_alone(obj, settings)
    known = _known.get(obj.session_uid, placement.key)
    if known is not None:
        return known
    angles = remaining_angles(obj, placement, settings)
    return _known.keep(obj.session_uid, angles, placement.key)


@persistent
def _on_update(_scene, depsgraph):
    if not _known.is_empty:
        for uid in handlers.changed_shapes(depsgraph):
            _known.has_changed(uid)


@persistent
def forget(*_):
    """Measure the angles anew when they are asked for."""
    _known.forget()


_HANDLERS = (
    ("depsgraph_update_post", _on_update),
    ("frame_change_post", _on_update),
    ("undo_post", forget),
    ("redo_post", forget),
    ("load_post", forget),
)


def register():
    """Begin to listen to Blender."""
    handlers.install(_HANDLERS)


def unregister():
    """Listen no longer."""
    handlers.remove(_HANDLERS)
    forget()
