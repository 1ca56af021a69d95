# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""The cubeness map, painted with the mouse while Live runs: the shape follows each stroke."""

import bpy
import guidrive as gui
import live_scene as scene


def weights():
    obj = bpy.data.objects[scene.NAME]
    return tuple(
        next((g.weight for g in vertex.groups if g.group == 0), 0.0) for vertex in obj.data.vertices
    )


def stroke(start, end):
    """Paint from a point of the scene to another; wait until the shape has followed."""
    before, shape = weights(), scene.positions()
    yield from gui.drag(scene.screen_point(start), scene.screen_point(end))
    yield from gui.wait_until(lambda: weights() != before, what="other weights")
    yield from scene.wait_idle_with(lambda: scene.positions() != shape, "the shape of the stroke")


def goes_on():
    assert scene.live().current() is not None
    assert "CUBIC_CRAFT_OT_live" in gui.running_operators()
    assert bpy.context.mode == "PAINT_WEIGHT"


def set_brush(weight):
    unified = bpy.context.scene.tool_settings.weight_paint.unified_paint_settings
    unified.use_unified_size = unified.use_unified_weight = unified.use_unified_strength = True
    unified.size, unified.weight, unified.strength = 40, weight, 1.0


def test():
    scene.add_monkey()
    scene.show_front()
    obj = bpy.data.objects[scene.NAME]
    obj.vertex_groups.new(name="Map").add(range(len(obj.data.vertices)), 0.5, "REPLACE")
    scene.settings().map_group = "Map"
    scene.settings().cubeness = 0.8
    with gui.in_region():
        bpy.ops.object.mode_set(mode="WEIGHT_PAINT")
        bpy.ops.ed.undo_push(message="Weight Paint Mode")
    set_brush(0.0)
    original = scene.positions()
    yield from gui.open_sidebar("Cubic Craft")
    yield from scene.start_live()
    yield from scene.wait_idle()
    yield from gui.screenshot("before_strokes.png")
    first, shape = weights(), scene.positions()

    yield from stroke((-0.7, -1, 0.7), (-0.7, -1, 0.0))
    goes_on()
    yield from gui.screenshot("one_stroke.png")
    one, one_shape = weights(), scene.positions()
    set_brush(1.0)
    yield from stroke((0.6, -1, 0.7), (0.6, -1, 0.0))
    goes_on()
    yield from gui.screenshot("two_strokes.png")
    two, two_shape = weights(), scene.positions()

    # Ctrl-Z takes the strokes back one by one, and Live follows.
    yield from gui.undo()
    assert weights() == one
    goes_on()
    yield from scene.wait_idle_with(lambda: scene.positions() == one_shape, "the shape of before")
    yield from scene.redo()
    assert weights() == two
    yield from scene.wait_idle_with(lambda: scene.positions() == two_shape, "the shape again")
    yield from gui.undo()
    yield from gui.undo()
    assert weights() == first
    goes_on()
    yield from scene.wait_idle_with(lambda: scene.positions() == shape, "the first shape")

    painted = weights()
    yield from scene.end_by("RET")
    assert weights() == painted and bpy.context.mode == "PAINT_WEIGHT"
    confirmed = scene.positions()
    assert confirmed != original
    yield from gui.screenshot("confirmed.png")
    scene.check_bits_of_cubify()


gui.run(test)
