# SPDX-License-Identifier: GPL-3.0-or-later
"""Send To: write the selected meshes to a file for a game engine, another program or a printer."""

from pathlib import Path

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, StringProperty

from ..cubic_craft_addon.environment.file_names import file_stems
from ..cubic_craft_addon.send.file import SCALES, scale_of, send
from ..cubic_craft_addon.send.targets import ITEMS, TARGETS, Options, exporter, with_suffix
from ..solver import CubicCraftError
from ._shared.selection import poll_meshes, poll_object_mode, report_all, selected_meshes
from ._shared.unexpected_errors import reporting


class CUBIC_CRAFT_OT_send_to(bpy.types.Operator):
    bl_idname = "cubic_craft.send_to"
    bl_label = "Send To"
    bl_description = (
        "Write the selected meshes to a file for game engines (glTF), other programs (FBX) or 3D"
        " printers (STL). The order of vertices and the vertex groups can be found in it again;"
        " the scene does not change"
    )
    bl_options = {"REGISTER"}

    target: EnumProperty(name="Target", description="What kind of file is written", items=ITEMS)
    filepath: StringProperty(
        name="File Path", description="Where the file is written", subtype="FILE_PATH"
    )
    check_existing: BoolProperty(
        name="Check Existing",
        description="Warn before a file is replaced",
        default=True,
        options={"HIDDEN"},
    )
    filter_glob: StringProperty(options={"HIDDEN", "SKIP_SAVE"})
    modifiers: BoolProperty(
        name="Apply Modifiers",
        description="Write the mesh as its modifiers show it, with the armature as bones. Meshes"
        " with shape keys are written without modifiers, which would remove the keys",
        default=True,
    )
    animation: BoolProperty(
        name="Animation", description="Also write the animation of armatures", default=True
    )
    groups: BoolProperty(
        name="Vertex Groups",
        description="Also write the vertex groups that belong to no bone: as attributes named"
        " _GROUP_... (glTF), or as colors (FBX)",
        default=True,
    )
    scale: EnumProperty(
        name="Scale", description="How large the print becomes", items=SCALES, default="SCENE"
    )
    size: FloatProperty(
        name="Size",
        description="Length of the longest side, in millimeters",
        default=100.0,
        min=0.1,
        soft_max=1000.0,
    )

    @classmethod
    def poll(cls, context):
        return poll_meshes(cls, context) and poll_object_mode(cls, context)

    def invoke(self, context, event):
        """Ask for the file, with a name that suits."""
        try:
            exporter(self.target)
        except CubicCraftError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        name = file_stems(bpy.data.objects)[selected_meshes(context)[0]]
        before = Path(self.filepath or bpy.data.filepath)
        folder = before.parent if before.is_absolute() else Path.home()
        self.filepath = str(folder / f"{name}{TARGETS[self.target].suffix}")
        self.filter_glob = f"*{TARGETS[self.target].suffix}"
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def check(self, context):
        """Keep the suffix that belongs to the kind of file."""
        path = with_suffix(self.filepath, self.target)
        is_changed = path != self.filepath
        self.filepath = path
        return is_changed

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        if TARGETS[self.target].is_printed:
            layout.prop(self, "scale")
            if self.scale == "SIZE":
                layout.prop(self, "size")
            return
        layout.prop(self, "modifiers")
        layout.prop(self, "animation")
        layout.prop(self, "groups")

    @reporting
    def execute(self, context):
        if not self.filepath:
            raise CubicCraftError("Type the name of the file to write")
        path = Path(bpy.path.abspath(with_suffix(self.filepath, self.target)))
        objects = selected_meshes(context)
        is_printed = TARGETS[self.target].is_printed
        scale = scale_of(self.scale, self.size, context.scene, objects) if is_printed else 1.0
        options = Options(
            with_modifiers=self.modifiers,
            with_animation=self.animation,
            with_groups=self.groups,
            scale=scale,
        )
        return report_all(self, *send(self.target, objects, path, options))
