# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""The cube of Live: a frame object that is turned and moved by hand, the overlay, Auto Orient."""

import bpy
import guidrive as gui
import live_scene as scene
import numpy as np
from mathutils import Euler


def frame():
    return bpy.data.objects["Frame"]


def pixels(path):
    image = bpy.data.images.load(path)
    width, height = image.size
    values = np.empty(width * height * 4, dtype=np.float32)
    image.pixels.foreach_get(values)
    bpy.data.images.remove(image)
    view = gui.region()
    values = values.reshape(height, width, 4)
    return values[view.y : view.y + view.height, view.x : gui.region("UI").x]


def are_different(one, other):
    return (np.abs(one - other).max(axis=-1) > 0.2).sum() > 300


def add_frame():
    with gui.in_region():
        bpy.ops.object.empty_add(type="PLAIN_AXES", radius=0.6, location=(-2.2, 0, 0))
        bpy.context.object.name = "Frame"
        frame().select_set(False)
        monkey = bpy.data.objects[scene.NAME]
        monkey.select_set(True)
        bpy.context.view_layer.objects.active = monkey
        scene.settings().space = "FRAME"
        scene.settings().frame = frame()
        bpy.ops.ed.undo_push(message="Add the frame")
    scene.show_front()
    gui.area().spaces.active.region_3d.view_distance *= 2.0


def turned_by_hand():
    """R with the mouse: Live follows while it is being turned, and Return belongs to R."""
    start = scene.screen_point(frame().location)
    yield from gui.click(start)
    yield from gui.wait_until(lambda: frame().select_get(), what="the selected frame")
    yield from scene.wait_idle()
    first = scene.positions()
    yield from gui.move_mouse((start[0] + 80, start[1]))
    yield from gui.keys("R")
    for step in range(1, 5):
        yield from gui.move_mouse((start[0] + 80, start[1] + 15 * step))
    yield from gui.wait_until(lambda: scene.positions() != first, what="a change while turning")
    yield from scene.wait_idle()
    shape = scene.positions()
    yield from gui.screenshot("turning.png")
    yield from gui.keys("RET")
    for _ in range(5):
        yield
    assert scene.live().current() is not None and frame().rotation_euler.y
    yield from scene.wait_idle()
    assert scene.positions() == shape

    # Esc of R gives the turn up, and Live goes back along.
    yield from gui.keys("R")
    yield from gui.move_mouse((start[0] + 60, start[1] + 80))
    yield from gui.wait_until(lambda: scene.positions() != shape, what="a change while turning")
    yield from gui.keys("ESC")
    for _ in range(5):
        yield
    assert scene.live().current() is not None, "Esc of R has cancelled Live"
    yield from scene.wait_idle_with(lambda: scene.positions() == shape, "the shape of before")

    # So does the right mouse button.
    yield from gui.move_mouse((start[0] + 80, start[1]))
    yield from gui.keys("R")
    yield from gui.move_mouse((start[0] + 60, start[1] + 80))
    yield from gui.click((start[0] + 60, start[1] + 80), "RIGHTMOUSE")
    for _ in range(5):
        yield
    assert scene.live().current() is not None, "the right button of R has cancelled Live"
    yield from scene.wait_idle_with(lambda: scene.positions() == shape, "the shape of before")

    # G: nothing to compute, and nothing ends.
    yield from gui.keys("G")
    yield from gui.move_mouse((start[0] + 70, start[1] + 60))
    yield from gui.click((start[0] + 70, start[1] + 60))
    yield from gui.wait_until(lambda: frame().location.z, what="the move")
    yield from scene.wait_idle_with(lambda: scene.positions() == shape, "the same shape")


def seen_in_the_overlay():
    with gui.in_region():  # the panel is that of the active object
        bpy.context.view_layer.objects.active = bpy.data.objects[scene.NAME]
    yield from gui.move_mouse(gui.viewport_point())
    before = pixels((yield from gui.screenshot("without_cube.png")))
    switch = yield from gui.find_button("cubic_craft_overlay")
    yield from gui.click(switch)
    yield from gui.wait_until(lambda: bpy.context.window_manager.cubic_craft_overlay)
    yield from gui.move_mouse(gui.viewport_point())
    with_cube = pixels((yield from gui.screenshot("with_cube.png")))
    assert are_different(before, with_cube)
    frame().rotation_euler.y += 0.4
    before_shape = scene.positions()
    yield from scene.wait_idle_with(lambda: scene.positions() != before_shape, "the turned shape")
    assert are_different(with_cube, pixels((yield from gui.screenshot("turned_cube.png"))))


def auto_orient():
    live_settings = bpy.context.window_manager.cubic_craft_live
    live_settings.space = "OBJECT"
    yield
    yield from scene.wait_idle()
    before = scene.positions()
    yield from gui.click((yield from gui.find_button("cubic_craft.auto_orient")))
    yield from gui.wait_until(lambda: any(live_settings.orientation), what="an orientation")
    yield from scene.wait_idle_with(lambda: scene.positions() != before, "the oriented shape")
    yield from gui.screenshot("auto_oriented.png")
    found = tuple(live_settings.orientation)
    # It is a setting: Ctrl-Z takes it back, and does not undo in Blender.
    undone = gui.counts["undo"]
    yield from scene.press("CTRL+Z")
    yield from gui.wait_until(lambda: not any(live_settings.orientation), what="take back")
    assert gui.counts["undo"] == undone
    yield from scene.wait_idle_with(lambda: scene.positions() == before, "the shape of before")
    live_settings.orientation = found
    yield from scene.wait_idle_with(lambda: scene.positions() != before, "the oriented shape")


def test():
    scene.add_monkey()
    bpy.data.objects[scene.NAME].data.transform(Euler((0.3, 0.2, -0.4)).to_matrix().to_4x4())
    add_frame()
    original = scene.positions()
    yield from gui.open_sidebar("Cubic Craft")
    yield from scene.start_live()
    for moment in (turned_by_hand, seen_in_the_overlay, auto_orient):
        gui.log(moment.__name__)
        yield from moment()
        assert scene.live().current() is not None
    yield from scene.end_by("RET")
    assert scene.positions() != original
    assert any(scene.settings().orientation) and scene.settings().space == "OBJECT"
    with gui.in_region():
        frame().select_set(False)
        bpy.data.objects[scene.NAME].select_set(True)
        bpy.context.view_layer.objects.active = bpy.data.objects[scene.NAME]
    scene.check_bits_of_cubify()


gui.run(test)
