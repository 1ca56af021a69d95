# SPDX-License-Identifier: GPL-3.0-or-later
"""What the tests of Live share: a monkey, its bits, and what must not be left behind."""

import contextlib
import dataclasses
import importlib

import bpy
import guidrive as gui
import numpy as np
import open_sections  # noqa: F401
from bpy_extras.view3d_utils import location_3d_to_region_2d

NAME = "Suzanne"
LONG_SLICE = 0.4
"""seconds"""
EXTENSION = "bl_ext.user_default.cubic_craft"


def live():
    return importlib.import_module(f"{EXTENSION}.cubic_craft_addon.live")


def job():
    return importlib.import_module(f"{EXTENSION}.cubic_craft_addon.job")


def settings(name=NAME):
    return getattr(bpy.data.objects[name], "cubic_craft")  # noqa: B009


def positions(name=NAME):
    mesh = bpy.data.objects[name].data
    values = np.empty(3 * len(mesh.vertices), dtype=np.float32)
    mesh.vertices.foreach_get("co", values)
    return values.tobytes()


def note(name=NAME):
    """Return what is noted with the mesh about its result, the seconds of the run among it."""
    return bpy.data.objects[name].data.get("cubic_craft_note")


def add_monkey(levels=0, is_refined=False):
    """Leave nothing in the scene but a monkey, selected and active, as one undo step.

    Refined, it has ten times the vertices, and with NumPy each change takes seconds.
    """
    with gui.in_region():
        if bpy.context.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        bpy.data.batch_remove(bpy.data.objects[:])  # also what a new object has hidden
        bpy.ops.mesh.primitive_monkey_add()
        if levels:
            bpy.context.object.modifiers.new("Subdivision", "SUBSURF").levels = levels
            bpy.ops.object.modifier_apply(modifier="Subdivision")
        if not is_refined:
            settings(bpy.context.object.name).refine = "OFF"
        bpy.ops.ed.undo_push(message="Add the monkey")


def show_front():
    """Show what is selected from the front, well in view and out from behind the sidebar."""
    with gui.in_region():
        bpy.ops.view3d.view_axis(type="FRONT")
        bpy.ops.view3d.view_selected()
    gui.area().spaces.active.region_3d.view_location.x += 0.7


_buttons = {}


def button(target):
    """Find a button of the panel; those that Live has found once stay in their places."""
    if target not in _buttons:
        _buttons[target] = yield from gui.find_button(target)
    return _buttons[target]


def cubeness_slider():
    """Find the slider; Live has its own, in the same place."""
    prefix = "cubic_craft_live" if live().current() else "cubic_craft"
    if "cubeness" not in _buttons:
        slider = yield from gui.find_button(f"{prefix}.cubeness")
        _buttons["cubeness"] = dataclasses.replace(slider, target="cubeness")
    return _buttons["cubeness"]


def start_live():
    """Click the button and wait for the first change of the active object."""
    has_changed = will_have_changed(bpy.context.view_layer.objects.active.name)
    yield from gui.click((yield from button("cubic_craft.live")))
    yield from gui.wait_until(lambda: live().current(), what="Live")
    yield from gui.wait_until(has_changed, what="a change")


def start_live_beside():
    """Click the button and wait for the new object that shows the result of the active one."""
    name = f"{bpy.context.view_layer.objects.active.name} Cubic"
    yield from gui.click((yield from button("cubic_craft.live")))
    yield from gui.wait_until(lambda: name in bpy.data.objects, what="the new object")
    yield from gui.wait_until(will_have_changed(name), what="a change")


def will_have_changed(name=NAME):
    """Return a function that says whether Live has changed an object since now.

    One that is cubic already may end in the same bits before anyone looks.
    """
    before, is_cubic = positions(name), note(name) is not None
    return lambda: positions(name) != before or (is_cubic and is_idle())


def press(*keys):
    """Press keys over the viewport."""
    yield from gui.move_mouse(gui.viewport_point())
    yield from gui.keys(*keys)


def is_idle():
    session = live().current()
    return session is not None and session._machine.state.name == "IDLE"


def wait_idle():
    """Wait until there is nothing left to compute.

    Ticks are longer meanwhile, which changes no bit of the result: each ends in a redraw, which
    takes software several times as long as what is usually computed in between.
    """
    with long_ticks():
        yield from gui.wait_until(is_idle, what="the end of the computing")


@contextlib.contextmanager
def long_ticks():
    slices = importlib.import_module(f"{EXTENSION}.cubic_craft_addon.live.slices")
    usual, slices.SLICE = slices.SLICE, LONG_SLICE
    try:
        yield
    finally:
        slices.SLICE = usual


def is_over():
    return live().current() is None and "CUBIC_CRAFT_OT_live" not in gui.running_operators()


def wait_over():
    with long_ticks():
        yield from gui.wait_until(is_over, what="the end of Live")
    check_clean()


def end_by(*keys):
    """Press keys over the viewport that end Live."""
    session = live().current()
    yield from press(*keys)
    yield from wait_over()
    problems = session.written.problems
    assert not session.error and not problems, (session.error, problems)
    assert bool(session.written.summary) == (keys[-1] in ("RET", "NUMPAD_ENTER"))


def wait_settled():
    """Wait until Live has nothing left to compute, or has ended."""
    yield
    with long_ticks():
        yield from gui.wait_until(lambda: is_over() or is_idle(), what="rest")


def wait_idle_with(changed, what):
    """Wait until a condition holds and Live has done all that there is to compute."""
    with long_ticks():
        yield from gui.wait_until(changed, what=what)
    yield from wait_idle()


def redo():
    """Press Ctrl-Shift-Z over the viewport and wait until Blender has redone a step."""
    redone = []
    bpy.app.handlers.redo_post.append(lambda *_: redone.append(True))
    yield from press("CTRL+SHIFT+Z")
    yield from gui.wait_until(lambda: redone, what="redo")
    bpy.app.handlers.redo_post.pop()


def check_bits_of_cubify(*names):
    """Check that Cubify, from the original again, leaves the bits that are there now."""
    names = names or (NAME,)
    confirmed = [positions(name) for name in names]
    with gui.in_region():
        bpy.ops.cubic_craft.restore()
        assert all(positions(n) != c for n, c in zip(names, confirmed, strict=True))
        bpy.ops.cubic_craft.cubify()
    assert [positions(name) for name in names] == confirmed, "Live leaves other bits than Cubify"


def screen_point(place):
    """Return where a place in the scene is in the window."""
    view = gui.region()
    x, y = location_3d_to_region_2d(view, gui.area().spaces.active.region_3d, place)
    assert 0 < x < gui.region("UI").x - view.x and 0 < y < view.height, (x, y)
    return view.x + round(x), view.y + round(y)


def check_clean():
    """Check that Live has left nothing behind."""
    assert is_over()
    for name in dir(bpy.app.handlers):
        installed = getattr(bpy.app.handlers, name)
        if isinstance(installed, list):
            ours = [h for h in installed if h.__module__.endswith("live.handlers")]
            assert not ours, f"{name}: {ours}"
    handlers = importlib.import_module(f"{EXTENSION}.cubic_craft_addon.live.handlers")
    assert handlers._session is None
    header = bpy.types.STATUSBAR_HT_header
    assert header.draw is getattr(header, "_draw_orig", header.draw), "a status text is left"
    session = live()._session
    assert session is None or session._timer is None
    for mesh in bpy.data.meshes:
        ours = [a.name for a in mesh.attributes if a.name.startswith("cubic_craft_live")]
        assert not ours, f"{mesh.name}: {ours}"
        assert "live" not in mesh.get("cubic_craft_note", "")
