# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""A vertex group with the name of the attribute that holds the original, given in Edit Mode."""

import bpy
import guidrive as gui
import live_scene as scene

OURS = "cubic_craft_original"
NUMBERED = f"{OURS}.001"


def obj():
    return bpy.data.objects[scene.NAME]


def press_tab():
    mode = obj().mode
    yield from scene.press("TAB")
    yield from gui.wait_until(lambda: obj().mode != mode, what="the other mode")
    yield from gui.wait_redraw()


def add_cubic_monkey():
    """Leave a cubified monkey with all its vertices in a group; return its bits before."""
    scene.add_monkey()
    original = scene.positions()
    with gui.in_region():
        group = obj().vertex_groups.new(name="Ear")
        group.add(range(len(obj().data.vertices)), 0.5, "REPLACE")
        bpy.ops.cubic_craft.cubify()
        bpy.ops.ed.undo_push(message="Cubify")
    assert scene.positions() != original
    return original


def rename():
    with gui.in_region():
        obj().vertex_groups[0].name = OURS
        bpy.ops.ed.undo_push(message="Rename")


def check(original):
    """Leave Edit Mode, restore, and check that the original and all of the group are there."""
    yield from press_tab()
    assert obj().mode == "OBJECT"
    with gui.in_region():
        assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert scene.positions() == original
    assert obj().vertex_groups.keys() == [NUMBERED]
    assert all(vertex.groups[0].weight == 0.5 for vertex in obj().data.vertices)
    assert not [a.name for a in obj().data.attributes if a.name.startswith("cubic_craft")]


def left_at_once():
    original = add_cubic_monkey()
    yield from press_tab()
    rename()
    yield from check(original)


def left_after_an_undo():
    """Go back to the undo step of the rename, which holds the name that was typed."""
    original = add_cubic_monkey()
    yield from press_tab()
    rename()
    yield from gui.wait_until(lambda: obj().vertex_groups[0].name == NUMBERED, what="the name")
    with gui.in_region():
        bpy.ops.mesh.subdivide()
        bpy.ops.ed.undo_push(message="Subdivide")
    yield from gui.wait_redraw()
    yield from gui.undo()
    assert obj().mode == "EDIT"
    yield from check(original)


def taken_back_and_done_again():
    original = add_cubic_monkey()
    yield from press_tab()
    rename()
    yield from gui.wait_redraw()
    yield from gui.undo()
    yield from scene.redo()
    yield from gui.wait_redraw()
    assert obj().mode == "EDIT"
    yield from check(original)


def test():
    gui.simplify_viewport()
    for way in (left_at_once, left_after_an_undo, taken_back_and_done_again):
        gui.log(way.__name__)
        yield from way()


gui.run(test)
