# SPDX-License-Identifier: GPL-3.0-or-later
"""Directions from Selection: the sides of the form face as the selected faces do.

It leaves Edit Mode, because the undo steps of Edit Mode hold only the mesh: the form would remain
after an undo. A single undo then reverts everything, back into Edit Mode.
"""

import bpy

from ..cubic_craft_addon import live
from ..cubic_craft_addon.form.body import picked_directions
from ..cubic_craft_addon.form.direction_text import write_directions
from ..cubic_craft_addon.handles.owner import panel_object
from ..cubic_craft_addon.object_properties import object_properties
from ..cubic_craft_addon.read.object_frame import stretch_and_orientation
from ..cubic_craft_addon.settings.properties import settings_of
from ._shared.selection import poll_mesh, refuse, report_all
from ._shared.unexpected_errors import reporting


class CUBIC_CRAFT_OT_form_from_selection(bpy.types.Operator):
    bl_idname = "cubic_craft.form_from_selection"
    bl_label = "Directions from Selection"
    bl_description = (
        "Make the faces that are selected in Edit Mode the sides of the form. Similar directions"
        " count as one; where the form would be open, the opposite ones are added"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if live.current() is not None:
            return refuse(cls, "Confirm or cancel Live first")
        if context.mode != "EDIT_MESH":
            return refuse(cls, "Switch to Edit Mode and select faces first")
        return poll_mesh(cls, context, ("EDIT_MESH",))

    @reporting
    def execute(self, context):
        obj = panel_object(context)
        frame = stretch_and_orientation(obj, settings_of(obj, handles=()))
        directions, count = picked_directions(obj, *frame)
        bpy.ops.object.mode_set(mode="OBJECT")
        properties = object_properties(obj)
        properties.form_directions = write_directions(directions)
        properties.form = "FACES"
        faces = "1 face" if count == 1 else f"{count} faces"
        return report_all(self, f"The form has {len(directions)} directions from {faces}", [])
