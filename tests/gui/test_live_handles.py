# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: trixie
"""Pose an ear while Live runs: the shape follows the empty, Ctrl-Z brings both back."""

import bpy
import guidrive as gui
import live_scene as scene
import numpy as np

EAR = "Ear"
EMPTY = f"{scene.NAME} {EAR}"


def array():
    return np.frombuffer(scene.positions(), np.float32).reshape(-1, 3)


def empty():
    return bpy.data.objects[EMPTY]


def add_ear():
    """Add the vertex group and a handle that follows an empty; return the vertices of the ear."""
    scene.add_monkey(levels=1)
    ear = np.flatnonzero(array()[:, 0] > 1.05)
    monkey = bpy.data.objects[scene.NAME]
    monkey.vertex_groups.new(name=EAR).add(ear.tolist(), 1.0, "REPLACE")
    scene.show_front()
    with gui.in_region():
        bpy.ops.cubic_craft.handle_add(group=EAR)
        bpy.ops.cubic_craft.handle_follow()
        bpy.ops.ed.undo_push(message="Add the handle")
    return ear


def lift():
    """Press G and move the mouse upward while Live runs; the mesh must move meanwhile."""
    before = array()
    x, y = gui.viewport_point(0.4, 0.4)
    yield from gui.move_mouse((x, y))
    yield from gui.keys("G")
    yield from gui.wait_until(lambda: len(gui.running_operators()) > 1, what="the move")
    for step in range(1, 9):
        yield from gui.move_mouse((x, y + 8 * step))
    yield from gui.wait_until(lambda: (array() != before).any(), what="the mesh to follow")
    yield from gui.screenshot("moving.png")
    yield from gui.click((x, y + 64))
    yield from gui.wait_until(lambda: len(gui.running_operators()) == 1, what="its end")


def test():
    ear = add_ear()
    original = array()
    yield from gui.open_sidebar("Cubic Craft")
    assert bpy.context.view_layer.objects.active.name == EMPTY
    yield from gui.click((yield from gui.find_button("cubic_craft.live")))
    yield from gui.wait_until(lambda: scene.live().current(), what="Live")
    yield from scene.wait_idle()
    at_rest = array()
    np.testing.assert_array_equal(at_rest[ear], original[ear])

    yield from lift()
    yield from scene.wait_idle()
    yield from gui.screenshot("posed.png")
    way = np.array(empty().location) - original[ear].min(axis=0) / 2 - original[ear].max(axis=0) / 2
    assert np.linalg.norm(way) > 0.3, way
    np.testing.assert_allclose(array()[ear] - original[ear], np.tile(way, (len(ear), 1)), atol=1e-5)

    yield from gui.undo()
    yield from gui.wait_until(lambda: scene.live().current(), what="Live to go on")
    yield from scene.wait_idle()
    assert scene.positions() == at_rest.tobytes(), "the move is undone, and Live has followed"

    yield from lift()
    yield from scene.press("RET")
    yield from gui.wait_until(scene.is_over, what="the end")
    scene.check_clean()
    confirmed = scene.positions()
    note = scene.note()
    yield from gui.click((yield from gui.find_button("cubic_craft.cubify")))
    yield from gui.wait_until(lambda: scene.note() != note, what="Cubify")
    yield from gui.wait_redraw()
    assert scene.positions() == confirmed, "Live leaves other bits than Cubify"
    yield from gui.undo()
    yield from gui.undo()
    assert scene.positions() != confirmed
    scene.check_clean()


gui.run(test)
