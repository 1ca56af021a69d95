# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings with which the objects of an animation are cubified."""

import re
from collections.abc import Sequence

import bpy

from ..environment.curves import animated_paths
from ..object_properties import PROPERTY, has_properties, object_properties
from ..settings.overrides import OF_EACH_OBJECT, SettingsOverrides, asked_for, values_of
from ..settings.values import SETTINGS, Settings
from .animated import FrameSettings

OF_ALL_FRAMES = tuple(name for name, each in SETTINGS.items() if each.is_of_all_frames)
"""settings that determine which vertices are solved, which a sequence of frames has in common"""
_SETTING = re.compile(rf"{PROPERTY}\.(\w+)")


def settings_of_sources(sources: Sequence[bpy.types.Object]) -> FrameSettings:
    """Return what gives the settings of some objects, which is asked anew in each frame.

    Those of the first are for all, except those that belong to each mesh. A single object has its
    own settings, unless others have them, too.
    """

    def settings_for(obj: bpy.types.Object) -> Settings:
        first = sources[0]
        if not has_properties(first):
            return SettingsOverrides({}).settings_for(obj)
        properties = object_properties(first)
        values = values_of(properties)
        is_for_all = len(sources) > 1
        if is_for_all:
            values = {name: value for name, value in values.items() if name not in OF_EACH_OBJECT}
        pointers = {name: getattr(properties, name) for name in asked_for(values)}
        return SettingsOverrides(values if is_for_all else {}, pointers).settings_for(obj)

    return settings_for


def animated_settings(obj: bpy.types.Object) -> dict[str, str]:
    """Return the settings that keyframes or drivers change: their names, and the labels of them."""
    found = (_SETTING.match(path) for path in animated_paths(obj))
    known = object_properties(obj).bl_rna.properties
    return {match[1]: known[match[1]].name for match in found if match and match[1] in known}
