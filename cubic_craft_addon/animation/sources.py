# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings with which the objects of an animation are cubified."""

import re
from collections.abc import Sequence
from dataclasses import replace

import bpy
from mathutils import Euler

from ..environment.curves import animated_paths
from ..object_properties import PROPERTY, has_properties, object_properties
from ..settings.overrides import OF_EACH_OBJECT, SettingsOverrides, asked_for, values_of
from ..settings.values import SETTINGS, Settings

OF_ALL_FRAMES = tuple(name for name, each in SETTINGS.items() if each.is_of_all_frames)
"""settings that determine which vertices are solved, which a sequence of frames has in common"""
_SETTING = re.compile(rf"{PROPERTY}\.(\w+)")
_STRENGTHS = [name for name, each in SETTINGS.items() if each.is_strength]


class OfSources:
    """The settings of some objects, read anew in each frame: they may be animated."""

    def __init__(self, sources: Sequence[bpy.types.Object]):
        self._sources = sources

    def settings_for(self, obj: bpy.types.Object) -> Settings:
        """Return those of one of the objects, in the present frame."""
        return overrides_of(self._sources).settings_for(obj)


def overrides_of(
    sources: Sequence[bpy.types.Object], *, is_for_all: bool = False
) -> SettingsOverrides:
    """Return the settings of the first object for all, except those that belong to each mesh.

    A single object has its own settings, unless others have them, too.
    """
    first = sources[0]
    if not is_for_all and not has_properties(first):
        return SettingsOverrides({})
    properties = object_properties(first)
    values = values_of(properties)
    is_for_all = is_for_all or len(sources) > 1
    if is_for_all:
        values = {name: value for name, value in values.items() if name not in OF_EACH_OBJECT}
    pointers = {name: getattr(properties, name) for name in asked_for(values)}
    return SettingsOverrides(values if is_for_all else {}, pointers)


def animated_settings(obj: bpy.types.Object) -> dict[str, str]:
    """Return the settings that keyframes or drivers change: their names, and the labels of them."""
    found = (_SETTING.match(path) for path in animated_paths(obj))
    known = object_properties(obj).bl_rna.properties
    return {match[1]: known[match[1]].name for match in found if match and match[1] in known}


def on_the_way(start: Settings | None, end: Settings, share: float) -> Settings:
    """Return settings between two, which are those of the end at a share of 1.

    `start`: Settings or None, none is the original. `end`: whatever is not a strength or an angle
    is always as in these. `share`: from 0 to 1.
    """
    if share >= 1.0:
        return end

    def mixed(before, after):
        return (1.0 - share) * before + share * after

    before = {region.group: region.cubeness for region in start.regions} if start else {}
    base = start.cubeness if start else 0.0
    strengths = {name: getattr(start, name) if start else 0.0 for name in _STRENGTHS}
    if start is not None and start.capture_object is None:
        strengths["capture_strength"] = 0.0
    regions = tuple(
        replace(region, cubeness=mixed(before.get(region.group, base), region.cubeness))
        for region in end.regions
    )
    turned = end.orientation
    if start is not None and start.space == end.space:
        way = Euler(start.orientation).to_quaternion()
        found = way.slerp(Euler(end.orientation).to_quaternion(), share).to_euler()
        turned = (found.x, found.y, found.z)
    return replace(
        end,
        regions=regions,
        orientation=turned,
        **{name: mixed(value, getattr(end, name)) for name, value in strengths.items()},
    )
