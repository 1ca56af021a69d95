# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings while Live runs.

They are stored on the window manager: a slider on an object would push an undo step that holds an
intermediate shape. Confirming transfers them to the objects, in the single step of Live.
"""

from typing import Any

import bpy
from bpy.props import PointerProperty

from ..environment.declared import added
from ..presets.selector import preset_property
from ..screen import glimpse
from ..settings.overrides import (
    ALL,
    OF_EACH_OBJECT,
    POINTERS,
    SettingsOverrides,
    find_pointers,
    pointer_name,
    values_of,
)
from ..settings.properties import RunProperties, object_properties, value_of
from . import handlers, poses

_NAME = "cubic_craft_live"
_POSES = "poses"


def _with_update(declared):
    """Return a copy of the declaration of a property, with an additional callback on changes."""
    own = declared.keywords.get("update")

    def on_update(properties, context):
        if own is not None:
            own(properties, context)
        handlers.on_property(properties, context)

    return declared.function(**{**declared.keywords, "update": on_update})


class CubicCraftLiveProperties(bpy.types.PropertyGroup):
    """The settings of the running session."""

    __annotations__ = (
        {name: _with_update(declared) for name, declared in RunProperties.__annotations__.items()}
        | {
            # By name: a pointer on the window manager would outlive the objects after an undo.
            name: _with_update(pointer_name(name))
            for name in POINTERS
        }
        | {"preset": preset_property()}
    )


def live_properties() -> Any:
    """Return the settings of the running session."""
    return getattr(bpy.context.window_manager, _NAME)


def adopt(obj: bpy.types.Object) -> None:
    """Take the settings from an object."""
    source = object_properties(obj)
    names = {name: pointer.name if (pointer := getattr(source, name)) else "" for name in POINTERS}
    set_live_values(values_of(source) | names | {_POSES: {}})


def live_values() -> dict[str, Any]:
    """Return the settings as plain values."""
    return values_of(live_properties(), (*ALL, *POINTERS)) | {_POSES: poses.live_poses()}


@glimpse.quiet()
def set_live_values(values: dict[str, Any]) -> None:
    """Set settings by their names."""
    target = live_properties()
    for name, value in values.items():
        if name == _POSES:
            poses.set_live_poses(value)
        elif value_of(target, name) != value:
            setattr(target, name, value)


def live_overrides(objects: list[bpy.types.Object]) -> SettingsOverrides:
    """Return the settings for objects, of which the active one is the first.

    Raises CubicCraftError: there is no object of a name that is asked for.
    """
    values = live_values()
    posed = poses.by_object(values.pop(_POSES))
    names = {name: values.pop(name) for name in POINTERS}
    found = find_pointers(names, values, objects[0]) if objects else {}
    if len(objects) > 1:
        values = {name: value for name, value in values.items() if name not in OF_EACH_OBJECT}
    return SettingsOverrides(values, found, poses=posed)


_pointer = PointerProperty(type=CubicCraftLiveProperties, options={"SKIP_SAVE"})
_added = bpy.types.WindowManager, {_NAME: _pointer}, CubicCraftLiveProperties
register, unregister = added(*_added)

_Values = dict[str, Any]
_last: tuple[frozenset[int], _Values, _Values] | None = None


def remember(object_uids: list[int], own: _Values, values: _Values) -> None:
    """Remember the settings of a session, and the objects' own with which it began."""
    global _last
    _last = frozenset(object_uids), own, values


def recall(object_uids: list[int], own: _Values) -> _Values | None:
    """Return the remembered settings, None if it was about others or their own have changed."""
    if _last is None or _last[:2] != (frozenset(object_uids), own):
        return None
    return _last[2]
