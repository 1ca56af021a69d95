# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""Pick faces by hand as the sides of the form, cubify toward them, and undo it."""

import bmesh
import bpy
import guidrive as gui
import live_scene as scene
from mathutils import Vector

BUTTON = "cubic_craft.form_from_selection"
DIRECTIONS = ((0, 0.6, 0.8), (0.9, 0, 0.4), (-0.9, 0, 0.4), (0, -0.8, -0.6))


def choose_selected_faces():
    """Take the last form of the list by hand."""
    yield from gui.click((yield from gui.find_button("cubic_craft.form")))
    yield 0.5
    yield from gui.keys("END", "RET")
    yield from gui.wait_until(lambda: scene.settings().form == "FACES", what="the form")


def select_faces():
    """Select the faces of the monkey that look most along each of the directions."""
    with gui.in_region():
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.context.tool_settings.mesh_select_mode = (False, False, True)
        bpy.ops.mesh.select_all(action="DESELECT")
        mesh = bpy.context.object.data
        edited = bmesh.from_edit_mesh(mesh)
        for direction in map(Vector, DIRECTIONS):
            best = max(edited.faces, key=lambda face: face.normal.dot(direction))
            best.select_set(True)
        bmesh.update_edit_mesh(mesh)
        bpy.ops.ed.undo_push(message="Select faces")


def test():
    gui.simplify_viewport()
    gui.area().spaces.active.overlay.show_overlays = True
    scene.add_monkey(levels=1)
    original = scene.positions()
    yield from gui.open_sidebar("Cubic Craft")
    scene.show_front()
    yield from choose_selected_faces()
    yield from gui.click((yield from gui.find_button("cubic_craft_overlay")))
    yield from gui.screenshot("nothing_picked.png")
    select_faces()
    yield from gui.click((yield from gui.find_button(BUTTON)))
    yield from gui.wait_until(lambda: scene.settings().form_directions, what="the directions")
    assert bpy.context.mode == "OBJECT"
    picked = scene.settings().form_directions
    yield from gui.screenshot("picked.png")
    yield from gui.undo()
    assert bpy.context.mode == "EDIT_MESH" and not scene.settings().form_directions
    assert bpy.context.object.data.total_face_sel == 4
    yield from gui.screenshot("undone.png")
    yield from gui.click((yield from gui.find_button(BUTTON)))
    yield from gui.wait_until(lambda: scene.settings().form_directions == picked, what="the same")
    yield from gui.click((yield from gui.find_button("cubic_craft.cubify")))
    yield from gui.wait_until(lambda: scene.positions() != original, what="Cubify")
    yield from gui.screenshot("cubified.png")
    yield from scene.start_live()
    yield from scene.wait_idle()
    assert scene.live().live_properties().form_directions == picked
    before = scene.positions()
    scene.live().live_properties().cubeness = 0.9
    yield from scene.wait_idle_with(lambda: scene.positions() != before, "more cubeness")
    yield from gui.screenshot("live.png")
    yield from scene.end_by("RET")
    assert scene.settings().form_directions == picked
    scene.check_bits_of_cubify()


gui.run(test)
