# SPDX-License-Identifier: GPL-3.0-or-later
"""Live: a modal operator that passes the events of its window to the session.

All decisions are in ``cubic_craft_addon/live``.
"""

import bpy

from ..cubic_craft_addon import live
from ..cubic_craft_addon.screen.redraw import waiting
from ..solver import CubicCraftError
from ._shared.selection import poll_usable, report_all, selected_meshes

_CONFIRM = ("RET", "NUMPAD_ENTER")


class CUBIC_CRAFT_OT_live(bpy.types.Operator):
    bl_idname = "cubic_craft.live"
    bl_label = "Live"
    bl_description = (
        "Watch the selected meshes become cubic while you change the settings. Enter or this"
        " button confirms, and so does switching to another mode or mesh. Esc cancels"
    )
    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, context):
        if live.current() is not None:
            return True
        return poll_usable(cls, context)

    def execute(self, context):
        self.report({"ERROR"}, "Live needs a window; use Cubify instead")
        return {"CANCELLED"}

    def invoke(self, context, event):
        """Start, or confirm if it runs."""
        session = live.current()
        if session is not None:
            session.on(live.Event.CONFIRM)
            return {"CANCELLED"}  # the running one ends with the undo step
        try:
            with waiting(context.window):
                self._session = live.begin(context, selected_meshes(context))
        except CubicCraftError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        # On the window, not on an area, which the artist may close, join or maximize.
        with context.temp_override(area=None, region=None):
            context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        """Process events for Live; pass all others to Blender, so that the view can be orbited."""
        session = self._session
        is_ours = False
        if event.type != "TIMER":
            session.touch()
        session.look_around(context)
        if session.is_dragged():
            # During a drag, Blender keeps mouse and keys, and events have other types.
            session.tick_in_drag(context)
        elif event.type == "TIMER":
            if not session.is_ended:
                session.tick(context)
        elif event.value == "PRESS" and _is_over_viewport(context, event):
            is_ours = self._on_press(context, event)
        if session.is_ended:
            return self._end()
        return {"RUNNING_MODAL"} if is_ours else {"PASS_THROUGH"}

    def cancel(self, context):
        """Handle cancellation by Blender: another file, or the window was closed."""
        self._session.on(live.Event.CLOSED)

    def _on_press(self, context, event):
        session = self._session
        if event.type in _CONFIRM:
            session.on(live.Event.CONFIRM)
            return True
        if event.type == "ESC":
            session.on(live.Event.CANCEL)
            return True
        if event.type == "Z" and (event.ctrl or event.oskey) and not (event.shift or event.alt):
            return session.take_back()
        return False

    def _end(self):
        session = self._session
        if session.error:
            self.report({"ERROR"}, session.error)
        elif session.end_message and not session.written.summary:
            self.report({"WARNING"}, session.end_message)
        if not (session.written.summary or session.written.problems):
            return {"CANCELLED"}
        texts = filter(None, (session.end_message, session.written.summary))
        status = report_all(
            self, ": ".join(texts) if session.written.summary else "", session.written.problems
        )
        return {"CANCELLED"} if session.written.has_pushed_undo else status


class CUBIC_CRAFT_OT_live_cancel(bpy.types.Operator):
    bl_idname = "cubic_craft.live_cancel"
    bl_label = "Cancel Live"
    bl_description = "End Live and restore the previous shape of the meshes"
    bl_options = {"INTERNAL"}

    @classmethod
    def poll(cls, context):
        return live.current() is not None

    def execute(self, context):
        session = live.current()
        if session is not None:
            session.on(live.Event.CANCEL)
        return {"FINISHED"}


def _is_over_viewport(context, event):
    return any(_contains(area, event) for area in context.screen.areas if area.type == "VIEW_3D")


def _contains(box, event):
    x, y = event.mouse_x - box.x, event.mouse_y - box.y
    return 0 <= x < box.width and 0 <= y < box.height
