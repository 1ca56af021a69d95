# SPDX-License-Identifier: GPL-3.0-or-later
"""Pose the ear of the monkey by hand: add a handle, let it follow an empty, drag that, Cubify.

EXPECT_DEVICE in the environment, such as "taichi-cpu", names the backend that must have run.
"""

import os

import bpy
import guidrive as gui
import numpy as np
import open_sections  # noqa: F401

NAME = "Suzanne"
EAR, CHIN = "Ear", "Chin"
EMPTY = f"{NAME} {EAR}"


def monkey():
    return bpy.data.objects[NAME]


def settings():
    return getattr(monkey(), "cubic_craft")  # noqa: B009


def positions():
    vertices = monkey().data.vertices
    values = np.empty(3 * len(vertices), dtype=np.float32)
    vertices.foreach_get("co", values)
    return values.reshape(-1, 3)


def add_monkey():
    """Leave a monkey with two vertex groups, well in view, and push an undo step."""
    with gui.in_region():
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        bpy.ops.mesh.primitive_monkey_add()
        bpy.ops.object.modifier_add(type="SUBSURF")
        bpy.ops.object.modifier_apply(modifier="Subdivision")
        places = positions()
        for group, held in ((CHIN, places[:, 2] < -0.75), (EAR, places[:, 0] > 1.05)):
            monkey().vertex_groups.new(name=group).add(np.flatnonzero(held).tolist(), 1, "REPLACE")
        bpy.ops.view3d.view_axis(type="FRONT")
        bpy.ops.view3d.view_selected()
        bpy.ops.ed.undo_push(message="Add the monkey")
    view = gui.area().spaces.active.region_3d
    view.view_location.x += 1.0  # out from behind the sidebar
    view.view_distance *= 1.3
    held = positions()
    return np.flatnonzero(held[:, 2] < -0.75), np.flatnonzero(held[:, 0] > 1.05)


def click(operator):
    button = yield from gui.find_button(operator)
    yield from gui.click(button)


def cubify(previous):
    yield from click("cubic_craft.cubify")
    yield from gui.wait_until(
        lambda: (positions() != previous).any() and not gui.running_operators(),
        what="a new shape",
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
    yield from gui.screenshot("no_handles.png")

    for number, group in enumerate((EAR, CHIN), start=1):
        yield from click("cubic_craft.handle_add")
        yield from gui.wait_until(lambda n=number: len(settings().handles) == n, what=group)
        assert settings().handles[-1].group == group
    yield from gui.screenshot("handles.png")

    settings().active_handle = 0
    yield from click("cubic_craft.handle_follow")
    yield from gui.wait_until(lambda: EMPTY in bpy.data.objects, what="the empty")
    assert bpy.context.view_layer.objects.active.name == EMPTY
    yield from gui.screenshot("follows.png")

    way = yield from lift_empty()
    assert way.length > 0.3, way
    yield from gui.screenshot("lifted.png")
    assert (positions() == original).all()

    # The empty is still the active object; the panel is that of the monkey.
    posed = yield from cubify(original)
    expected = os.environ.get("EXPECT_DEVICE", "")
    assert expected in settings().status, settings().status
    yield from gui.smooth_screenshot("posed.png")
    assert posed[chin].tobytes() == original[chin].tobytes()
    wanted = (original[ear].astype(np.float64) + np.array(way, dtype=np.float64)).astype(np.float32)
    np.testing.assert_allclose(posed[ear], wanted, rtol=0, atol=3e-7)
    free = np.setdiff1d(np.arange(len(original)), [*chin, *ear])
    assert np.abs(posed[free] - original[free]).max() > 0.2

    monkey().vertex_groups[CHIN].name = "Jaw"
    yield from gui.wait_until(lambda: settings().handles[1].group == "Jaw", what="the new name")
    monkey().vertex_groups["Jaw"].name = CHIN
    yield from gui.wait_until(lambda: settings().handles[1].group == CHIN, what="the old name")

    yield from gui.undo()
    assert (positions() == original).all()
    assert (bpy.data.objects[EMPTY].location - way).length > 0.1
    yield from gui.undo()
    yield from gui.undo()
    assert EMPTY not in bpy.data.objects
    assert [handle.mode for handle in settings().handles] == ["PINNED", "PINNED"]
    yield from gui.screenshot("undone.png")


def pin_selection():
    """In Edit Mode: select the chin, pin it by a click, undo it by one key."""
    with gui.in_region():
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="DESELECT")
        bpy.ops.object.vertex_group_set_active(group=CHIN)
        bpy.ops.object.vertex_group_select()
        bpy.ops.ed.undo_push(message="Select the chin")
    yield from click("cubic_craft.handle_pin_selection")
    yield from gui.wait_until(lambda: len(settings().handles) == 3, what="the handle")
    yield from gui.screenshot("pinned_selection.png")
    assert bpy.context.mode == "OBJECT"
    yield from gui.undo()
    assert monkey().mode == "EDIT"
    assert [group.name for group in monkey().vertex_groups] == [CHIN, EAR]
    assert len(settings().handles) == 2


def both():
    yield from test()
    yield from pin_selection()


gui.run(both)
