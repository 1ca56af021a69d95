# SPDX-License-Identifier: GPL-3.0-or-later
"""Show the angles to the form by a click: a ball in many colors becomes cubic and of one color."""

import bpy
import guidrive as gui
import live_scene as scene

BALL = "Ball"


def add_ball():
    """Leave nothing in the scene but a ball, selected and active."""
    with gui.in_region():
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=5)
        bpy.context.object.name = BALL
        bpy.ops.ed.undo_push(message="Add the ball")


def test():
    bpy.context.preferences.system.viewport_aa = "OFF"
    add_ball()
    yield from gui.open_sidebar("Cubic Craft")
    scene.show_front()
    gui.area().spaces.active.region_3d.view_rotation.rotate(
        __import__("mathutils").Euler((-0.2, 0, 0.5))
    )
    yield from gui.screenshot("off.png")
    yield from gui.click((yield from gui.find_button("cubic_craft_angles")))
    yield from gui.wait_until(lambda: bpy.context.window_manager.cubic_craft_angles)
    yield from gui.move_mouse(gui.viewport_point(0.1, 0.02))
    yield from gui.screenshot("ball.png")
    before = scene.positions(BALL)
    yield from gui.click((yield from gui.find_button("cubic_craft.cubify")))
    yield from gui.wait_until(lambda: scene.positions(BALL) != before, what="Cubify")
    yield from gui.screenshot("cubic.png")


gui.run(test)
