# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""Show the angles to the form by a click: a ball in bright colors, its cube in dark ones.

The pictures prove it: the surface is bright where it does not lie in a side of the form.
"""

import bpy
import guidrive as gui
import live_scene as scene
import numpy as np
from mathutils import Euler, Vector

BALL = "Ball"
LEGEND = 209, 94  # pixels, with a little of the distance from the corner
FEW, MANY = 0.02, 0.25  # of the pixels


def add_ball():
    """Leave nothing in the scene but a ball, selected and active, seen from above a corner."""
    with gui.in_region():
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=5)
        bpy.context.object.name = BALL
        bpy.ops.ed.undo_push(message="Add the ball")
    view = gui.area().spaces.active.region_3d
    view.view_rotation = Euler((1.1, 0.0, 0.6)).to_quaternion()
    view.view_distance = 4.5
    view.view_location = view.view_rotation @ Vector((0.7, 0.0, 0.0))  # not behind the sidebar


def picture(name):
    """Return what is visible of the viewport, (h,w,3) from the bottom row up."""
    yield from gui.move_mouse(gui.viewport_point(0.02, 0.3))
    image = bpy.data.images.load((yield from gui.screenshot(f"{name}.png")))
    width, height = image.size
    values = np.empty((height, width, 4), dtype=np.float32)
    image.pixels.foreach_get(values.ravel())
    bpy.data.images.remove(image)
    view = gui.region()
    return values[view.y : view.y + view.height, view.x : gui.region("UI").x, :3]


def shares(pixels):
    """Return the shares of the pixels in the colors of large angles, and of small ones."""
    red, green, blue = np.moveaxis(pixels, -1, 0)
    is_large = (red > 0.5) & (green > 0.45) & (blue < 0.4)
    is_small = (blue > red + 0.15) & (blue > green + 0.02)
    return is_large.mean(), is_small.mean()


def check(name, is_shown, is_cubic=False):
    """Check the colors on the surface in the middle of the view, and in the legend."""
    pixels = yield from picture(name)
    height, width = pixels.shape[:2]
    middle = pixels[int(0.3 * height) : int(0.8 * height), int(0.25 * width) : int(0.75 * width)]
    large, small = shares(middle)
    corner = pixels[: LEGEND[1], -LEGEND[0] :]
    bar = shares(corner)
    gui.log(f"{name}: {large:.3f}, {small:.3f}, legend {bar[0]:.3f}, {bar[1]:.3f}")
    if is_shown:
        assert (small if is_cubic else large) > MANY, "the surface does not have the colors"
        assert (large if is_cubic else small) < MANY / 2, "the surface has the wrong colors"
        assert (corner.max(axis=-1) < 0.2).mean() > 0.5, "the legend has no backdrop"
        assert (corner.min(axis=-1) > 0.7).mean() > 0.01, "the legend has no text"
        assert min(bar) > 0.01, "the legend has no bar"
    else:
        assert max(large, small) < FEW, "the surface has the colors"
        assert max(bar) < 0.01, "the legend is shown"


def by_click(switch, original):
    yield from check("off", is_shown=False)
    yield from gui.click(switch)
    yield from gui.wait_until(lambda: bpy.context.window_manager.cubic_craft_angles)
    yield from check("ball", is_shown=True)
    yield from gui.click((yield from gui.find_button("cubic_craft.cubify")))
    yield from gui.wait_until(lambda: scene.positions(BALL) != original, what="Cubify")
    yield from check("cubic", is_shown=True, is_cubic=True)
    yield from gui.undo()
    yield from gui.wait_until(lambda: scene.positions(BALL) == original, what="undo")
    assert bpy.context.window_manager.cubic_craft_angles, "the switch is no step of undo"
    yield from check("undone", is_shown=True)


def test():
    bpy.context.preferences.system.viewport_aa = "OFF"
    add_ball()
    original = scene.positions(BALL)
    yield from gui.open_sidebar("Cubic Craft")
    switch = yield from gui.find_button("cubic_craft_angles")
    yield from by_click(switch, original)
    yield from gui.click((yield from gui.find_button("cubic_craft_angles")))  # perhaps scrolled
    yield from gui.wait_until(lambda: not bpy.context.window_manager.cubic_craft_angles)
    yield from check("off_again", is_shown=False)


gui.run(test)
