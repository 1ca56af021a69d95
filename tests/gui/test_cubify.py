# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubify, undo, Cubify with another cubeness, edit, Restore: by the hand of a user, in a window.

EXPECT_DEVICE in the environment, such as "taichi-cpu", names the backend that must have run.
"""

import importlib
import os
import sys

import bpy
import guidrive as gui
import numpy as np
import open_sections  # noqa: F401

ADDON = "bl_ext.user_default.cubic_craft.cubic_craft_addon"
NAME = "Suzanne"  # of the monkey and of its mesh
SETTINGS = "cubic_craft"  # the property of objects


def cubic_craft():
    """Return the object's settings, looked up anew as an undo makes old references invalid."""
    return getattr(bpy.data.objects[NAME], SETTINGS)


def positions():
    vertices = bpy.data.meshes[NAME].vertices
    values = np.empty(3 * len(vertices), dtype=np.float32)
    vertices.foreach_get("co", values)
    return values


def is_bitwise(values, wanted):
    return values.tobytes() == wanted.tobytes()


def add_monkey():
    """Leave a subdivided monkey, well in view, as the only object, and push an undo step."""
    with gui.in_region():
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        bpy.ops.mesh.primitive_monkey_add()
        bpy.ops.object.modifier_add(type="SUBSURF")
        bpy.ops.object.modifier_apply(modifier="Subdivision")
        bpy.ops.object.shade_flat()
        bpy.ops.view3d.view_axis(type="FRONT")
        bpy.ops.view3d.view_selected()
        bpy.ops.ed.undo_push(message="Add the monkey")
    gui.area().spaces.active.region_3d.view_location.x += 0.7  # out from behind the sidebar
    assert bpy.context.view_layer.objects.active == bpy.data.objects[NAME]


def cubify(previous):
    """Click Cubify, wait until the mesh differs from `previous`, check it, return it."""
    button = yield from gui.find_button("cubic_craft.cubify")
    yield from gui.click(button)
    yield from gui.wait_until(
        lambda: not is_bitwise(positions(), previous) and not gui.running_operators(),
        what="a new shape",
    )
    result = positions()
    assert np.isfinite(result).all()
    assert np.ptp(result) < 2 * np.ptp(previous), "the mesh has exploded"
    return result


def check_status():
    """Check that the status line tells what the run was, and by which backend."""
    status = cubic_craft().status
    gui.log("status:", status)
    assert status
    expected = os.environ.get("EXPECT_DEVICE")
    if expected:
        assert expected in status, f"{expected} did not run: {status}"
    else:
        assert any(name in status for name in ("taichi", "quadrants", "numpy")), status


def changes():
    """Return what the panel calls out of date."""
    run = importlib.import_module(f"{ADDON}.mesh_bridge").last_run(bpy.data.objects[NAME])
    changes_since = importlib.import_module(f"{ADDON}.run.up_to_date").changes_since
    return changes_since(bpy.data.objects[NAME], run) if run else None


def change_and_update(first, place):
    """Drag the slider without Live: the panel says so, and the same button makes it up to date."""
    slider = yield from gui.find_button("cubic_craft.cubeness")
    yield from gui.drag_slider(slider, 0.8, 0.2)
    assert is_bitwise(positions(), first)
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


def edit_by_hand():
    """Move some vertices in Edit Mode; return the new shape."""
    yield from gui.move_mouse(gui.viewport_point(0.2, 0.2))
    yield from gui.keys("TAB")
    yield from gui.wait_until(lambda: bpy.context.mode == "EDIT_MESH", what="Edit Mode")
    with gui.in_region():
        bpy.ops.mesh.select_all(action="DESELECT")
        bpy.ops.mesh.select_random(ratio=0.05)
        bpy.ops.transform.translate(value=(0, 0, 0.2))
    yield from gui.keys("TAB")
    yield from gui.wait_until(lambda: bpy.context.mode == "OBJECT", what="Object Mode")
    return positions()


def start_from_the_original(cubic):
    """Edit the result; the panel offers three, and the original gives the same result again."""
    edited = yield from edit_by_hand()
    assert not is_bitwise(edited, cubic)
    choice = yield from gui.find_button("cubic_craft.start")
    assert cubic_craft().start == "EDITS"
    yield from gui.screenshot("edited.png")
    yield from gui.click((choice.at()[0], choice.top - 50))  # the lowest of three in a column
    yield from gui.wait_until(lambda: cubic_craft().start == "ORIGINAL", what="the other choice")
    yield from gui.screenshot("from_the_original.png")
    assert is_bitwise((yield from cubify(edited)), cubic)
    assert cubic_craft().start == "EDITS"
    yield from gui.screenshot("not_edited.png")


def update_without_moving_the_mouse(original):
    """Of a run that is watched, the button is grey, and after it, it takes a click at once."""
    watched = importlib.import_module(f"{ADDON}.job.watched")
    importlib.import_module(f"{ADDON}.job").FIRST_SLICE = 0.0
    watched._SLICE, watched._TIMER_STEP = 0.0, 0.02  # a phase at a time, so that it is drawn
    cubic = yield from cubify(original)
    cubic_craft().cubeness = 0.1
    yield from gui.screenshot("update_at_once.png")
    gui.events().press("LEFTMOUSE")
    yield 0.2
    gui.events().release("LEFTMOUSE")
    yield from gui.wait_until(
        lambda: not is_bitwise(positions(), cubic) and not gui.running_operators(),
        what="the update",
    )


def update_in_the_header():
    """While the panel is scrolled, its buttons are in the header, but not for another tab."""
    before = positions()
    headers = importlib.import_module(f"{ADDON}.ui.header")._drawn
    cubic_craft().cubeness = 0.6
    sidebar = gui.region("UI")
    yield from gui.move_mouse((sidebar.x + sidebar.width // 2, sidebar.y + sidebar.height // 2))
    yield from gui.turn_wheel("WHEELDOWNMOUSE", 8)
    yield from gui.wait_until(lambda: any(headers.values()), what="the buttons in the header")
    button = yield from gui.find_button("cubic_craft.cubify", "TOOL_HEADER")
    yield from gui.screenshot("in_the_header.png")
    yield from gui.click(button)
    yield from gui.wait_until(
        lambda: not is_bitwise(positions(), before) and not gui.running_operators(),
        what="the update",
    )
    yield from gui.open_sidebar("Item")
    yield from gui.wait_until(lambda: not any(headers.values()), what="the header without them")
    yield from gui.open_sidebar("Cubic Craft")


def test():
    add_monkey()
    original = positions()
    yield from gui.open_sidebar("Cubic Craft")
    yield from gui.screenshot("original.png")
    assert changes() is None
    place = yield from place_of_next_section()
    yield from loaded_ahead()
    assert (yield from leave_edit_mode_by_button()) == place, "the panel has jumped"
    assert is_bitwise(positions(), original)

    first = yield from cubify(original)
    check_status()
    assert changes() == []
    assert (yield from place_of_next_section()) == place, "the panel has jumped"
    yield from gui.screenshot("cubified.png")
    yield from change_and_update(first, place)
    yield from gui.undo()  # the update
    yield from gui.undo()  # the slider
    yield from gui.undo()
    assert is_bitwise(positions(), original), "Ctrl-Z has not brought the original back"
    yield from gui.screenshot("undone.png")

    before = cubic_craft().cubeness
    slider = yield from gui.find_button("cubic_craft.cubeness")
    yield from gui.drag_slider(slider, 0.4, 0.9)
    cubeness = cubic_craft().cubeness
    assert cubeness > before, f"cubeness went from {before} to {cubeness}"
    second = yield from cubify(original)
    assert not is_bitwise(second, first), "the cubeness made no difference"
    yield from gui.screenshot("more_cubic.png")

    yield from start_from_the_original(second)
    yield from edit_by_hand()
    restore = yield from gui.find_button("cubic_craft.restore")
    yield from gui.click(restore)
    yield from gui.wait_until(
        lambda: is_bitwise(positions(), original), what="the original shape, bit for bit"
    )
    yield from gui.screenshot("restored.png")
    yield from update_in_the_header()
    yield from gui.click((yield from gui.find_button("cubic_craft.restore")))
    yield from gui.wait_until(lambda: is_bitwise(positions(), original), what="the original")
    yield from update_without_moving_the_mouse(original)


gui.run(test)
