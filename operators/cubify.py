# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubify: the selected meshes become cubic, in one click and one undo step.

Invariant: all objects are solved before the first is written, so that whatever goes wrong on the
way, nothing has changed.
"""

import logging
from dataclasses import fields, replace

import bpy
from bpy.props import StringProperty

from .. import solver
from ..cubic_craft_addon import cubify
from ..cubic_craft_addon.properties import RunProperties, object_properties, settings_of
from ..cubic_craft_addon.settings import Settings
from ..solver import CubicCraftError
from .selection import poll_meshes, report_all, selected_meshes

_PROGRESS_STEPS = 100

_log = logging.getLogger(__name__)

# Vertex groups belong to their object, so each object keeps its own unless a caller sets them.
_OF_EACH_OBJECT = ("pin_group", "map_group", "map_invert")
_SHARED = tuple(name for name in RunProperties.__annotations__ if name not in _OF_EACH_OBJECT)


class CUBIC_CRAFT_OT_cubify(RunProperties, bpy.types.Operator):
    """Turn the selected meshes into cubic sculptures; each starts from its original shape."""

    bl_idname = "cubic_craft.cubify"
    bl_label = "Cubify"
    bl_description = (
        "Turn the selected meshes into cubic sculptures, with the settings of the active one."
        " Each starts from its original shape"
    )
    bl_options = {"REGISTER", "UNDO", "PRESET"}

    frame: StringProperty(
        name="Frame",
        description="Name of the object whose axes are those of the cube",
        options={"SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, context):
        """There is a mesh to work on."""
        return poll_meshes(cls, context)

    def execute(self, context):
        """Solve all objects, then write all results."""
        self._adopt_settings(object_properties(selected_meshes(context)[0]))
        solved, problems = self._solve_all(context)
        written = []
        try:
            for obj, settings, solution in solved:
                target = cubify.write(obj, solution, settings.result)
                self._remember(obj, settings)
                object_properties(target).status = _status(solution)
                written.append(solution)
        except Exception as error:
            # The bridge has put this mesh back; what was written before needs its undo step.
            _log.exception("Writing a result failed")
            problems.append(f"Writing failed ({error}); the other objects are unchanged")
        return report_all(self, _summary(written), problems)

    def draw(self, context):
        """Draw the redo panel."""
        layout = self.layout
        layout.use_property_split = True
        layout.prop(self, "cubeness", slider=True)
        layout.prop(self, "space")
        if self.space == "FRAME":
            layout.prop_search(self, "frame", context.blend_data, "objects")
        for name in ("orientation", "rotation", "result"):
            layout.prop(self, name)
        for name in ("device", "max_iterations", "tolerance"):
            layout.prop(self, name)

    def _adopt_settings(self, source):
        """Take what the caller has not set from an object's settings; the redo panel shows it."""
        for name in _SHARED:
            if not self.properties.is_property_set(name):
                setattr(self, name, getattr(source, name))
        if not self.properties.is_property_set("frame") and source.frame is not None:
            self.frame = source.frame.name

    def _solve_all(self, context):
        """Return (object, settings, solution) for each mesh that could be solved, and problems."""
        solved, problems = [], []
        solutions = {}  # of meshes; one that several objects share is solved once
        objects = selected_meshes(context)
        manager = context.window_manager
        manager.progress_begin(0, _PROGRESS_STEPS * len(objects))
        try:
            for number, obj in enumerate(objects):
                is_again = obj.data in solutions
                try:
                    settings = self._settings(obj)
                    if not is_again:
                        solutions[obj.data] = _solve(
                            obj, settings, manager, number * _PROGRESS_STEPS
                        )
                except CubicCraftError as error:
                    problems.append(str(error))
                    continue
                if not is_again or settings.result == "NEW_OBJECT":
                    solved.append((obj, settings, solutions[obj.data]))
        finally:
            manager.progress_end()
        return solved, problems

    def _settings(self, obj):
        """Return the object's settings, overridden by what is set on the operator."""
        settings = settings_of(obj)
        is_set = self.properties.is_property_set
        plain = {field.name for field in fields(Settings)}
        changes = {
            name: getattr(self, name)
            for name in RunProperties.__annotations__
            if is_set(name) and name in plain
        }
        if is_set("orientation"):
            changes["orientation"] = tuple(self.orientation)
        if is_set("pin_group"):
            changes["pin_groups"] = (self.pin_group,) if self.pin_group else ()
        if is_set("frame"):
            frame = bpy.data.objects.get(self.frame)
            if self.frame and frame is None:
                raise CubicCraftError(f'there is no object "{self.frame}"; pick another frame')
            changes["frame"] = frame
        return replace(settings, **changes)

    def _remember(self, obj, settings):
        """Keep what has been used on the object, so that its panel shows how the shape was made."""
        properties = object_properties(obj)
        for name in (*RunProperties.__annotations__, "frame"):
            if not self.properties.is_property_set(name):
                continue
            value = settings.frame if name == "frame" else getattr(self, name)
            if getattr(properties, name) != value:
                setattr(properties, name, value)


def _solve(obj, settings, manager, offset):
    progress = solver.Progress(settings.max_iterations, settings.tolerance)

    def show(stylization):
        manager.progress_update(offset + round(_PROGRESS_STEPS * progress.update(stylization)))
        return False

    return cubify.solve(cubify.prepare(obj, settings), settings, show)


def _status(solution):
    r = solution.result
    end = "converged" if r.converged else "not converged, raise Max Iterations"
    return (
        f"{len(solution.positions):,} vertices, {r.iterations} iterations, energy"
        f" {r.energy.total:.5f}, {end}, {solution.seconds:.2f} s on {r.device}"
    )


def _summary(written):
    if not written:
        return ""
    if len(written) == 1:
        return f"Cubified: {_status(written[0])}"
    seconds = sum(solution.seconds for solution in written)
    return f"Cubified {len(written)} meshes in {seconds:.2f} s"
