# SPDX-License-Identifier: GPL-3.0-or-later
"""Show Source: show what the selected objects were made from, which is hidden behind them."""

import bpy

from ..cubic_craft_addon import hidden_source
from ..cubic_craft_addon.handles.owner import panel_object
from ._shared.selection import poll_work, refuse, report_all
from ._shared.unexpected_errors import reporting


class CUBIC_CRAFT_OT_show_source(bpy.types.Operator):
    bl_idname = "cubic_craft.show_source"
    bl_label = "Show Source"
    bl_description = (
        "Show what the selected objects were made from, in viewports and in renders. It was hidden"
        " because it lies at the same place"
    )
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if not poll_work(cls, context):
            return False
        if any(map(hidden_source.hidden_source, _objects(context))):
            return True
        return refuse(cls, "Nothing is hidden behind the selected objects")

    @reporting
    def execute(self, context):
        found = [(obj, hidden_source.hidden_source(obj)) for obj in _objects(context)]
        sources = [(obj, source) for obj, source in found if source is not None]
        for obj, source in sources:
            hidden_source.show(source, obj)
        names = dict.fromkeys(source.name for _, source in sources)
        return report_all(self, f"Shown: {', '.join(names)}", [])


def _objects(context):
    shown = panel_object(context) or context.active_object
    return {*context.selected_objects, shown} - {None}
