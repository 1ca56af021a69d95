# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""Auto Orient for a box whose sides are turned against its axes, seen in the overlay; undo."""

import importlib

import bpy
import guidrive as gui
import numpy as np
import open_sections  # noqa: F401
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


def glimpse():
    return importlib.import_module(
        "bl_ext.user_default.cubic_craft.cubic_craft_addon.screen.glimpse"
    )


def glimpse_over():
    """Wait until the cube is not seen any more that was just turned."""
    yield from gui.wait_until(lambda: not glimpse().is_seen(), what="the end of the glimpse")
    yield 0.5


def turned_by_hand():
    """Drag an angle: the cube is seen for a moment, though its overlay is off."""
    before = pixels((yield from gui.screenshot("not_turned.png")))
    glimpse().SECONDS = 3600.0  # a picture takes its time
    yield from gui.drag_slider((yield from gui.find_button("cubic_craft.orientation[2]")))
    assert orientation()[2], "the angle has not been dragged"
    turned = pixels((yield from gui.screenshot("turned_by_hand.png")))
    assert (np.abs(turned - before).max(axis=-1) > 0.2).sum() > 500, "no cube is drawn"
    glimpse().forget()
    glimpse().SECONDS = 0.5
    glimpse().on_turn(None, None)
    yield from glimpse_over()
    after = pixels((yield from gui.screenshot("glimpse_over.png")))
    assert (np.abs(after - turned).max(axis=-1) > 0.2).sum() > 500, "the cube stays"


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
    yield from glimpse_over()
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
    yield from turned_by_hand()


gui.run(test)
