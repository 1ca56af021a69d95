# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings for several objects at once: those that apply to all, and those that each keeps.

Vertex groups and handles belong to the mesh: each of several objects keeps its own unless others
are given.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any

import bpy
from bpy.props import StringProperty

from ...solver import CubicCraftError
from ...solver.styles.form_names import OF_OBJECT
from ..handles import Handle
from ..handles.own_pose import Pose
from ..handles.pose import posed_handles
from ..mesh_bridge import Start
from ..object_properties import object_properties
from ..regions.region import object_regions
from ..screen import glimpse
from .properties import CubicCraftProperties, settings_of, value_of
from .values import SETTINGS, Settings

ALL = tuple(name for name in SETTINGS if name != "start")
"""names of the properties that the panel, the operator and Live share"""
POINTERS = {
    "frame": lambda values: values.get("space") == "FRAME",
    "form_object": lambda values: values.get("form") in OF_OBJECT,
}
"""settings that are objects, and whether other settings ask for them; in the operator and in Live
they are given by name"""
OF_EACH_OBJECT = tuple(name for name, each in SETTINGS.items() if each.is_of_mesh)
_PLAIN = tuple(field.name for field in fields(Settings))  # the same name in the Settings


@dataclass(frozen=True)
class SettingsOverrides:
    """What the artist has chosen for all objects of a run."""

    values: Mapping[str, Any]
    """those of ALL that apply to all objects"""
    pointers: Mapping[str, bpy.types.Object | None] = field(default_factory=dict)
    """those of POINTERS that are asked for"""
    handles: tuple[Handle, ...] | None = None
    """instead of those of the objects"""
    poses: Mapping[int, Mapping[int, Pose]] = field(default_factory=dict)
    """instead of the handles' own poses, by ``session_uid`` of the object and number of the handle
    (`identify`)"""

    def settings_for(self, obj: bpy.types.Object) -> Settings:
        """Return the settings with which an object is to be cubified.

        Raises CubicCraftError: the handles or regions of the object cannot be used.
        """
        changes = {name: value for name, value in self.values.items() if name in _PLAIN}
        handles = self.handles
        if handles is None:
            poses = self.poses.get(obj.session_uid)
            handles = posed_handles(obj, poses) if self.uses_own_handles(obj) else ()
        changes |= {name: self.pointers.get(name) for name in asked_for(self.values)}
        is_on = self.values.get("use_regions", object_properties(obj).use_regions)
        regions = object_regions(obj) if is_on else ()
        return replace(settings_of(obj, handles, regions), **changes)

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

    @glimpse.quiet()
    def remember_on(self, target: bpy.types.Object, settings: Settings) -> None:
        """Store the settings used on the new object, so that its panel shows them."""
        properties = object_properties(target)
        values = {name: value for name, value in self.values.items() if name != "start"}
        values |= {name: getattr(settings, name) for name in asked_for(vars(settings))}
        if settings.result == "NEW_OBJECT":
            # A click on the new object should change it, not copy it again.
            values["result"] = "MESH"
            values["with_modifiers"] = False
        for name, value in values.items():
            is_outdated = getattr(properties, name) == "" != value
            if is_outdated or value_of(properties, name) != value:
                setattr(properties, name, value)
        if properties.is_property_set("start"):
            properties.property_unset("start")  # it has been for this run


def values_of(properties: Any, names: tuple[str, ...] = ALL) -> dict[str, Any]:
    """Return properties of a property group, or of an operator, as plain values."""
    return {name: value_of(properties, name) for name in names}


def pointer_name(setting: str) -> Any:
    """Return the declaration of the property that has the name of one of POINTERS."""
    declared = CubicCraftProperties.__annotations__[setting].keywords
    what = declared["description"]
    return StringProperty(
        name=declared["name"],
        description=f"Name of the {what[0].lower()}{what[1:]}",
        options={"SKIP_SAVE"},
    )


def asked_for(values: Mapping[str, Any]) -> list[str]:
    """Return the POINTERS that other settings ask for."""
    return [name for name, is_asked in POINTERS.items() if is_asked(values)]


def find_pointers(
    names: Mapping[str, str], values: Mapping[str, Any], active: bpy.types.Object
) -> dict[str, bpy.types.Object | None]:
    """Return the objects that are asked for by their names, None for no name.

    Raises CubicCraftError: there is no object of a name.
    """
    return {name: _find(name, names[name], active) for name in asked_for(values)}


def _find(setting, name, active):
    if not name:
        return None
    own = getattr(object_properties(active), setting)
    if own is not None and own.name == name:
        return own  # not by its name, which an object of a library may also have
    found = bpy.data.objects.get(name)
    if found is None:
        raise CubicCraftError(
            f'there is no object "{name}"; pick another {setting.replace("_", " ")}'
        )
    return found
