# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel in the sidebar of the 3D viewport."""

import bpy

from ...solver import CubicCraftError
from .. import job, live, mesh_bridge
from ..animation import panel as animation_panel
from ..environment.ahead import load_ahead
from ..environment.modes import is_mode_usable
from ..environment.requirements import check_known_requirements, engine_note
from ..form import overlay as form_overlay
from ..form import panel as form_panel
from ..form.settings import check_directions, check_form_object
from ..handles import panel as handles_panel
from ..mesh_bridge import last_run
from ..object_properties import object_properties
from ..presets import panel as presets_panel
from ..read.object_frame import check_frame
from ..regions import panel as regions_panel
from ..run.up_to_date import changes_since
from ..screen.text_fit import draw_wrapped, is_narrow
from ..send import panel as send_panel
from ..settings.properties import settings_of
from . import buttons, edited, header, seen, status_panel
from .settings_rows import draw_advanced, draw_orientation, draw_solver, draw_volume
from .symmetry_panel import draw_symmetry

DEFAULT_TAB = "Cubic Craft"
_ADVANCED = "CUBIC_CRAFT_PT_shape_advanced"


class CUBIC_CRAFT_PT_main(bpy.types.Panel):
    """All of CubicCraft."""

    bl_label = DEFAULT_TAB
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = DEFAULT_TAB

    @classmethod
    def poll(cls, context):
        """Let the header follow the sidebar: Blender asks whenever that is drawn."""
        header.look_at(context, cls.bl_category)
        return True

    def draw(self, context):
        """Draw all sections for the active object, or the mesh that it poses."""
        layout = self.layout
        layout.use_property_split = not is_narrow(context)
        layout.use_property_decorate = False
        obj = live.panel_mesh(context)
        if obj is None:
            _draw_other(context, layout)
            return
        if obj != context.active_object:
            layout.label(text=obj.name, icon="MESH_DATA")
        load_ahead(object_properties(obj).device)
        _draw_cubify(context, layout, obj)
        for identifier, title, draw, is_closed in _SECTIONS:
            title_row, body = layout.panel(identifier, default_closed=is_closed)
            switch = _SWITCHES.get(identifier)
            if switch is not None:
                title_row.use_property_split = False
                title_row.prop(live.own_properties(obj), switch, text="")
            title_row.label(text=title)
            title_row.enabled = job.current() is None
            if body is not None:
                body.enabled = job.current() is None
                body.active = switch is None or getattr(live.own_properties(obj), switch)
                draw(body, obj)


def _draw_cubify(context, layout, obj):
    session = live.current()
    run = last_run(obj)
    changes = changes_since(obj, run) if run and not session else []
    column = layout.column()
    column.enabled = job.current() is None
    edited.draw(context, column, obj)
    presets_panel.draw(column, live.shared_properties(obj))
    column.prop(live.shared_properties(obj), "cubeness", slider=True)
    column.prop(live.shared_properties(obj), "crispness", slider=True)
    hint = seen.hint_to_draw(obj)
    row = layout.row()
    row.scale_y = 1.0 if hint and hint.is_needed else seen.MAIN
    has_icons = not is_narrow(context)
    restore_icon, apply_icon = ("LOOP_BACK", "CHECKMARK") if has_icons else ("NONE", "NONE")
    buttons.draw(row, is_outdated=bool(changes), has_icons=has_icons)
    row = layout.row(align=True)
    buttons.operator(row, "cubic_craft.restore", text="Restore", icon=restore_icon)
    if mesh_bridge.has_first(mesh_bridge.mesh_of(obj)):
        row.operator("cubic_craft.restore_first", icon="REW")
    buttons.operator(row, "cubic_craft.apply", text="Apply", icon=apply_icon)
    problem = "; ".join(session.all_problems) if session else _problem(context, obj)
    if problem:
        _draw_problem(context, layout, problem)
    status_panel.draw(context, layout, obj, run, changes)
    if hint:
        seen.draw_hint(layout, hint)
    seen.draw_source(layout, obj)
    animation_panel.draw_animated(context, layout, obj)


def _draw_other(context, layout):
    active = context.active_object
    why = mesh_bridge.why_no_mesh(active) if active is not None else ""
    if why:
        _draw_problem(context, layout, why)
    else:
        seen.draw_other(layout, active)


def _draw_problem(context, layout, text):
    draw_wrapped(context, layout.box().column(align=True), text, "ERROR")


def _draw_orientation(layout, obj):
    properties = live.shared_properties(obj)
    layout.prop(bpy.context.window_manager, form_overlay.PROPERTY)
    draw_orientation(layout, properties, is_by_name=live.current() is not None)
    layout.operator("cubic_craft.auto_orient", icon="ORIENTATION_LOCAL")


def _draw_shape(layout, obj):
    properties = live.shared_properties(obj)
    form_panel.draw(layout, properties)
    draw_volume(layout, properties)
    draw_symmetry(layout, obj, properties)
    layout.prop(properties, "floor")
    title_row, body = layout.panel(_ADVANCED, default_closed=True)
    title_row.label(text="Advanced")
    if body is not None:
        body.prop_search(live.own_properties(obj), "detail_group", obj, "vertex_groups")
        draw_advanced(body, properties)


def _draw_map(layout, obj):
    properties = live.own_properties(obj)
    layout.prop_search(properties, "map_group", obj, "vertex_groups")
    row = layout.row()
    row.active = bool(properties.map_group)
    row.prop(properties, "map_invert")
    is_painted = obj.mode == "WEIGHT_PAINT"
    text = "Back to Object Mode" if is_painted else "Paint Map"
    icon = "OBJECT_DATAMODE" if is_painted else "BRUSH_DATA"
    layout.operator("cubic_craft.paint_map", text=text, icon=icon)


def _draw_result(layout, obj):
    properties = live.shared_properties(obj)
    layout.prop(properties, "result")
    if properties.result == "NEW_OBJECT":
        layout.prop(properties, "with_modifiers")
    layout.prop(properties, "sharp_edges")
    if last_run(obj) is not None and not live.current():
        layout.operator("cubic_craft.flatten", icon="MESH_GRID")


def _draw_solver(layout, obj):
    properties = live.shared_properties(obj)
    draw_solver(layout, properties)
    session = live.current()
    mesh = session.mesh_of(obj) if session else None
    if mesh is not None and mesh.run.numbers:
        layout.label(text=mesh.run.numbers)
    if engine_note():
        draw_wrapped(bpy.context, layout, engine_note(), taken=0.0)


_SECTIONS = (
    ("CUBIC_CRAFT_PT_shape", "Form and Volume", _draw_shape, False),
    ("CUBIC_CRAFT_PT_orientation", "Orientation", _draw_orientation, True),
    (handles_panel.SECTION, "Handles", handles_panel.draw, True),
    (regions_panel.SECTION, "Regions", regions_panel.draw, True),
    ("CUBIC_CRAFT_PT_map", "Cubeness Map", _draw_map, True),
    ("CUBIC_CRAFT_PT_result", "Result", _draw_result, True),
    (animation_panel.SECTION, "Animation", animation_panel.draw, True),
    (send_panel.SECTION, "Send To", send_panel.draw, True),
    ("CUBIC_CRAFT_PT_solver", "Solver", _draw_solver, True),
)
_SWITCHES = {
    handles_panel.SECTION: "use_handles",
    regions_panel.SECTION: "use_regions",
}


def _problem(context, obj):
    """Return what would make Cubify refuse the object, or an empty text."""
    if not is_mode_usable(context):
        return ""  # the panel offers the way out instead of a message
    try:
        check_known_requirements()
        mesh_bridge.check_usable(obj)
        settings = settings_of(obj)
        check_frame(obj, settings)
        check_form_object(settings.form, settings.form_object)
        check_directions(settings.form, settings.form_directions)
        if settings.result == "SHAPE_KEY":
            mesh_bridge.check_relative_keys(obj)
        if settings.map_group:
            mesh_bridge.vertex_group(obj, settings.map_group)
        if settings.detail_group:
            mesh_bridge.vertex_group(obj, settings.detail_group)
    except CubicCraftError as error:
        return str(error)
    return ""


def move_to_tab(tab):
    """Show the panel in another tab of the sidebar."""
    bpy.utils.unregister_class(CUBIC_CRAFT_PT_main)
    CUBIC_CRAFT_PT_main.bl_category = tab or DEFAULT_TAB
    bpy.utils.register_class(CUBIC_CRAFT_PT_main)


register, unregister = bpy.utils.register_classes_factory((CUBIC_CRAFT_PT_main,))
