# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: trixie
"""Do what docs/first_sculpture.md says, step by step; its pictures are the screenshots of this."""

import bpy
import guidrive as gui
import live_scene as scene
from mathutils import Euler


def set_the_stage():
    bpy.context.preferences.system.use_region_overlap = False  # the view ends at the sidebar
    with gui.in_region():
        scene.add_monkey(levels=2, is_refined=True)
        bpy.ops.object.shade_smooth()
        bpy.ops.ed.undo_push(message="Shade smooth")


def frame_the_view():
    view = gui.area().spaces.active
    view.shading.light = "MATCAP"
    view.shading.show_cavity = True
    view.region_3d.view_rotation = Euler((1.25, 0.0, 0.45)).to_quaternion()
    with gui.in_region():
        bpy.ops.view3d.view_selected()
    yield from gui.wait_redraw()


def test():
    set_the_stage()
    original = scene.positions()
    yield from gui.open_sidebar("Cubic Craft")
    yield from frame_the_view()
    yield from gui.smooth_screenshot("first_1_panel.png")

    yield from gui.click((yield from gui.find_button("cubic_craft.cubify")))
    yield from gui.wait_until(lambda: scene.positions() != original, what="Cubify")
    assert scene.settings().status
    assert "sharp_edge" in bpy.context.object.data.attributes
    yield from gui.smooth_screenshot("first_2_cubify.png")

    yield from scene.start_live()
    slider = yield from gui.find_button("cubic_craft_live.cubeness")
    yield from gui.drag_slider(slider, 0.4, 0.7)
    yield from scene.wait_idle()
    yield from gui.smooth_screenshot("first_3_live.png")
    strong = scene.positions()

    yield from gui.click((yield from gui.find_button("cubic_craft_overlay")))
    turn = yield from gui.find_button("cubic_craft_live.orientation[2]")
    yield from gui.enter_value(turn, 30)
    yield from scene.wait_idle_with(lambda: scene.positions() != strong, "the turned shape")
    yield from gui.smooth_screenshot("first_4_orientation.png")

    yield from scene.press("RET")
    yield from gui.wait_until(scene.is_over, what="the end")
    yield from gui.click((yield from gui.find_button("cubic_craft.restore")))
    yield from gui.wait_until(lambda: scene.positions() == original, what="Restore")
    scene.check_clean()


gui.run(test)
