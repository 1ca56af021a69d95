# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""Keys and clicks that belong to Blender while Live runs: none of them is taken for one of ours."""

import os
import pathlib

import bpy
import guidrive as gui
import live_scene as scene

PATH = pathlib.Path(os.environ["GUIDRIVE_SHARE"]) / "saved.blend"


def goes_on():
    assert scene.live().current() is not None
    assert "CUBIC_CRAFT_OT_live" in gui.running_operators()


def deleted(original):
    """By X and Return, which must not confirm; undo brings the object back as it was."""
    yield from scene.start_live()
    yield from scene.press("X")
    yield from gui.keys("RET")
    yield from scene.wait_over()
    assert scene.NAME not in bpy.data.objects
    yield from gui.undo()
    assert scene.positions() == original


def edited(original):
    """Tab into Edit Mode and back: as Enter and then Tab."""
    yield from scene.start_live()
    yield from scene.press("TAB")
    yield from gui.wait_until(lambda: bpy.context.mode == "EDIT_MESH", what="Edit Mode")
    yield from scene.wait_over()
    yield from scene.press("TAB")
    yield from gui.wait_until(lambda: bpy.context.mode == "OBJECT", what="Object Mode")
    confirmed = scene.positions()
    assert confirmed != original
    for _ in range(2):  # the two modes
        yield from gui.undo()
    assert scene.positions() == confirmed and bpy.context.mode == "OBJECT"
    for _ in range(2):  # Live, into Edit Mode, where it has ended
        yield from gui.undo()
    assert scene.positions() == original and bpy.context.mode == "OBJECT"


def add_frame():
    """Add an empty whose axes count beside the monkey, which stays active."""
    with gui.in_region():
        bpy.ops.object.empty_add(type="PLAIN_AXES", radius=0.6, location=(-2.2, 0, 0))
        bpy.context.object.name = "Frame"
        monkey = bpy.data.objects[scene.NAME]
        scene.settings().space, scene.settings().frame = "FRAME", bpy.context.object
        bpy.ops.object.select_all(action="DESELECT")
        monkey.select_set(True)
        bpy.context.view_layer.objects.active = monkey
        bpy.ops.ed.undo_push(message="Add the frame")
    scene.show_front()
    gui.area().spaces.active.overlay.show_overlays = True  # else the empty takes no click
    gui.area().spaces.active.region_3d.view_distance *= 2.0
    yield from gui.wait_redraw()


def turned_by_hand(original):
    """R with the mouse: Live follows meanwhile; Return, Esc and the right button belong to R."""
    yield from add_frame()
    frame = bpy.data.objects["Frame"]
    yield from scene.start_live()
    x, y = scene.screen_point(frame.location)
    yield from gui.click((x, y))
    yield from gui.wait_until(frame.select_get, what="the selected frame")
    yield from scene.wait_idle()
    shape = scene.positions()
    for end in ("RET", "ESC", "RIGHTMOUSE"):
        yield from gui.move_mouse((x + 80, y))
        yield from gui.keys("R")
        yield from gui.move_mouse((x + 60, y + 80))
        yield from gui.wait_until(lambda s=shape: scene.positions() != s, what="a change")
        yield from gui.keys(end)
        for _ in range(5):
            yield
        goes_on()
        if end == "RET":
            yield from scene.wait_idle()
            shape = scene.positions()
        yield from scene.wait_idle_with(lambda s=shape: scene.positions() == s, "the shape")
    turned = scene.positions()
    yield from gui.undo()
    assert not any(bpy.data.objects["Frame"].rotation_euler)
    yield from scene.wait_idle_with(lambda: scene.positions() != turned, "the turn taken back")
    goes_on()
    yield from scene.end_by("ESC")
    assert scene.positions() == original


def files(_original):
    """Ctrl-S, after which Live goes on; Ctrl-N and Return, which end it."""
    bpy.ops.wm.save_as_mainfile(filepath=str(PATH))
    scene.add_monkey()
    yield from scene.start_live()
    before = PATH.stat().st_mtime_ns
    yield from scene.press("CTRL+S")
    yield from gui.wait_until(lambda: PATH.stat().st_mtime_ns != before, what="the file")
    goes_on()
    yield from scene.press("CTRL+N")
    yield from gui.screenshot("new_file.png")
    yield from gui.keys("RET")
    yield from gui.wait_until(lambda: scene.NAME not in bpy.data.objects, what="the new file")
    yield from gui.wait_redraw()


def test():
    gui.simplify_viewport()
    scene.add_monkey()
    scene.show_front()
    original = scene.positions()
    yield from gui.open_sidebar("Cubic Craft")
    for moment in (deleted, edited, turned_by_hand, files):
        gui.log(moment.__name__)
        yield from moment(original)
        scene.check_clean()


gui.run(test)
