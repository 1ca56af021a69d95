# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of Live share: a monkey, its bits, and what must not be left behind."""

import importlib

import bpy
import guidrive as gui
import numpy as np

NAME = "Suzanne"
EXTENSION = "bl_ext.user_default.cubic_craft"


def live():
    return importlib.import_module(f"{EXTENSION}.cubic_craft_addon.live")


def settings(name=NAME):
    return getattr(bpy.data.objects[name], "cubic_craft")  # noqa: B009


def positions(name=NAME):
    mesh = bpy.data.objects[name].data
    values = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", values)
    return values.tobytes()


def add_monkey(levels=0):
    """Leave nothing in the scene but a monkey, selected and active, as one undo step."""
    with gui.in_region():
        if bpy.context.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        bpy.ops.mesh.primitive_monkey_add()
        if levels:
            bpy.context.object.modifiers.new("Subdivision", "SUBSURF").levels = levels
            bpy.ops.object.modifier_apply(modifier="Subdivision")
        bpy.ops.ed.undo_push(message="Add the monkey")


def start_live():
    button = yield from gui.find_button("cubic_craft.live")
    yield from gui.click(button)
    yield from gui.wait_until(lambda: live().current(), timeout=120.0, what="Live")


def press(*keys):
    """Press keys over the viewport."""
    yield from gui.move_mouse(gui.viewport_point())
    yield from gui.keys(*keys)


def is_idle():
    session = live().current()
    return session is not None and session._machine.state.name == "IDLE"


def wait_idle():
    yield from gui.wait_until(is_idle, timeout=120.0, what="the end of the computing")


def is_over():
    return live().current() is None and "CUBIC_CRAFT_OT_live" not in gui.running_operators()


def check_clean():
    """Check that Live has left nothing behind."""
    assert is_over()
    for name in dir(bpy.app.handlers):
        installed = getattr(bpy.app.handlers, name)
        if isinstance(installed, list):
            ours = [h for h in installed if h.__module__.endswith("live.handlers")]
            assert not ours, f"{name}: {ours}"
    handlers = importlib.import_module(f"{EXTENSION}.cubic_craft_addon.live.handlers")
    wake = importlib.import_module(f"{EXTENSION}.cubic_craft_addon.live.wake")
    assert handlers._session is None and wake._listener is None
    header = bpy.types.STATUSBAR_HT_header
    assert header.draw is getattr(header, "_draw_orig", header.draw), "a status text is left"
    session = live()._session
    assert session is None or session._timer is None
    for mesh in bpy.data.meshes:
        ours = [a.name for a in mesh.attributes if a.name.startswith("cubic_craft_live")]
        assert not ours, f"{mesh.name}: {ours}"
        assert "live" not in mesh.get("cubic_craft_note", "")
