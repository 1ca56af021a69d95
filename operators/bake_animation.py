# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubify Animation: bake the cubic version of each frame, and play it back."""

from pathlib import Path

import bpy

from ..cubic_craft_addon.animation.bake import Bake, BakeOptions
from ..cubic_craft_addon.animation.properties import BakeProperties, bake_settings, source_of
from ..cubic_craft_addon.animation.sources import settings_of_sources
from ..solver import CubicCraftError
from ._shared.selection import poll_sources, selected_sources
from ._shared.watched_operator import WatchedOperator


class CUBIC_CRAFT_OT_bake_animation(WatchedOperator, BakeProperties, bpy.types.Operator):
    bl_idname = "cubic_craft.bake_animation"
    bl_label = "Cubify Animation"
    bl_description = (
        "Make the visible mesh of the selected objects cubic in each frame, with armatures,"
        " simulations and other modifiers, as new objects that play it back. Esc keeps the frames"
        " that are done; the next bake continues there"
    )
    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, context):
        return poll_sources(cls, context)

    def make_job(self, context):
        """Return the Bake of the selected objects, with the settings of the active one."""
        sources = list(dict.fromkeys(map(source_of, selected_sources(context))))
        if not sources:
            raise CubicCraftError("Select an object with a mesh first")
        return Bake(settings_of_sources(sources), sources, self._options(context.scene))

    def _options(self, scene):
        values = bake_settings.given(self, scene)
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
        return BakeOptions(start, end, path, values["format"])
