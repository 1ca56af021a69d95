# SPDX-License-Identifier: GPL-3.0-or-later
"""Auto Orient: rotate the form of each selected mesh to fit its shape best."""

import bpy
from mathutils import Matrix

from .. import solver
from ..cubic_craft_addon import live
from ..cubic_craft_addon.object_properties import object_properties
from ..cubic_craft_addon.read.member import read_shape
from ..cubic_craft_addon.read.object_frame import angles_of, axes_of_angles, placement_alone
from ..cubic_craft_addon.settings.properties import settings_of
from ..solver import CubicCraftError
from ..solver.mesh.unit_box import unit_box
from ._shared.selection import poll_usable, report_all, selected_meshes
from ._shared.unexpected_errors import reporting


class CUBIC_CRAFT_OT_auto_orient(bpy.types.Operator):
    bl_idname = "cubic_craft.auto_orient"
    bl_label = "Auto Orient"
    bl_description = (
        "Rotate the form of each selected mesh so that as much of its original surface as possible"
        " faces a side"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return live.current() is not None or poll_usable(cls, context)

    @reporting
    def execute(self, context):
        session = live.current()
        if session is not None:
            for task in session.tasks[:1]:  # one orientation for all, that of the active object
                member = session.mesh_of(task.obj).member
                if member is not None:
                    angles = _best_angles(task.obj, task.settings, member.shape)
                    live.live_properties().orientation = angles
            return {"CANCELLED"}  # no undo step in the middle of Live
        found, problems = [], []
        for obj in selected_meshes(context):
            try:
                settings = settings_of(obj, handles=())
                found.append((obj, _best_angles(obj, settings, read_shape(obj, settings.start))))
            except CubicCraftError as error:
                problems.append(str(error))
        for obj, angles in found:
            object_properties(obj).orientation = angles
        names = ", ".join(obj.name for obj, _ in found)
        return report_all(self, f"Oriented {names}" if names else "", problems)


def _best_angles(obj, settings, shape):
    placement = placement_alone(obj, settings)
    V = placement.place(shape.original)
    areas, normals = solver.triangle_areas_and_normals(unit_box(V).to_unit(V), shape.triangles)
    if not placement.style.forms:
        return angles_of(obj, settings, solver.auto_orient(normals, areas))
    # In the axes of the angles, so that a mirrored object has its normals as they are seen.
    seen = normals @ axes_of_angles(obj, settings).T
    axes = solver.auto_orient(seen, areas, placement.style.forms[0]).T
    return Matrix(axes.tolist()).to_euler()
