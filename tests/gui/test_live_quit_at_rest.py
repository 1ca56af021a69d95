# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""Blender is quit while Live rests, in a second window, too."""

import bpy
import guidrive as gui
import live_scene as scene


def test():
    gui.simplify_viewport()
    scene.add_monkey()
    yield from gui.open_sidebar("Cubic Craft")
    yield from scene.button("cubic_craft.live")
    with gui.in_region():
        bpy.ops.wm.window_new()
    for _ in range(10):
        yield
    yield from scene.start_live()
    yield from scene.wait_idle()


gui.run(test)
