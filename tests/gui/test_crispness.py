# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: trixie
"""Crispness is dragged in Live at rest: the shape follows without another run."""

import bpy
import guidrive as gui
import live_scene as scene


def steps():
    run = scene.live().current().meshes[0].run
    return run._run.steps


def test():
    gui.simplify_viewport()
    scene.add_monkey(levels=2)
    yield from gui.open_sidebar("Cubic Craft")
    scene.show_front()
    yield from scene.start_live()
    yield from scene.wait_idle()
    before, done = scene.share_facing_axes(6), steps()
    yield from gui.screenshot("crispness_default.png")
    slider = yield from gui.find_button("cubic_craft_live.crispness")
    yield from gui.drag_slider(slider, 0.6, 0.99)
    crispness = bpy.context.window_manager.cubic_craft_live.crispness
    assert crispness > 0.75
    yield from scene.wait_idle()
    assert steps() == done, "it has been solved again"
    assert scene.share_facing_axes(6) > before + 0.02
    yield from gui.screenshot("crispness_dragged.png")
    yield from scene.end_by("RET")
    assert scene.settings().crispness == crispness
    scene.check_bits_of_cubify()


gui.run(test)
