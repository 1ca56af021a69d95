# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings with which the objects of an animation are cubified."""

import re
from collections.abc import Sequence

import bpy

from ..environment.curves import animated_paths
from ..object_properties import PROPERTY, has_properties, object_properties
from ..settings.overrides import OF_EACH_OBJECT, SettingsOverrides, asked_for, values_of
from ..settings.values import SETTINGS, Settings

OF_ALL_FRAMES = tuple(name for name, each in SETTINGS.items() if each.is_of_all_frames)
"""settings that determine which vertices are solved, which a sequence of frames has in common"""
_SETTING = re.compile(rf"{PROPERTY}\.(\w+)")


class OfSources:
    """The settings of some objects, read anew in each frame: they may be animated."""

    def __init__(self, sources: Sequence[bpy.types.Object]):
        self._sources = sources

    def settings_for(self, obj: bpy.types.Object) -> Settings:
        """Return those of one of the objects, in the present frame."""
        return _overrides_of(self._sources).settings_for(obj)


def _overrides_of(sources: Sequence[bpy.types.Object]) -> SettingsOverrides:
    """Return the settings of the first object for all, except those that belong to each mesh.

    A single object has its own settings, unless others have them, too.
    """
    first = sources[0]
    if not has_properties(first):
        return SettingsOverrides({})
    properties = object_properties(first)
    values = values_of(properties)
    is_for_all = len(sources) > 1
    if is_for_all:
        values = {name: value for name, value in values.items() if name not in OF_EACH_OBJECT}
    pointers = {name: getattr(properties, name) for name in asked_for(values)}
    return SettingsOverrides(values if is_for_all else {}, pointers)


def animated_settings(obj: bpy.types.Object) -> dict[str, str]:
    """Return the settings that keyframes or drivers change: their names, and the labels of them."""
    found = (_SETTING.match(path) for path in animated_paths(obj))
    known = object_properties(obj).bl_rna.properties
    return {match[1]: known[match[1]].name for match in found if match and match[1] in known}
