# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubify: the selected meshes become cubic, in one click and one undo step.

Invariant: all objects are solved before the first is written, so that whatever goes wrong on the
way, nothing has changed.
"""

import logging

import bpy
from bpy.props import CollectionProperty, StringProperty

from ..cubic_craft_addon import cubify
from ..cubic_craft_addon.baked_pose import remember_pose, settle
from ..cubic_craft_addon.handle_owner import panel_object
from ..cubic_craft_addon.handle_properties import CubicCraftGivenHandle
from ..cubic_craft_addon.properties import RunProperties, object_properties
from ..solver import CubicCraftError
from .run_settings import adopt_settings, frame_of, remember_settings, uses_own_handles
from .selection import poll_usable, report_all, selected_meshes
from .tasks import plan, solve_all

_log = logging.getLogger(__name__)


class CUBIC_CRAFT_OT_cubify(RunProperties, bpy.types.Operator):
    """Turn the selected meshes into cubic sculptures; each starts from its original shape."""

    bl_idname = "cubic_craft.cubify"
    bl_label = "Cubify"
    bl_description = (
        "Turn the selected meshes into cubic sculptures, with the settings of the active one."
        " Each starts from its original shape"
    )
    bl_options = {"REGISTER", "UNDO"}

    frame: StringProperty(
        name="Frame",
        description="Name of the object whose axes are those of the cube",
        options={"SKIP_SAVE"},
    )
    handles: CollectionProperty(
        name="Handles",
        description="Handles in place of those of the objects",
        type=CubicCraftGivenHandle,
        options={"SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, context):
        """There is a mesh that can be cubified."""
        return poll_usable(cls, context)

    def execute(self, context):
        """Solve all objects, then write all results."""
        objects = selected_meshes(context)
        settle(objects)
        adopt_settings(self, objects)
        try:
            frame = frame_of(self, objects[0])
        except CubicCraftError as error:
            return report_all(self, "", [str(error)])
        tasks, problems = plan(self, objects, frame)
        solved, unsolved = solve_all(tasks, context.window_manager)
        problems += unsolved
        written = []
        try:
            for task in solved:
                target = cubify.write(task.obj, task.solution, task.settings.result)
                written.append(task.solution)
                is_posed = task.settings.result != "SHAPE_KEY" and uses_own_handles(self, task.obj)
                remember_pose(target, is_posed=is_posed)
                remember_settings(self, target, task.settings)
                object_properties(target).status = _status(task.solution)
        except Exception as error:
            # The bridge has put this mesh back; what was written before needs its undo step.
            _log.exception("Writing a result failed")
            problems.append(f"Writing failed ({error}); what was not written yet is unchanged")
        return report_all(self, _summary(written), problems)

    def draw(self, context):
        """Draw the redo panel."""
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "cubeness", slider=True)
        layout.prop(self, "space")
        if self.space == "FRAME":
            layout.prop_search(self, "frame", context.blend_data, "objects")
        layout.prop(self, "orientation")
        layout.prop(self, "rotation")
        layout.prop(self, "use_handles")
        groups = panel_object(context)
        if groups is not None:
            layout.prop_search(self, "map_group", groups, "vertex_groups", text="Cubeness Map")
            layout.prop(self, "map_invert")
        layout.prop(self, "result")
        for name in ("device", "max_iterations", "tolerance"):
            layout.prop(self, name)


def _status(solution):
    r = solution.result
    end = "converged" if r.converged else "not converged, raise Max Iterations"
    return (
        f"{len(solution.positions):,} vertices, {r.iterations} iterations, energy"
        f" {max(r.energy.total, 0.0):.5f}, {end}, {solution.total_seconds:.2f} s on {r.device}"
    )


def _summary(written):
    if not written:
        return ""
    if len(written) == 1:
        return f"Cubified: {_status(written[0])}"
    seconds = sum(solution.total_seconds for solution in written)
    return f"Cubified {len(written)} meshes in {seconds:.2f} s"
