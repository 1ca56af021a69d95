# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""Change the cubeness in the redo panel: Cubify runs again, from the original, as one undo step."""

import bpy
import guidrive as gui
import numpy as np
import open_sections  # noqa: F401
import redo_panel

NAME = "Suzanne"


def settings():
    return getattr(bpy.data.objects[NAME], "cubic_craft")  # noqa: B009


def positions():
    vertices = bpy.data.meshes[NAME].vertices
    values = np.empty(3 * len(vertices), dtype=np.float32)
    vertices.foreach_get("co", values)
    return values.tobytes()


def add_monkey():
    with gui.in_region():
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        bpy.ops.mesh.primitive_monkey_add()
        bpy.ops.ed.undo_push(message="Add the monkey")


def cubify():
    button = yield from gui.find_button("cubic_craft.cubify")
    before = positions()
    yield from gui.click(button)
    yield from gui.wait_until(lambda: positions() != before, what="a new shape")


def test():
    add_monkey()
    original = positions()
    yield from gui.open_sidebar("Cubic Craft")
    yield from cubify()
    first = positions()

    slider = yield from redo_panel.open_cubeness()
    yield from gui.screenshot("redo_panel.png")
    yield from gui.enter_value(slider, 0.9)
    yield from gui.wait_until(lambda: positions() != first, what="another shape")
    yield from gui.screenshot("redone.png")
    assert abs(settings().cubeness - 0.9) < 1e-6
    redone = positions()

    # It started from the original, and there is one step to undo.
    yield from gui.undo()
    assert positions() == original
    settings().cubeness = 0.9
    yield from cubify()
    assert positions() == redone

    yield from what_is_no_mesh()
    yield from what_is_under_modifiers()


def start_anew(add):
    with gui.in_region():
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        add()
        bpy.ops.ed.undo_push(message="Add")
    # A draw may come before Blender knows that the object is visible.
    yield from gui.wait_until(may_cubify, what="an object that can be seen")
    yield 1.0
    yield from gui.wait_redraw("UI")


def may_cubify():
    with gui.in_region():
        return bpy.ops.cubic_craft.cubify.poll()


def check_new_object(name):
    """Wait for the new object, and take it back."""
    yield from gui.wait_until(
        lambda: bpy.context.view_layer.objects.active.name == f"{name} Cubic", what="a new object"
    )
    yield from gui.screenshot(f"seen_{name}.png")
    yield from gui.undo()
    assert f"{name} Cubic" not in bpy.data.objects
    assert bpy.context.view_layer.objects.active.name == name


def what_is_no_mesh():
    """Click the one button that there is for a text, which makes a mesh."""
    yield from start_anew(bpy.ops.object.text_add)
    yield from gui.screenshot("text.png")
    yield from gui.click((yield from gui.find_button("cubic_craft.cubify")))
    yield from check_new_object("Text")


def what_is_under_modifiers():
    """Click what the panel offers for a row of cubes."""

    def add():
        bpy.ops.mesh.primitive_cube_add()
        bpy.ops.object.modifier_add(type="ARRAY")

    yield from start_anew(add)
    yield from gui.screenshot("hint.png")
    sidebar = gui.region("UI")
    x = sidebar.x + sidebar.width // 2
    for y in range(sidebar.y + sidebar.height - 40, sidebar.y, -8):
        yield from gui.move_mouse((x, y))
        if "with_modifiers=True" in gui.button_under_mouse():
            break
    yield from gui.click((x, y))
    yield from check_new_object("Cube")


gui.run(test)
