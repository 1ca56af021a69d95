# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: trixie
"""All ways to confirm Live by hand, and what looks like a way to end it but is none.

test_live.py clicks on its cross, and test_live_around.py cancels it by Esc.
"""

import bpy
import guidrive as gui
import live_scene as scene


def live_settings():
    return bpy.context.window_manager.cubic_craft_live


def confirms(original):
    """Return and Enter over the view, and the button again."""
    confirmed = set()
    for way in ("RET", "NUMPAD_ENTER", "button"):
        yield from scene.start_live()
        yield from scene.wait_idle()
        if way == "button":
            yield from gui.click((yield from scene.button("cubic_craft.live")))
            yield from scene.wait_over()
        else:
            yield from scene.end_by(way)
        assert scene.positions() != original, way
        confirmed.add(scene.positions())
        yield from gui.undo()
        assert scene.positions() == original, way
    assert len(confirmed) == 1

    # Before it has converged, it still goes on to the end.
    yield from scene.start_live()
    yield from scene.end_by("RET")
    assert {scene.positions()} == confirmed
    scene.check_bits_of_cubify()
    with gui.in_region():
        bpy.ops.cubic_craft.restore()
        bpy.ops.ed.undo_push(message="Restore")
    assert scene.positions() == original


def does_not_cancel(original):
    """Use the right mouse button, and Esc where it belongs to the sidebar, menus and fields."""
    slider = yield from scene.cubeness_slider()
    yield from scene.start_live()
    yield from gui.click(slider, "RIGHTMOUSE")
    yield from gui.screenshot("context_menu.png")
    yield from gui.keys("ESC")
    for _ in range(5):
        yield
    yield from scene.wait_idle()
    shape = scene.positions()
    assert shape != original

    # The right mouse button opens Blender's menu in the view, and Esc closes that.
    yield from gui.click(gui.viewport_point(), "RIGHTMOUSE")
    yield from gui.screenshot("context_menu_of_the_view.png")
    yield from gui.keys("ESC")
    for _ in range(5):
        yield
    yield from scene.wait_settled()
    assert scene.is_idle() and scene.positions() == shape

    # Esc gives a typed value up, Return takes it: both belong to the field.
    before = live_settings().cubeness
    yield from gui.enter_value(slider, "0.123", "ESC")
    assert scene.live().current() is not None, "Esc in a field has ended Live"
    assert live_settings().cubeness == before
    yield from scene.wait_idle()
    assert scene.positions() == shape
    yield from gui.enter_value(slider, "0.777")
    assert abs(live_settings().cubeness - 0.777) < 1e-6
    yield from scene.wait_idle_with(lambda: scene.positions() != shape, "the value typed in")
    shape = scene.positions()

    # A drag that is given up by Esc.
    yield from gui.move_mouse(slider.at(0.5))
    gui.events().press("LEFTMOUSE")
    for across in (0.4, 0.3, 0.2):
        yield from gui.move_mouse(slider.at(across))
    assert live_settings().cubeness < 0.7
    yield from gui.keys("ESC")
    gui.events().release("LEFTMOUSE")
    yield
    yield
    assert abs(live_settings().cubeness - 0.777) < 1e-6
    yield from scene.wait_idle_with(lambda: scene.positions() == shape, "the value of before")

    # Return over other editors is theirs.
    outliner = gui.region("WINDOW", "OUTLINER")
    yield from gui.move_mouse((outliner.x + outliner.width // 2, outliner.y + 20))
    yield from gui.keys("RET")
    yield from gui.keys("ESC")
    for _ in range(5):
        yield
    yield from scene.wait_settled()
    assert scene.is_idle()

    yield from scene.end_by("RET")
    assert scene.positions() == shape
    assert abs(scene.settings().cubeness - 0.777) < 1e-6
    scene.check_bits_of_cubify()


def test():
    gui.simplify_viewport()
    scene.add_monkey()
    original = scene.positions()
    yield from gui.open_sidebar("Cubic Craft")
    for moment in (confirms, does_not_cancel):
        gui.log(moment.__name__)
        yield from moment(original)


gui.run(test)
