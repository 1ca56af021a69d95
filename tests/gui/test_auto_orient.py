# SPDX-License-Identifier: GPL-3.0-or-later
"""Click Auto Orient for a box whose sides are turned against its axes; undo it."""

import bpy
import guidrive as gui
from mathutils import Euler

NAME = "Cube"
TURN = (0.3, 0.2, -0.4)


def orientation():
    return tuple(getattr(bpy.data.objects[NAME], "cubic_craft").orientation)  # noqa: B009


def test():
    with gui.in_region():
        bpy.data.meshes[NAME].transform(Euler(TURN).to_matrix().to_4x4())
        bpy.context.view_layer.objects.active = bpy.data.objects[NAME]
        bpy.ops.ed.undo_push(message="Turn the box")
    yield from gui.open_sidebar("Cubic Craft")
    button = yield from gui.find_button("cubic_craft.auto_orient")
    yield from gui.click(button)
    yield from gui.wait_until(lambda: any(orientation()), timeout=60.0, what="an orientation")
    assert max(abs(a - b) for a, b in zip(orientation(), TURN, strict=True)) < 1e-3
    yield from gui.screenshot("oriented.png")
    yield from gui.undo()
    assert not any(orientation())


gui.run(test)
