# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""An original is sculpted, edited and moved while Live shows the new object beside it."""

import bpy
import guidrive as gui
import live_scene as scene
import numpy as np

FOLLOWER = f"{scene.NAME} Cubic"


def points(name=scene.NAME):
    return np.frombuffer(scene.positions(name), np.float32).reshape(-1, 3)


def begin():
    scene.add_monkey(levels=2)
    scene.settings().result = "NEW_OBJECT"
    scene.show_front()
    yield from gui.open_sidebar("Cubic Craft")
    yield from scene.start_live_beside()
    yield from scene.wait_idle()
    assert (points(FOLLOWER) != points()).any()
    with gui.in_region():
        bpy.ops.view3d.view_all()
    gui.area().spaces.active.region_3d.view_distance *= 1.5
    yield from gui.screenshot("follow.png")


def to_mode(mode):
    """Enter a mode as a key or a menu would: Live sees it at its next tick."""
    with gui.in_region():
        bpy.ops.object.mode_set(mode=mode)
    yield from gui.wait_redraw()


def sculpt():
    """Draw real strokes; the follower shows the first before the exact shape is there."""
    before, shown = points(), points(FOLLOWER)
    yield from to_mode("SCULPT")
    yield from scene.wait_idle()
    middle = scene.screen_point(bpy.data.objects[scene.NAME].matrix_world.translation)
    for number in range(3):
        end = (middle[0] + 40, middle[1] + 15 * number)
        yield from gui.drag((middle[0] - 40, middle[1] + 15 * number), end, steps=12)
    assert (points() != before).any(), "no stroke"
    yield from gui.wait_until(lambda: (points(FOLLOWER) != shown).any(), what="the stroke")
    yield from gui.screenshot("follow_stroke.png")
    yield from scene.wait_idle()
    yield from gui.screenshot("follow_sculpted.png")
    assert bpy.context.mode == "SCULPT" and scene.live().current()


def edit():
    """Move some vertices, with others around them."""
    yield from to_mode("EDIT")
    yield from scene.wait_idle()
    shown = points(FOLLOWER).copy()
    with gui.in_region():
        bpy.ops.mesh.select_all(action="DESELECT")
        bpy.ops.mesh.select_random(ratio=0.2)
        bpy.ops.transform.translate(value=(0.0, -0.1, 0.1), use_proportional_edit=True)
    yield from gui.wait_until(lambda: (points(FOLLOWER) != shown).any(), what="the move")
    yield from scene.wait_idle()
    assert bpy.context.mode == "EDIT_MESH" and scene.live().current()
    yield from gui.screenshot("follow_edited.png")


def end():
    yield from to_mode("OBJECT")
    yield from scene.wait_idle()
    yield from scene.end_by("RET")
    result = points(FOLLOWER).copy()
    with gui.in_region():
        bpy.data.objects.remove(bpy.data.objects[FOLLOWER])
        bpy.ops.object.select_all(action="DESELECT")
        bpy.data.objects[scene.NAME].select_set(True)
        bpy.context.view_layer.objects.active = bpy.data.objects[scene.NAME]
        bpy.ops.cubic_craft.cubify()
    assert (points(FOLLOWER) == result).all(), "not what Cubify makes of it"


def test():
    gui.simplify_viewport()
    yield from begin()
    yield from sculpt()
    yield from edit()
    yield from end()


gui.run(test)
