# SPDX-License-Identifier: GPL-3.0-or-later
"""A modal operator that shakes a mesh until Enter or Esc, with sliders that it reads as it runs."""

import math

import bpy

NAME = "dummy_ext"  # of the properties of scenes and of the window manager

status = {"ticks": 0, "end": "", "strengths": set(), "speeds": set()}


def mesh_of(context):
    return bpy.data.meshes[context.object.data.name]


class DummySceneSettings(bpy.types.PropertyGroup):
    strength: bpy.props.FloatProperty(name="Strength", default=0.1, min=0.0, max=1.0)
    note: bpy.props.StringProperty(name="Note")


class DummyWindowSettings(bpy.types.PropertyGroup):
    speed: bpy.props.FloatProperty(name="Speed", default=0.1, min=0.0, max=1.0)
    lines_above: bpy.props.IntProperty()
    is_grey: bpy.props.BoolProperty()


class DUMMY_OT_run(bpy.types.Operator):
    """Shake the mesh until Enter (keep it) or Esc (put it back)."""

    bl_idname = "dummy.run"
    bl_label = "Run Dummy"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "MESH"

    def invoke(self, context, event):
        vertices = mesh_of(context).vertices
        self.rest = [0.0] * (3 * len(vertices))
        vertices.foreach_get("co", self.rest)
        status.update(ticks=0, end="", strengths=set(), speeds=set())
        manager = context.window_manager
        self.timer = manager.event_timer_add(1 / 30, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.value == "PRESS" and event.type in {"ESC", "RET"}:
            if event.type == "ESC":
                self.place(context, self.rest)
            context.window_manager.event_timer_remove(self.timer)
            status["end"] = event.type
            return {"CANCELLED" if event.type == "ESC" else "FINISHED"}
        if event.type == "TIMER":
            strength = getattr(context.scene, NAME).strength
            speed = getattr(context.window_manager, NAME).speed
            status["ticks"] += 1
            status["strengths"].add(round(strength, 3))
            status["speeds"].add(round(speed, 3))
            shift = (0.5 + strength) * math.sin((0.2 + speed) * status["ticks"])
            self.place(context, [c + (i % 3 == 2) * shift for i, c in enumerate(self.rest)])
        return {"PASS_THROUGH"}

    def place(self, context, coordinates):
        mesh = mesh_of(context)
        mesh.vertices.foreach_set("co", coordinates)
        mesh.update()


class DUMMY_PT_panel(bpy.types.Panel):
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Dummy"
    bl_label = "Dummy"

    def draw(self, context):
        column = self.layout.column()
        settings = getattr(context.window_manager, NAME)
        for _ in range(settings.lines_above):
            column.label(text="What has just been found")
        row = column.row()
        row.enabled = not settings.is_grey
        row.operator("dummy.run")
        column.prop(getattr(context.scene, NAME), "strength", slider=True)
        column.prop(settings, "speed", slider=True)
        for _ in range(40):
            column.label(text="To scroll over")
        column.prop(getattr(context.scene, NAME), "note")


classes = (DummySceneSettings, DummyWindowSettings, DUMMY_OT_run, DUMMY_PT_panel)


def register():
    for cls in classes:
        bpy.utils.register_class(cls)
    setattr(bpy.types.Scene, NAME, bpy.props.PointerProperty(type=DummySceneSettings))
    setattr(bpy.types.WindowManager, NAME, bpy.props.PointerProperty(type=DummyWindowSettings))


def unregister():
    delattr(bpy.types.WindowManager, NAME)
    delattr(bpy.types.Scene, NAME)
    for cls in reversed(classes):
        bpy.utils.unregister_class(cls)
