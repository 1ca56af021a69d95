# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""Give the selected vertices a form of their own by hand: in the list, by Cubify, and in Live."""
# Window: 1000x1400

import bpy
import guidrive as gui
import live_scene as scene
import numpy as np

TRIANGLE, SWITCH, HEADER = 18, 37, 22  # pixels from the lower left corner of the button above


def array():
    return np.frombuffer(scene.positions(), np.float32).reshape(-1, 3)


def select_the_top():
    """Select the upper half in Edit Mode."""
    mesh = bpy.data.objects[scene.NAME].data
    is_top = array()[:, 2] > 0.2
    for part in (mesh.polygons, mesh.edges):  # these would select their vertices
        part.foreach_set("select", np.zeros(len(part), bool))
    mesh.vertices.foreach_set("select", is_top)
    yield from gui.move_mouse(gui.viewport_point(0.2, 0.2))
    yield from gui.keys("TAB")
    yield from gui.wait_until(lambda: bpy.context.mode == "EDIT_MESH", what="Edit Mode")
    return is_top


def click_header(place):
    """Click in the header of the section, which is below that of the handles."""
    above = yield from gui.find_button("cubic_craft.handle_reset_pose")
    yield from gui.click((round(above.left + place), round(above.bottom - HEADER)))
    yield from gui.wait_redraw("UI")


def open_section():
    """Click on the header of the section, which is closed at first."""
    yield from click_header(TRIANGLE)
    return (yield from gui.find_button("cubic_craft.region_from_selection"))


def test():
    gui.simplify_viewport()
    scene.add_monkey(levels=1)
    original = scene.positions()
    yield from gui.open_sidebar("Cubic Craft")
    scene.show_front()
    is_top = yield from select_the_top()
    yield from gui.click((yield from open_section()))
    regions = scene.settings().regions
    yield from gui.wait_until(lambda: len(regions) == 1, what="the region")
    assert bpy.context.mode == "OBJECT" and regions[0].group == "Region"
    yield from gui.screenshot("added.png")

    regions[0].form = "OCTAHEDRON"  # test_choose_form.py clicks on a selector of forms
    regions[0].cubeness = 1.0
    yield from gui.click((yield from gui.find_button("cubic_craft.cubify")))
    yield from gui.wait_until(lambda: scene.positions() != original, what="Cubify")
    yield from gui.screenshot("cubified.png")
    with_region = array().copy()
    yield from click_header(SWITCH)
    yield from gui.wait_until(lambda: not scene.settings().use_regions, what="the switch")
    yield from gui.click((yield from gui.find_button("cubic_craft.cubify")))
    yield from gui.wait_until(lambda: (array() != with_region).any(), what="Cubify without")
    moved = np.linalg.norm(array() - with_region, axis=1)
    gui.log("moved in the region and elsewhere:", moved[is_top].mean(), moved[~is_top].mean())
    assert moved[is_top].mean() > 1.1 * moved[~is_top].mean(), "not the region has changed"
    yield from gui.undo()
    yield from gui.undo()
    assert scene.settings().use_regions and (array() == with_region).all()

    yield from scene.start_live()
    yield from scene.wait_idle()
    before = scene.positions()
    yield from gui.enter_value((yield from gui.find_button("cubic_craft.regions[0].cubeness")), 0.1)
    yield from scene.wait_idle_with(lambda: scene.positions() != before, "the region to follow")
    assert abs(scene.settings().regions[0].cubeness - 0.1) < 1e-6
    yield from gui.screenshot("live.png")
    yield from scene.end_by("RET")
    scene.check_bits_of_cubify()

    yield from gui.click((yield from gui.find_button("cubic_craft.region_remove")))
    yield from gui.wait_until(lambda: len(scene.settings().regions) == 0, what="the removal")
    yield from gui.undo()
    assert len(scene.settings().regions) == 1


gui.run(test)
