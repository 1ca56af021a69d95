# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""Undo while Live runs, of what the artist has done to another object."""

import bpy
import guidrive as gui
import live_scene as scene


def frame():
    return bpy.data.objects["Frame"]


def add_frame():
    """Give the monkey a frame object beside it."""
    with gui.in_region():
        bpy.ops.object.empty_add(type="PLAIN_AXES", radius=0.6, location=(-2.2, 0, 0))
        bpy.context.object.name = "Frame"
        monkey = bpy.data.objects[scene.NAME]
        frame().select_set(False)
        monkey.select_set(True)
        bpy.context.view_layer.objects.active = monkey
        scene.settings().space = "FRAME"
        scene.settings().frame = frame()
        bpy.ops.ed.undo_push(message="Add the frame")


def live_goes_on():
    assert scene.live().current() is not None
    assert "CUBIC_CRAFT_OT_live" in gui.running_operators()


def a_turned_frame(original):
    """Blender takes back what was done to another object, and Live follows."""
    add_frame()
    scene.show_front()
    gui.area().spaces.active.region_3d.view_distance *= 2.0
    yield from gui.wait_redraw()
    yield from scene.start_live()
    yield from scene.wait_idle()
    first = scene.positions()
    yield from gui.screenshot("frame.png")
    yield from gui.click(scene.screen_point(frame().location))
    yield from gui.wait_until(lambda: frame().select_get(), what="the selected frame")
    live_goes_on()
    yield from gui.keys("R", "Y")
    yield from gui.type_text("30")
    yield from gui.keys("RET")
    yield from scene.wait_idle_with(lambda: scene.positions() != first, "the turned shape")
    yield from gui.screenshot("frame_turned.png")
    turned = scene.positions()
    live_goes_on()
    assert frame().rotation_euler.y
    yield from gui.undo()
    assert not any(frame().rotation_euler)
    yield from scene.wait_idle_with(lambda: scene.positions() == first, "the shape of before")
    live_goes_on()
    yield from scene.redo()
    assert frame().rotation_euler.y
    yield from scene.wait_idle_with(lambda: scene.positions() == turned, "the turned shape again")
    live_goes_on()

    # From the Edit menu.
    with gui.in_region():
        bpy.ops.ed.undo()
    yield from scene.wait_idle_with(lambda: scene.positions() == first, "the shape of before")
    with gui.in_region():
        bpy.ops.ed.redo()
    yield from scene.wait_idle_with(lambda: scene.positions() == turned, "the turned shape again")
    live_goes_on()
    yield from scene.end_by("ESC")
    assert scene.positions() == original


def a_moved_frame(original):
    """Move it only: that changes no shape, but it is what Ctrl-Z takes back."""
    place = tuple(frame().location)
    with gui.in_region():
        monkey = bpy.data.objects[scene.NAME]
        bpy.ops.object.select_all(action="DESELECT")
        monkey.select_set(True)
        bpy.context.view_layer.objects.active = monkey
        bpy.ops.ed.undo_push(message="Select the monkey")
    yield from scene.start_live()
    yield from scene.wait_idle()
    first = scene.positions()
    start = scene.screen_point(frame().location)
    yield from gui.click(start)
    yield from gui.wait_until(lambda: frame().select_get(), what="the selected frame")
    yield from gui.keys("G")
    yield from gui.move_mouse((start[0] + 20, start[1] + 60))
    yield from gui.click((start[0] + 20, start[1] + 60))
    yield from gui.wait_until(lambda: tuple(frame().location) != place, what="the move")
    yield from scene.wait_idle()
    yield from gui.undo()
    assert tuple(frame().location) == place
    live_goes_on()
    yield from scene.wait_idle_with(lambda: scene.positions() == first, "the same shape")
    # What remains is the click that has selected it, and nothing of before Live.
    for _ in range(2):
        if scene.live().current():
            yield from scene.press("CTRL+Z")
            yield from scene.wait_settled()
    yield from scene.wait_over()
    assert scene.positions() == original
    assert "Frame" in bpy.data.objects and scene.settings().space == "FRAME"


def test():
    scene.add_monkey()
    original = scene.positions()
    yield from gui.open_sidebar("Cubic Craft")
    for moment in (a_turned_frame, a_moved_frame):
        gui.log(moment.__name__)
        yield from moment(original)


gui.run(test)
