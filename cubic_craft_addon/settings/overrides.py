# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings for several objects at once: those that apply to all, and those that each keeps.

Vertex groups and handles belong to the mesh: each of several objects keeps its own unless others
are given.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any

import bpy

from ...solver import CubicCraftError
from ..handles import Handle
from ..handles.own_pose import Pose
from ..handles.pose import posed_handles
from ..mesh_bridge import Start
from ..object_properties import object_properties
from .properties import RunProperties, settings_of, value_of
from .values import Settings

ALL = tuple(RunProperties.__annotations__)
"""names of the properties that the panel, the operator and Live share"""
OF_EACH_OBJECT = ("use_handles", "map_group", "map_invert")
_PLAIN = tuple(field.name for field in fields(Settings))  # the same name in the Settings


@dataclass(frozen=True)
class SettingsOverrides:
    """What the artist has chosen for all objects of a run."""

    values: Mapping[str, Any]
    """those of ALL that apply to all objects"""
    frame: bpy.types.Object | None = None
    handles: tuple[Handle, ...] | None = None
    """instead of those of the objects"""
    poses: Mapping[int, Mapping[int, Pose]] = field(default_factory=dict)
    """instead of the handles' own poses, by ``session_uid`` of the object and number of the handle
    (`identify`)"""

    def settings_for(self, obj: bpy.types.Object) -> Settings:
        """Return the settings with which an object is to be cubified.

        Raises
        ------
        CubicCraftError
            The handles of the object cannot be used.
        """
        changes = {name: value for name, value in self.values.items() if name in _PLAIN}
        handles = self.handles
        if handles is None:
            poses = self.poses.get(obj.session_uid)
            handles = posed_handles(obj, poses) if self.uses_own_handles(obj) else ()
        if self.values.get("space") == "FRAME":
            changes["frame"] = self.frame
        return replace(settings_of(obj, handles), **changes)

    def uses_own_handles(self, obj: bpy.types.Object) -> bool:
        """Return whether an object is cubified with its own handles."""
        is_on = self.values.get("use_handles", object_properties(obj).use_handles)
        return self.handles is None and is_on

    @property
    def is_of_what_is_seen(self) -> bool:
        """Return whether new objects are made with the modifiers applied."""
        values = self.values
        return values.get("result") == "NEW_OBJECT" and bool(values.get("with_modifiers"))

    def start_of(self, obj: bpy.types.Object) -> Start:
        """Return what an object starts from if it was edited by hand since its last result."""
        return self.values.get("start", object_properties(obj).start)

    def remember_on(self, target: bpy.types.Object, settings: Settings) -> None:
        """Store the settings used on the new object, so that its panel shows them."""
        properties = object_properties(target)
        values = {name: value for name, value in self.values.items() if name != "start"}
        if settings.space == "FRAME":
            values["frame"] = settings.frame
        if settings.result == "NEW_OBJECT":
            # A click on the new object should change it, not copy it again.
            values["result"] = "MESH"
            values["with_modifiers"] = False
        for name, value in values.items():
            is_outdated = getattr(properties, name) == "" != value
            if is_outdated or value_of(properties, name) != value:
                setattr(properties, name, value)
        if properties.start != Settings.start:
            properties.start = Settings.start  # it has been for this run


def values_of(properties: Any, names: tuple[str, ...] = ALL) -> dict[str, Any]:
    """Return properties of a property group, or of an operator, as plain values."""
    return {name: value_of(properties, name) for name in names}


def find_frame(name: str, active: bpy.types.Object) -> bpy.types.Object | None:
    """Return the frame object of a name, None for no name.

    Raises
    ------
    CubicCraftError
        There is no object of that name.
    """
    if not name:
        return None
    own = object_properties(active).frame
    if own is not None and own.name == name:
        return own  # not by its name, which an object of a library may also have
    frame = bpy.data.objects.get(name)
    if frame is None:
        raise CubicCraftError(f'there is no object "{name}"; pick another frame')
    return frame
