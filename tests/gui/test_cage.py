# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""A half cage under Mirror and Subdivision in Live: what is seen becomes cubic."""

import bpy
import guidrive as gui
import live_scene as scene


def add_half_cage():
    scene.add_monkey(is_refined=True)
    obj = bpy.context.object
    with gui.in_region():
        scene.halve(obj).use_clip = True
        obj.modifiers.new("Subdivision", "SUBSURF").levels = 2
        bpy.ops.ed.undo_push(message="Halve it")


def test():
    gui.simplify_viewport()
    add_half_cage()
    yield from gui.open_sidebar("Cubic Craft")
    scene.show_front()
    count, before = len(bpy.context.object.data.vertices), scene.share_facing_axes(8)
    yield from gui.screenshot("cage_1_before.png")
    yield from scene.start_live()
    yield from scene.wait_idle()
    assert scene.share_facing_axes(8) > max(0.45, before + 0.2)
    yield from gui.screenshot("cage_2_live.png")
    yield from scene.end_by("RET")
    obj = bpy.data.objects[scene.NAME]
    assert len(obj.data.vertices) == count
    assert [each.type for each in obj.modifiers] == ["MIRROR", "SUBSURF"]
    scene.check_bits_of_cubify()


gui.run(test)
