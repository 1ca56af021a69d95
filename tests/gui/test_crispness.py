# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: trixie
"""Crispness is dragged in Live at rest: the shape follows without another run."""

import bpy
import guidrive as gui
import live_scene as scene
import numpy as np


def steps():
    run = scene.live().current().meshes[0].run
    return run._run.steps


def flat_share():
    """Return the share of the area that faces an axis within 6 degrees."""
    mesh = bpy.data.objects[scene.NAME].evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    normals, areas = np.empty(3 * len(mesh.polygons)), np.empty(len(mesh.polygons))
    mesh.polygons.foreach_get("normal", normals)
    mesh.polygons.foreach_get("area", areas)
    facing = np.abs(normals.reshape(-1, 3)).max(axis=1) > np.cos(np.radians(6))
    return areas[facing].sum() / areas.sum()


def test():
    gui.simplify_viewport()
    scene.add_monkey(levels=2)
    yield from gui.open_sidebar("Cubic Craft")
    scene.show_front()
    yield from scene.start_live()
    yield from scene.wait_idle()
    before, done = flat_share(), steps()
    yield from gui.screenshot("crispness_default.png")
    slider = yield from gui.find_button("cubic_craft_live.crispness")
    yield from gui.drag_slider(slider, 0.6, 0.99)
    crispness = bpy.context.window_manager.cubic_craft_live.crispness
    assert crispness > 0.75
    yield from scene.wait_idle()
    assert steps() == done, "it has been solved again"
    assert flat_share() > before + 0.02
    yield from gui.screenshot("crispness_dragged.png")
    yield from scene.end_by("RET")
    assert scene.settings().crispness == crispness
    scene.check_bits_of_cubify()


gui.run(test)
