# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""By hand: a half under a Mirror modifier, Symmetry, Keep on Floor, and Hold the Rest."""
# Window: 1280x1200

import bpy
import guidrive as gui
import live_scene as scene
import numpy as np
from mathutils import Matrix

NAME = scene.NAME
FLIP = np.array([-1, 1, 1], np.float32)


def points():
    return np.frombuffer(scene.positions(), np.float32).reshape(-1, 3)


def in_order(V):
    return V[np.lexsort(V.T + np.float32(0))]


def click_cubify():
    before = scene.positions()
    yield from gui.click((yield from gui.find_button("cubic_craft.cubify")))
    yield from gui.wait_until(lambda: scene.positions() != before, what="a change")


def half():
    """Its seam stays closed, and it leans on its other half."""
    scene.add_monkey()
    obj = bpy.context.object
    with gui.in_region():
        scene.halve(obj)
        bpy.ops.ed.undo_push(message="Halve it")
    scene.show_front()
    before = points()
    inside = np.abs(before[:, 0]) < 1e-5
    assert inside.sum() > 30
    yield from gui.screenshot("half_1_before.png")
    yield from click_cubify()
    after = points()
    assert (after[inside, 0] == before[inside, 0]).all(), "the seam has left the plane"
    assert after[:, 0].max() < 1e-3, "the half has gone through the plane"
    yield from gui.screenshot("half_2_cubify.png")


def symmetric():
    """Click on X and on Keep on Floor: halves are equal to the bit, the chin keeps its height."""
    scene.add_monkey()
    scene.show_front()
    before = points()
    yield from gui.click((yield from gui.find_button("cubic_craft.symmetry[0]")))
    yield from gui.click((yield from gui.find_button("cubic_craft.floor")))
    yield 0.5
    yield from gui.screenshot("symmetric_0_floor.png")
    yield from gui.keys("L")  # Lowest Point
    settings = scene.settings()
    assert tuple(settings.symmetry) == (True, False, False) and settings.floor == "ON"
    yield from click_cubify()
    after = points()
    assert (in_order(after) == in_order(after * FLIP)).all()
    assert abs(after[:, 2].min() - before[:, 2].min()) < 1e-5
    yield from gui.screenshot("symmetric_1_cubify.png")
    cubic = scene.positions()
    yield from gui.undo()
    yield from scene.start_live()
    yield from scene.wait_idle()
    assert scene.positions() == cubic, "Live shows another shape than Cubify makes"
    yield from scene.end_by("RET")


def held():
    """Raise an ear: the jaw stays, until Hold the Rest is off."""
    scene.add_monkey(levels=1)
    scene.show_front()
    obj = bpy.context.object
    V = points()
    obj.vertex_groups.new(name="Ear").add(np.flatnonzero(V[:, 0] > 1).tolist(), 1.0, "REPLACE")
    with gui.in_region():
        bpy.ops.cubic_craft.handle_add(group="Ear")
    obj.cubic_craft.handles[0].pose = Matrix.Translation((0.2, 0.0, 0.6))
    obj.cubic_craft.cubeness = 0.0
    jaw = V[:, 2] < -0.7
    yield from click_cubify()
    stays = np.linalg.norm((points() - V)[jaw], axis=1).max()
    yield from gui.screenshot("held_1_stays.png")
    yield from gui.click((yield from gui.find_button("cubic_craft.hold_rest")))
    assert not scene.settings().hold_rest
    yield from click_cubify()
    goes = np.linalg.norm((points() - V)[jaw], axis=1).max()
    yield from gui.screenshot("held_2_goes.png")
    gui.log("the jaw moves by", stays, "and then by", goes)
    assert stays < 0.3 and goes > 2 * stays


def test():
    bpy.context.preferences.system.use_region_overlap = False
    yield from gui.open_sidebar("Cubic Craft")
    for moment in (half, symmetric, held):
        gui.log(moment.__name__)
        yield from moment()
        scene.check_clean()


gui.run(test)
