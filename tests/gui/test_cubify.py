# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubify, undo, Cubify with another cubeness, Restore: by the hand of a user, in a window.

EXPECT_DEVICE in the environment, such as "taichi-cpu", names the backend that must have run.
"""

import importlib
import os
import sys

import bpy
import guidrive as gui
import live_scene as scene

ADDON = f"{scene.EXTENSION}.cubic_craft_addon"


def cubify(previous):
    """Click Cubify, wait until the mesh differs from `previous`, and return it."""
    yield from gui.click((yield from gui.find_button("cubic_craft.cubify")))
    yield from changed_from(previous)
    return scene.positions()


def changed_from(previous):
    yield from gui.wait_until(
        lambda: scene.positions() != previous and not gui.running_operators(), what="a new shape"
    )


def changes():
    """Return what the panel calls out of date."""
    run = importlib.import_module(f"{ADDON}.mesh_bridge").last_run(bpy.data.objects[scene.NAME])
    changes_since = importlib.import_module(f"{ADDON}.run.up_to_date").changes_since
    return changes_since(bpy.data.objects[scene.NAME], run) if run else None


def change_and_update(first, place):
    """Drag the slider without Live: the panel says so, and the same button makes it up to date."""
    slider = yield from gui.find_button("cubic_craft.cubeness")
    yield from gui.drag_slider(slider, 0.6, 0.4)
    assert scene.positions() == first
    assert changes() == ["Cubeness"]
    assert (yield from place_of_next_section()) == place, "the panel has jumped"
    yield from gui.screenshot("changed.png")
    yield from cubify(first)
    assert changes() == []


def loaded_ahead():
    """While the panel is looked at, the engine starts and its kernels are loaded."""
    ahead = importlib.import_module(f"{ADDON}.environment.ahead")
    is_waiting = bpy.app.timers.is_registered
    yield from gui.wait_until(lambda: not is_waiting(ahead._next_step), what="what is loaded ahead")
    assert next(ahead._steps, None) is None, "a step has failed, or the panel has asked for none"
    assert {"taichi", "quadrants"} & sys.modules.keys() or not os.environ.get("EXPECT_DEVICE")


def place_of_next_section():
    """Return how far down the first button is that is below the line on the last run."""
    return (yield from gui.find_button("cubic_craft.together")).top


def leave_edit_mode_by_button():
    """In Edit Mode the line on the last run is the way out."""
    yield from gui.move_mouse(gui.viewport_point(0.2, 0.2))
    yield from gui.keys("TAB")
    yield from gui.wait_until(lambda: bpy.context.mode == "EDIT_MESH", what="Edit Mode")
    button = yield from gui.find_button("object.mode_set")
    place = yield from place_of_next_section()
    yield from gui.screenshot("edit_mode.png")
    yield from gui.click(button)
    yield from gui.wait_until(lambda: bpy.context.mode == "OBJECT", what="Object Mode")
    return place


def update_without_moving_the_mouse(original):
    """Of a run that is watched, the button is grey, and after it, it takes a click at once."""
    watched = importlib.import_module(f"{ADDON}.job.watched")
    importlib.import_module(f"{ADDON}.job").FIRST_SLICE = 0.0
    watched._SLICE, watched._TIMER_STEP = 0.0, 0.02  # a phase at a time, so that it is drawn
    cubic = yield from cubify(original)
    scene.settings().cubeness = 0.1
    yield from gui.screenshot("update_at_once.png")
    gui.events().press("LEFTMOUSE")
    yield 0.2
    gui.events().release("LEFTMOUSE")
    yield from changed_from(cubic)


def update_in_the_header():
    """While the panel is scrolled, its buttons are in the header, but not for another tab."""
    before = scene.positions()
    headers = importlib.import_module(f"{ADDON}.ui.header")._drawn
    scene.settings().cubeness = 0.6
    sidebar = gui.region("UI")
    yield from gui.move_mouse((sidebar.x + sidebar.width // 2, sidebar.y + sidebar.height // 2))
    yield from gui.turn_wheel("WHEELDOWNMOUSE", 8)
    yield from gui.wait_until(lambda: any(headers.values()), what="the buttons in the header")
    button = yield from gui.find_button("cubic_craft.cubify", "TOOL_HEADER")
    yield from gui.screenshot("in_the_header.png")
    yield from gui.click(button)
    yield from changed_from(before)
    yield from gui.open_sidebar("Item")
    yield from gui.wait_until(lambda: not any(headers.values()), what="the header without them")
    yield from gui.open_sidebar("Cubic Craft")


def restore(original):
    yield from gui.click((yield from gui.find_button("cubic_craft.restore")))
    yield from gui.wait_until(
        lambda: scene.positions() == original, what="the original, to the bit"
    )


def test():
    scene.add_monkey(levels=1)
    scene.show_front()
    original = scene.positions()
    yield from gui.open_sidebar("Cubic Craft")
    assert changes() is None
    place = yield from place_of_next_section()
    yield from loaded_ahead()
    assert (yield from leave_edit_mode_by_button()) == place, "the panel has jumped"
    assert scene.positions() == original

    first = yield from cubify(original)
    assert os.environ.get("EXPECT_DEVICE", "") in scene.settings().status
    assert changes() == []
    assert (yield from place_of_next_section()) == place, "the panel has jumped"
    yield from gui.screenshot("cubified.png")
    yield from change_and_update(first, place)
    for _ in range(3):  # the update, the slider, and Cubify
        yield from gui.undo()
    assert scene.positions() == original, "Ctrl-Z has not brought the original back"
    assert (yield from cubify(original)) == first
    yield from update_in_the_header()
    yield from restore(original)
    yield from update_without_moving_the_mouse(original)


gui.run(test)
