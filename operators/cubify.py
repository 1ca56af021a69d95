# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubify: the selected meshes become cubic, in one click and one undo step.

All objects are solved before the first is written, so that an error changes nothing. From the
interface, a long run leaves Blender usable and can be cancelled; scripts wait.
"""

import math

import bpy
from bpy.props import BoolProperty, CollectionProperty

from ..cubic_craft_addon import job, mesh_bridge
from ..cubic_craft_addon.form import panel as form_panel
from ..cubic_craft_addon.form.settings import form_settings
from ..cubic_craft_addon.handles import Handle
from ..cubic_craft_addon.handles.owner import panel_object
from ..cubic_craft_addon.handles.properties import CubicCraftGivenHandle
from ..cubic_craft_addon.mesh_bridge import last_run
from ..cubic_craft_addon.object_properties import has_properties, object_properties
from ..cubic_craft_addon.run.up_to_date import changes_since
from ..cubic_craft_addon.screen import glimpse
from ..cubic_craft_addon.settings.overrides import (
    ALL,
    OF_EACH_OBJECT,
    POINTERS,
    SettingsOverrides,
    asked_for,
    find_pointers,
    pointer_name,
    values_of,
)
from ..cubic_craft_addon.settings.properties import START, RunProperties
from ..cubic_craft_addon.ui import settings_rows as rows
from ..solver import CubicCraftError
from ._shared.selection import poll_sources, selected_meshes, selected_sources
from ._shared.watched_operator import WatchedOperator


class CUBIC_CRAFT_OT_cubify(WatchedOperator, RunProperties, bpy.types.Operator):
    bl_idname = "cubic_craft.cubify"
    bl_label = "Cubify"
    bl_description = (
        "Turn the selected meshes into cubic sculptures, with the settings of the active one. Each"
        " mesh starts from its original shape"
    )
    bl_options = {"REGISTER", "UNDO"}

    start: START
    frame: pointer_name("frame")
    form_object: pointer_name("form_object")
    handles: CollectionProperty(
        name="Handles",
        description="Handles to use in place of those of the objects",
        type=CubicCraftGivenHandle,
        options={"SKIP_SAVE"},
    )

    is_edited: BoolProperty(
        description="The mesh was edited by hand before this run, so Adjust Last Operation offers"
        " what to start from",
        options={"HIDDEN", "SKIP_SAVE"},
    )

    @classmethod
    def description(cls, context, properties):
        """Return the tooltip, with the settings that have changed since the last run."""
        obj = panel_object(context)
        run = None if obj is None else last_run(obj)
        changes = changes_since(obj, run) if obj is not None and run is not None else []
        if not changes:
            return cls.bl_description
        return (
            "Update the selected meshes with the current settings."
            f" Changed since the last run: {', '.join(changes)}"
        )

    @classmethod
    def poll(cls, context):
        return poll_sources(cls, context)

    def make_job(self, context):
        """Return the Job of the selected objects."""
        is_seen = _asks_for_what_is_seen(self, context)
        objects = selected_sources(context) if is_seen else selected_meshes(context)
        _adopt_settings(self, objects)
        return job.Job(_overrides(self, objects[0]), objects)

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        if self.is_edited:
            layout.column().prop(self, "start", expand=True)
        layout.prop(self, "cubeness", slider=True)
        layout.prop(self, "crispness", slider=True)
        layout.prop(self, "form")
        for name in form_settings(self.form):
            if name == "form_directions":
                form_panel.draw_count(layout, self)
            elif name in POINTERS:
                layout.prop_search(self, name, context.blend_data, "objects")
            else:
                layout.prop(self, name)
        rows.draw_orientation(layout, self, is_by_name=True)
        rows.draw_volume(layout, self)
        layout.prop(self, "keep_symmetric")
        layout.row(align=True).prop(self, "symmetry", toggle=True)
        layout.prop(self, "floor")
        rows.draw_advanced(layout, self)
        layout.prop(self, "use_handles")
        layout.prop(self, "hold_rest")
        groups = panel_object(context)
        if groups is not None:
            layout.prop_search(self, "map_group", groups, "vertex_groups", text="Cubeness Map")
            layout.prop(self, "map_invert")
            layout.prop_search(self, "detail_group", groups, "vertex_groups")
        layout.prop(self, "result")
        if self.result == "NEW_OBJECT":
            layout.prop(self, "with_modifiers")
        layout.prop(self, "sharp_edges")
        rows.draw_solver(layout, self)


def _asks_for_what_is_seen(operator, context):
    """Return whether the visible mesh is used: as given, by the active object, or for no mesh."""
    active = panel_object(context)
    if active is None or not selected_meshes(context):
        return True
    given = operator.properties.is_property_set
    own = object_properties(active)
    result = operator.result if given("result") else own.result
    is_with = operator.with_modifiers if given("with_modifiers") else own.with_modifiers
    return result == "NEW_OBJECT" and is_with


@glimpse.quiet()
def _adopt_settings(operator, objects):
    """Take unset values from the active object, so that Adjust Last Operation shows them."""
    if objects[0].type != "MESH":  # the only possible values for texts, curves and the like
        _set_unset(operator, {"result": "NEW_OBJECT", "with_modifiers": True})
        if not has_properties(objects[0]):
            return  # and it should have none: it is not changed
    source, kept = object_properties(objects[0]), OF_EACH_OBJECT if len(objects) > 1 else ()
    _set_unset(operator, {n: value for n, value in values_of(source).items() if n not in kept})
    if len(objects) == 1 and objects[0].type == "MESH":
        mesh = mesh_bridge.mesh_of(objects[0])
        operator.is_edited = mesh_bridge.has_strokes(mesh) or mesh_bridge.is_edited(mesh)
        _set_unset(operator, {"start": source.start})
    pointers = {name: getattr(source, name) for name in asked_for(values_of(operator))}
    _set_unset(operator, {name: obj.name for name, obj in pointers.items() if obj is not None})


def _set_unset(operator, values):
    for name, value in values.items():
        if not operator.properties.is_property_set(name):
            setattr(operator, name, value)


def _overrides(operator, active):
    names = tuple(n for n in (*ALL, "start") if operator.properties.is_property_set(n))
    pointers = find_pointers(values_of(operator, tuple(POINTERS)), values_of(operator), active)
    handles = None
    if operator.properties.is_property_set("handles"):
        handles = tuple(
            Handle(item.name, threshold=item.threshold, matrix=_affine(item))
            for item in operator.handles
        )
    return SettingsOverrides(values_of(operator, names), pointers, handles)


def _affine(item):
    """Return the item's matrix as 16 numbers, row by row."""
    matrix = tuple(value for row in item.matrix for value in row)
    if matrix[12:] != (0.0, 0.0, 0.0, 1.0) or not all(map(math.isfinite, matrix)):
        raise CubicCraftError(
            f'the matrix of handle "{item.name}" is not an affine map; give it as a'
            " mathutils.Matrix (Blender takes a plain list by its columns)"
        )
    return matrix
