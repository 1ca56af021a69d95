# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""Live in a second window, which is closed; with its viewport maximized; and when Blender quits."""

import bpy
import guidrive as gui
import live_scene as scene


def operators():
    windows = bpy.context.window_manager.windows
    return [operator.bl_idname for window in windows for operator in window.modal_operators]


def open_window():
    with gui.in_region():
        bpy.ops.wm.window_new()
    yield from gui.wait_until(lambda: len(bpy.context.window_manager.windows) == 2, what="window")
    for _ in range(10):
        yield
    return bpy.context.window_manager.windows[1]


def view_of(window):
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    return area, region


def start_in(window):
    has_changed = scene.will_have_changed()
    area, region = view_of(window)
    with bpy.context.temp_override(window=window, area=area, region=region):
        assert bpy.ops.cubic_craft.live("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    yield from gui.wait_until(has_changed, what="a change")
    assert [operator.bl_idname for operator in window.modal_operators] == operators()


def close(window):
    with bpy.context.temp_override(window=window):
        bpy.ops.wm.window_close()
    yield from gui.wait_until(lambda: len(bpy.context.window_manager.windows) == 1, what="close")


def press_in(window, key):
    _, region = view_of(window)
    x, y = region.x + region.width // 3, region.y + region.height // 2
    window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=x, y=y)
    yield
    yield
    for value in ("PRESS", "RELEASE"):
        window.event_simulate(type=key, value=value, x=x, y=y)
        yield
        yield


def closed_with_live(original):
    for is_at_rest in (False, True):
        window = yield from open_window()
        yield from start_in(window)
        if is_at_rest:
            yield from scene.wait_idle()
            yield from gui.screenshot("two_windows.png")
        shown = scene.positions()
        yield from close(window)
        assert not operators()
        scene.check_clean()
        assert scene.positions() != original
        assert scene.positions() == shown or not is_at_rest
        yield from gui.wait_redraw()
        yield from gui.undo()  # of the step that has been pushed in the other window
        assert scene.positions() == original
    yield from scene.start_live()  # it is free again
    yield from scene.end_by("ESC")


def confirmed_there(original):
    """Keys in the window where Live runs end it; a slider in another one wakes it."""
    window = yield from open_window()
    yield from start_in(window)
    yield from scene.wait_idle()
    shape = scene.positions()
    yield from gui.drag_slider((yield from scene.cubeness_slider()), 0.5, 0.8)
    yield from scene.wait_idle_with(lambda: scene.positions() != shape, "another shape")
    yield from press_in(window, "RET")
    yield from scene.wait_over()
    assert not operators()
    assert scene.positions() != original
    scene.check_bits_of_cubify()
    yield from close(window)
    with gui.in_region():
        bpy.ops.cubic_craft.restore()
    assert scene.positions() == original


def maximized(original):
    """Ctrl-Space fills the window with the viewport, and gives the others back."""
    yield from scene.start_live()
    yield from scene.press("CTRL+SPACE")
    yield from gui.wait_until(lambda: gui.window().screen.show_fullscreen, what="the large area")
    yield from gui.wait_redraw()
    yield from scene.wait_idle()
    yield from gui.screenshot("maximized.png")
    assert operators() == ["CUBIC_CRAFT_OT_live"]
    yield from scene.end_by("RET")
    assert scene.positions() != original
    yield from scene.press("CTRL+SPACE")
    yield from gui.wait_until(lambda: not gui.window().screen.show_fullscreen, what="all areas")
    scene.check_bits_of_cubify()
    with gui.in_region():
        bpy.ops.cubic_craft.restore()


def test():
    gui.simplify_viewport()
    scene.add_monkey()
    original = scene.positions()
    yield from gui.open_sidebar("Cubic Craft")
    yield from scene.cubeness_slider()
    yield from scene.button("cubic_craft.live")
    for moment in (closed_with_live, confirmed_there, maximized):
        gui.log(moment.__name__)
        yield from moment(original)
        scene.check_clean()
    yield from open_window()
    yield from scene.start_live()
    yield from scene.wait_idle()  # and Blender quits, with two windows


gui.run(test)
