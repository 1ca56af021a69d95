# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings as Blender properties: on every object, and on the operator."""

from dataclasses import fields
from typing import TYPE_CHECKING, Any

import bpy
from bpy.props import BoolProperty, CollectionProperty, IntProperty, PointerProperty, StringProperty

from ..environment.declared import added, declared
from ..form.pictures import items as form_items
from ..form.settings import form_property
from ..handles import Handle
from ..handles.pose import object_handles
from ..handles.properties import CubicCraftHandle
from ..mesh_bridge import last_run, shade_edges
from ..object_properties import PROPERTY, object_properties
from ..presets.selector import preset_property
from ..regions.region import CubicCraftRegion, Region, object_regions
from ..screen import glimpse
from .values import SETTINGS, Settings

_LISTS = ("handles", "regions")


def _on_edges(properties, _context):
    """Shade the result of an object at once: nothing has to be solved for it."""
    if isinstance(properties.id_data, bpy.types.Object):
        shade_edges(properties.id_data, properties.sharp_edges)


_MORE = {
    "form": {"items": form_items},
    "orientation": {"update": glimpse.on_turn},
    "sharp_edges": {"update": _on_edges},
}


def _status(properties):
    run = last_run(properties.id_data)
    return run.status if run else ""


# The operator and the object have it, but not Live and presets. Each object keeps its own for one
# run: on a mesh that is edited again, a click must neither discard nor replace anything without
# being asked to.
START = declared(SETTINGS["start"], options={"SKIP_SAVE"})


class RunProperties:
    """Mixin of all settings that the operator and the object share."""

    __annotations__ = {
        name: declared(each, **_MORE.get(name, {}))
        for name, each in SETTINGS.items()
        if name != "start"
    }
    if TYPE_CHECKING:  # which of them there are is known when it runs

        def __getattr__(self, name: str) -> Any: ...
        def __setattr__(self, name: str, value: Any) -> None: ...


class CubicCraftProperties(RunProperties, bpy.types.PropertyGroup):
    """The settings of an object, saved with it."""

    start: START
    preset: preset_property()
    frame: PointerProperty(
        name="Frame", description="Object whose axes the form uses", type=bpy.types.Object
    )
    form_object: form_property("form_object")
    handles: CollectionProperty(name="Handles", type=CubicCraftHandle)
    active_handle: IntProperty(
        name="Active Handle",
        description="Index of the handle that the buttons act on",
        min=0,
        options=set(),
    )
    regions: CollectionProperty(name="Regions", type=CubicCraftRegion)
    active_region: IntProperty(
        name="Active Region",
        description="Index of the region that the buttons act on",
        min=0,
        options=set(),
    )
    is_target: BoolProperty(
        name="Target", description="A handle follows this object, or did so before"
    )
    is_made_target: BoolProperty(
        name="Made as Target",
        description="This object was made for a handle and is removed with it",
    )
    status: StringProperty(
        name="Last Run",
        description="Summary of the run that made the shape of the mesh",
        get=_status,
    )


def value_of(properties: Any, name: str) -> Any:
    """Return a property of a property group, or of an operator, as a plain value.

    An enum with a number that no longer has an item, from an older file, has its default.
    """
    value = getattr(properties, name)
    if value == "" and isinstance(getattr(Settings, name, None), str):
        return getattr(Settings, name)
    return value if isinstance(value, str | int | float | bpy.types.ID | None) else tuple(value)


def settings_of(
    obj: bpy.types.Object,
    handles: tuple[Handle, ...] | None = None,
    regions: tuple[Region, ...] | None = None,
) -> Settings:
    """Return the object's settings as plain values.

    `handles`: tuple of Handle, optional, instead of the object's own. `regions`: tuple of Region,
    optional, likewise. Raises CubicCraftError: the object's own handles or regions cannot be used,
    see `object_handles` and `object_regions`.
    """
    p = object_properties(obj)
    if handles is None:
        handles = object_handles(obj)
    if regions is None:
        regions = object_regions(obj) if p.use_regions else ()
    names = [field.name for field in fields(Settings) if field.name not in _LISTS]
    values = {name: value_of(p, name) for name in names}
    return Settings(handles=handles, regions=regions, **values)


_properties = PointerProperty(type=CubicCraftProperties)
register, unregister = added(bpy.types.Object, {PROPERTY: _properties}, CubicCraftProperties)
