# SPDX-License-Identifier: GPL-3.0-or-later
"""Select Crossing Faces: where surfaces of results cross that did not before, in Edit Mode."""

import bpy

from ..cubic_craft_addon import mesh_bridge
from ..cubic_craft_addon.environment.requirements import check_requirements
from ..cubic_craft_addon.measure.crossing_faces import crossing_faces
from ..solver import CubicCraftError
from ._shared.selection import poll_any_usable, poll_meshes, report_all, selected_meshes
from ._shared.unexpected_errors import reporting


class CUBIC_CRAFT_OT_select_crossing(bpy.types.Operator):
    """Select the faces that cross others in the results, and did not before."""

    bl_idname = "cubic_craft.select_crossing"
    bl_label = "Select Crossing Faces"
    bl_description = (
        "Show in Edit Mode which faces of the selected cubic meshes cross others that they did not"
        " cross in the original"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if not poll_meshes(cls, context):
            return False
        objects = _results(context)
        return poll_any_usable(cls, objects, "The mesh has no result; cubify it first")

    @reporting
    def execute(self, context):
        check_requirements()
        usable, problems = [], []
        for obj in _results(context):
            try:
                mesh_bridge.check_editable(obj)
            except CubicCraftError as error:
                problems.append(str(error))
            else:
                usable.append(obj)
        found = crossing_faces(usable) if usable else {}
        shown = {
            obj: mesh_bridge.not_hidden(mesh_bridge.mesh_of(obj), faces)
            for obj, faces in found.items()
        }
        shown = {obj: faces for obj, faces in shown.items() if len(faces)}
        if not shown:
            if found:
                problems.append("The faces that cross are hidden; reveal them in Edit Mode first")
            elif usable:
                problems.append("No face crosses one that it did not cross in the original")
            return report_all(self, "", problems)
        _edit(context, list(shown))
        for obj, faces in shown.items():
            mesh_bridge.select_faces(mesh_bridge.mesh_of(obj), faces)
        count = sum(map(len, shown.values()))
        return report_all(self, f"{count:,} crossing faces are selected", problems)


def _results(context):
    objects = [obj for obj in selected_meshes(context) if mesh_bridge.last_run(obj) is not None]
    return list({obj.data: obj for obj in reversed(objects)}.values())[::-1]


def _edit(context, objects):
    if context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    for obj in context.selected_objects:
        if obj not in objects:
            obj.select_set(False)
    if context.view_layer.objects.active not in objects:
        context.view_layer.objects.active = objects[0]
    bpy.ops.object.mode_set(mode="EDIT")
    context.tool_settings.mesh_select_mode = (False, False, True)
    bpy.ops.mesh.select_all(action="DESELECT")
