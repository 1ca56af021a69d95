# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""A Cubify that takes long: watched, cancelled in every way, and brought to its end."""

import importlib

import bpy
import guidrive as gui
import live_scene as scene

OPERATOR = "CUBIC_CRAFT_OT_cubify"


def current():
    return scene.job().current()


def make_slow(is_slow):
    """Have it last for minutes, or for some seconds, however fast the machine is."""
    scene.settings().tolerance = 1e-9 if is_slow else 1e-3
    watched = importlib.import_module(f"{scene.job().__name__}.watched")
    watched._SLICE, watched._TIMER_STEP = 0.0, 0.2 if is_slow else 0.02
    watched._REDRAW_STEP = 0.5  # of the panel, which takes software longer than an iteration
    scene.job().FIRST_SLICE = 0.0


def start(is_slow=True):
    """Click Cubify and wait until the solver iterates."""
    make_slow(is_slow)
    yield from gui.click((yield from scene.button("cubic_craft.cubify")))
    yield from gui.wait_until(current, what="a run that is watched")
    yield from gui.wait_until(
        lambda: current() is None or " %" in current().step.texts[0], what="an iteration"
    )
    assert current() is not None and OPERATOR in gui.running_operators()


def is_over():
    return current() is None and OPERATOR not in gui.running_operators()


def check_cancelled(original):
    """Check that nothing has changed, and that nothing is left behind."""
    yield from gui.move_mouse(gui.viewport_point(0.3))
    yield from gui.move_mouse(gui.viewport_point())  # an event, for the operator to end
    yield from gui.wait_until(is_over, what="the end")
    assert scene.positions() == original
    assert not scene.settings().status
    scene.check_clean()
    names = ("undo_pre", "redo_pre", "load_pre")
    ours = [h for name in names for h in getattr(bpy.app.handlers, name) if ".job." in h.__module__]
    assert not ours, ours


def by_keys(original):
    """Esc; and Ctrl-Z, which takes nothing else back. What else could be clicked is blocked."""
    for key in ("ESC", "CTRL+Z"):
        yield from start()
        yield from gui.wait_redraw("UI")
        if key == "ESC":
            yield from gui.screenshot("watched.png")
        assert not bpy.ops.cubic_craft.cubify.poll() and not bpy.ops.cubic_craft.live.poll()
        assert not bpy.ops.cubic_craft.handle_pin_selection.poll()
        yield from scene.press(key)
        yield from check_cancelled(original)


def by_button(original):
    """Click the cross in the panel, at the right end of the row below Restore and Apply."""
    cubify = yield from scene.button("cubic_craft.cubify")
    yield from start()
    sidebar = gui.region("UI")
    x = sidebar.x + sidebar.width - 52
    for y in range(cubify.bottom, cubify.bottom - 100, -6):
        yield from gui.move_mouse((x, y))
        if gui.button_under_mouse().startswith("bpy.ops.cubic_craft.cubify_cancel("):
            break
    yield from gui.click((x, y))
    yield from check_cancelled(original)


def by_closed_window(original):
    """Start it in a second window and close that."""
    make_slow(True)
    with gui.in_region():
        bpy.ops.wm.window_new()
    yield from gui.wait_until(lambda: len(bpy.context.window_manager.windows) == 2, what="window")
    for _ in range(10):
        yield
    window = bpy.context.window_manager.windows[1]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    with bpy.context.temp_override(window=window, area=area, region=region):
        assert bpy.ops.cubic_craft.cubify("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
        bpy.ops.wm.window_close()
    yield from gui.wait_until(lambda: len(bpy.context.window_manager.windows) == 1, what="close")
    yield from check_cancelled(original)


def open_redo_panel():
    """Open the panel by its header, if it is closed, and return its first row, the cubeness."""
    yield from gui.wait_until(lambda: gui.region("HUD").height > 1, what="the panel")
    yield from gui.wait_redraw()
    panel = gui.region("HUD")
    if panel.height <= 100:
        yield from gui.click((panel.x + panel.width // 2, panel.y + panel.height - 14))
        yield from gui.wait_until(lambda: gui.region("HUD").height > 100, what="the open panel")
    panel = gui.region("HUD")
    row = gui.Button("", panel.x + panel.width // 2, 0, panel.x + panel.width - 20, 0)
    top = panel.y + panel.height - 44
    return gui.Button("", row.left, top - 10, row.right, top + 10)


def brought_to_its_end(original):
    """Then the redo panel, and one step to undo."""
    yield from start(is_slow=False)
    yield from gui.wait_until(is_over, what="the end")
    first = scene.positions()
    assert first != original and "numpy" in scene.settings().status
    scene.check_clean()
    slider = yield from open_redo_panel()
    yield from gui.screenshot("redo_panel.png")
    yield from gui.enter_value(slider, 0.9)
    yield from gui.wait_until(lambda: scene.positions() != first, what="another shape")
    assert abs(scene.settings().cubeness - 0.9) < 1e-6
    yield from gui.screenshot("redone.png")
    redone = scene.positions()
    yield from gui.undo()
    assert scene.positions() == original
    yield from scene.redo()
    assert scene.positions() == redone
    scene.check_bits_of_cubify()
    yield from gui.undo()
    assert scene.positions() == original


def by_another_file():
    """Load one."""
    yield from start()
    with gui.in_region():
        bpy.ops.wm.read_homefile()
    for _ in range(10):
        yield
    assert current() is None
    scene.check_clean()


def test():
    gui.simplify_viewport()
    scene.add_monkey(is_refined=True)
    scene.settings().device = "NUMPY"
    original = scene.positions()
    yield from gui.open_sidebar("Cubic Craft")
    for way in (brought_to_its_end, by_keys, by_button, by_closed_window):
        gui.log(way.__name__)
        yield from way(original)
        scene.settings().device = "NUMPY"
    yield from by_another_file()
    scene.add_monkey(is_refined=True)
    scene.settings().device = "NUMPY"
    yield from gui.open_sidebar("Cubic Craft")
    yield from start()  # and Blender quits while it runs


gui.run(test)
