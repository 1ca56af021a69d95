# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubify Animation: bake the cubic version of each frame, and play it back."""

from pathlib import Path

import bpy
from bpy.props import StringProperty

from ..cubic_craft_addon.animation.bake import Bake, BakeOptions
from ..cubic_craft_addon.animation.properties import BakeProperties, bake_properties, source_of
from ..cubic_craft_addon.animation.sources import OfSources, overrides_of
from ..solver import CubicCraftError
from ._shared.given_or_shared import given_or_shared
from ._shared.selection import poll_sources, selected_sources
from ._shared.watched_operator import WatchedOperator


class _BakeOperator(WatchedOperator, BakeProperties):
    is_process: bool

    @classmethod
    def poll(cls, context):
        return poll_sources(cls, context)

    def make_job(self, context):
        """Return the Bake of the selected objects, with the settings of the active one."""
        sources = list(dict.fromkeys(map(source_of, selected_sources(context))))
        if not sources:
            raise CubicCraftError("Select an object with a mesh first")
        return Bake(OfSources(sources), sources, self._options(context.scene))

    def _options(self, scene):
        values = given_or_shared(self, bake_properties(scene), BakeProperties)
        is_given = self.properties.is_property_set("frame_start")
        is_own = values["use_range"] or is_given or self.properties.is_property_set("frame_end")
        start, end = scene.frame_start, scene.frame_end
        if is_own:
            start, end = values["frame_start"], values["frame_end"]
        folder = values["folder"] or "//"
        if folder.startswith("//") and not bpy.data.filepath:
            raise CubicCraftError(
                "Save the .blend file first, or choose a folder that does not begin with //"
            )
        path = Path(bpy.path.abspath(folder))
        return BakeOptions(
            start, end, path, values["format"], self.is_process, self._process_from(scene)
        )

    def _process_from(self, scene):
        """Return the settings that a process begins with, None for the original."""
        return None


class CUBIC_CRAFT_OT_bake_animation(_BakeOperator, bpy.types.Operator):
    """Bake the cubic version of each frame of the selected objects."""

    bl_idname = "cubic_craft.bake_animation"
    bl_label = "Cubify Animation"
    bl_description = (
        "Make the visible mesh of the selected objects cubic in each frame, with armatures,"
        " simulations and other modifiers, as new objects that play it back. Esc keeps the frames"
        " that are done; the next bake continues there"
    )
    bl_options = {"UNDO"}
    is_process = False


class CUBIC_CRAFT_OT_bake_process(_BakeOperator, bpy.types.Operator):
    """Bake how the selected objects become cubic."""

    bl_idname = "cubic_craft.bake_process"
    bl_label = "Bake Process"
    bl_description = (
        "Make new objects that become cubic within the frames, at an even speed, from what the"
        " selected objects look like now. With shape keys, their Evaluation Time shows any"
        " moment of it"
    )
    bl_options = {"UNDO"}
    is_process = True

    process_from: StringProperty(
        name="From",
        description="Name of the object whose settings it begins with; empty for the original",
        options={"SKIP_SAVE"},
    )

    def _process_from(self, scene):
        chosen = bake_properties(scene).process_from
        if self.properties.is_property_set("process_from"):
            chosen = bpy.data.objects.get(self.process_from)
            if self.process_from and chosen is None:
                raise CubicCraftError(f'there is no object "{self.process_from}"')
        return None if chosen is None else overrides_of([chosen], is_for_all=True)
