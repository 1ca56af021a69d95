# SPDX-License-Identifier: GPL-3.0-or-later
"""Auto Orient for a box whose sides are turned against its axes, seen in the overlay; undo."""

import bpy
import guidrive as gui
import numpy as np
from mathutils import Euler

NAME = "Cube"
TURN = (0.3, 0.2, -0.4)


def orientation():
    return tuple(getattr(bpy.data.objects[NAME], "cubic_craft").orientation)  # noqa: B009


def pixels(path):
    """Return the viewport left of the sidebar, (h,w,4)."""
    image = bpy.data.images.load(path)
    width, height = image.size
    values = np.empty(width * height * 4, dtype=np.float32)
    image.pixels.foreach_get(values)
    bpy.data.images.remove(image)
    view = gui.region()
    values = values.reshape(height, width, 4)
    return values[view.y : view.y + view.height, view.x : gui.region("UI").x]


def test():
    with gui.in_region():
        bpy.data.meshes[NAME].transform(Euler(TURN).to_matrix().to_4x4())
        bpy.context.view_layer.objects.active = bpy.data.objects[NAME]
        bpy.ops.ed.undo_push(message="Turn the box")
    yield from gui.open_sidebar("Cubic Craft")
    button = yield from gui.find_button("cubic_craft.auto_orient")
    yield from gui.click(button)
    yield from gui.wait_until(lambda: any(orientation()), what="an orientation")
    assert max(abs(a - b) for a, b in zip(orientation(), TURN, strict=True)) < 1e-3
    before = pixels((yield from gui.screenshot("oriented.png")))
    switch = yield from gui.find_button("cubic_craft_overlay")
    yield from gui.click(switch)
    yield from gui.wait_until(lambda: bpy.context.window_manager.cubic_craft_overlay)
    with_cube = pixels((yield from gui.screenshot("overlay.png")))
    assert (np.abs(with_cube - before).max(axis=-1) > 0.2).sum() > 500, "no cube is drawn"
    yield from gui.click(switch)
    yield from gui.move_mouse(gui.viewport_point())
    without = pixels((yield from gui.screenshot("overlay_off.png")))
    assert (np.abs(without - with_cube).max(axis=-1) > 0.2).sum() > 500, "the cube stays"
    yield from gui.undo()
    assert not any(orientation())


gui.run(test)
