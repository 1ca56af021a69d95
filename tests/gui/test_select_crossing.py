# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""The panel says that faces still cross; the button beside that shows them; Ctrl-Z goes back."""

import json

import bpy
import guidrive as gui
import live_scene as scene

NOTE = "cubic_craft_note"
IN_HEAD = 100
"""a vertex of the head; the eyes are parts of their own"""


def mesh():
    return bpy.data.objects[scene.NAME].data


def note_crossings(count):
    """Write the count that the solver would have found."""
    note = json.loads(mesh()[NOTE])
    note["run"]["crossings"] = count
    mesh()[NOTE] = json.dumps(note)


def squeeze_head():
    """Let the head cross the eyes."""
    with gui.in_region():
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="DESELECT")
        bpy.ops.object.mode_set(mode="OBJECT")
        mesh().vertices[IN_HEAD].select = True
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_linked()
        bpy.ops.transform.resize(value=(0.5, 1.0, 1.0))
        bpy.ops.object.mode_set(mode="OBJECT")


def test():
    gui.simplify_viewport()
    scene.add_monkey(levels=1)
    yield from gui.open_sidebar("Cubic Craft")
    scene.show_front()
    original = scene.positions()
    yield from gui.click((yield from gui.find_button("cubic_craft.cubify")))
    yield from gui.wait_until(lambda: scene.positions() != original, what="Cubify")
    note_crossings(12)
    yield from gui.wait_redraw("UI")
    yield from gui.screenshot("status.png")
    squeeze_head()
    yield from gui.wait_redraw("UI")
    yield from gui.click((yield from gui.find_button("cubic_craft.select_crossing")))
    yield from gui.wait_until(lambda: bpy.context.mode == "EDIT_MESH", what="Edit Mode")
    yield from gui.screenshot("selected.png")
    assert 0 < mesh().total_face_sel < len(mesh().polygons) / 2
    yield from gui.undo()
    yield from gui.wait_until(lambda: bpy.context.mode == "OBJECT", what="Object Mode")


gui.run(test)
