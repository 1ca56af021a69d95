# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: trixie
"""Pose the ear of the monkey by hand: add a handle, let it follow an empty, drag that, Cubify."""

import bpy
import guidrive as gui
import live_scene as scene
import numpy as np

EAR, CHIN = "Ear", "Chin"
EMPTY = f"{scene.NAME} {EAR}"


def positions():
    return np.frombuffer(scene.positions(), np.float32).reshape(-1, 3)


def add_monkey():
    """Leave a monkey with two vertex groups, which are returned, well in view."""
    scene.add_monkey(levels=1)
    places = positions()
    parts = [np.flatnonzero(places[:, 2] < -0.75), np.flatnonzero(places[:, 0] > 1.05)]
    for group, part in zip((CHIN, EAR), parts, strict=True):
        groups = bpy.data.objects[scene.NAME].vertex_groups
        groups.new(name=group).add(part.tolist(), 1, "REPLACE")
    scene.show_front()
    gui.area().spaces.active.region_3d.view_distance *= 1.3
    with gui.in_region():
        bpy.ops.ed.undo_push(message="Add the groups")
    return parts


def click(operator):
    button = yield from gui.find_button(operator)
    yield from gui.click(button)


def cubify(previous):
    yield from click("cubic_craft.cubify")
    yield from gui.wait_until(
        lambda: (positions() != previous).any() and not gui.running_operators(), what="a new shape"
    )
    return positions()


def lift_empty():
    """Press G and move the mouse upward, then confirm; return how far the empty has gone."""
    before = bpy.data.objects[EMPTY].location.copy()
    x, y = gui.viewport_point(0.4, 0.5)
    yield from gui.move_mouse((x, y))
    yield from gui.keys("G")
    yield from gui.wait_until(gui.running_operators, what="the move")
    for step in range(1, 9):
        yield from gui.move_mouse((x + 2 * step, y + 8 * step))
    yield from gui.click((x + 16, y + 64))
    yield from gui.wait_until(lambda: not gui.running_operators(), what="the end of the move")
    return bpy.data.objects[EMPTY].location - before


def test():
    chin, ear = add_monkey()
    original = positions()
    yield from gui.open_sidebar("Cubic Craft")

    for number, group in enumerate((EAR, CHIN), start=1):
        yield from click("cubic_craft.handle_add")
        yield from gui.wait_until(lambda n=number: len(scene.settings().handles) == n, what=group)
        assert scene.settings().handles[-1].group == group

    scene.settings().active_handle = 0
    yield from click("cubic_craft.handle_follow")
    yield from gui.wait_until(lambda: EMPTY in bpy.data.objects, what="the empty")
    assert bpy.context.view_layer.objects.active.name == EMPTY

    way = yield from lift_empty()
    assert way.length > 0.3, way
    assert (positions() == original).all()

    # The empty is still the active object; the panel is that of the monkey.
    posed = yield from cubify(original)
    yield from gui.smooth_screenshot("posed.png")
    assert posed[chin].tobytes() == original[chin].tobytes()
    wanted = (original[ear].astype(np.float64) + np.array(way, dtype=np.float64)).astype(np.float32)
    np.testing.assert_allclose(posed[ear], wanted, rtol=0, atol=3e-7)
    free = np.setdiff1d(np.arange(len(original)), [*chin, *ear])
    assert np.abs(posed[free] - original[free]).max() > 0.2

    yield from gui.undo()
    assert (positions() == original).all()
    assert (bpy.data.objects[EMPTY].location - way).length > 0.1
    yield from gui.undo()
    yield from gui.undo()
    assert EMPTY not in bpy.data.objects
    assert [handle.mode for handle in scene.settings().handles] == ["PINNED", "PINNED"]


gui.run(test)
