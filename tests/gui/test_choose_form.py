# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""Cubify by the search, choose a form by hand, follow an edited object, flatten the sides."""

import bpy
import guidrive as gui
import live_scene as scene


def choose(steps):
    """Open the list of forms by a click, go down by so many, and take that one."""
    before = scene.settings().form
    yield from gui.click((yield from gui.find_button("cubic_craft.form")))
    yield 0.5
    yield from gui.keys(*["DOWN_ARROW"] * steps, "RET")
    yield from gui.wait_until(lambda: scene.settings().form != before, what="another form")


def add_form_object():
    """Add a cone beside the monkey, which stays active."""
    monkey = bpy.data.objects[scene.NAME]
    with gui.in_region():
        bpy.ops.mesh.primitive_cone_add(vertices=5, location=(0.0, 3.0, 0.0))
        cone = bpy.context.object
        cone.name = "Gem"
        cone.select_set(False)
        monkey.select_set(True)
        bpy.context.view_layer.objects.active = monkey
        bpy.ops.ed.undo_push(message="Add the cone")
    return cone


def by_search(original):
    yield from gui.move_mouse(gui.viewport_point())
    yield from gui.keys("F3")
    yield 1.0
    yield from gui.type_text("cubicc")
    yield 1.0
    yield from gui.screenshot("search.png")
    yield from gui.keys("RET")
    yield from gui.wait_until(lambda: scene.positions() != original, what="Cubify by the search")
    yield from gui.undo()
    assert scene.positions() == original


def by_click(original):
    yield from choose(4)  # beyond the box, which with equal weights is the cube
    assert scene.settings().form not in ("CUBE", "BOX")
    yield from gui.click((yield from gui.find_button("cubic_craft_overlay")))
    yield from gui.click((yield from gui.find_button("cubic_craft.cubify")))
    yield from gui.wait_until(lambda: scene.positions() != original, what="Cubify")
    yield from gui.screenshot("form.png")
    cubic = scene.positions()
    yield from gui.click((yield from gui.find_button("cubic_craft.flatten")))
    yield from gui.wait_until(lambda: scene.positions() != cubic, what="Flatten Facets")
    yield from gui.screenshot("flat.png")
    yield from gui.undo()
    assert scene.positions() == cubic
    yield from gui.click((yield from gui.find_button("cubic_craft.restore")))
    yield from gui.wait_until(lambda: scene.positions() == original, what="Restore")


def in_live(original):
    add_form_object()
    yield from scene.start_live()
    yield from scene.wait_idle()
    settings = scene.live().live_properties()
    before = scene.positions()
    settings.form_object = "Gem"
    settings.form = "OBJECT"
    yield from scene.wait_idle_with(lambda: scene.positions() != before, "the form of the object")
    yield from gui.screenshot("object.png")
    before = scene.positions()
    gem = bpy.data.objects["Gem"].data
    for vertex in gem.vertices:
        vertex.co.z *= 2.5 if vertex.co.z > 0.5 else 1.0
    gem.update()
    yield from scene.wait_idle_with(lambda: scene.positions() != before, "the edited form")
    yield from gui.screenshot("edited.png")
    yield from scene.end_by("RET")
    assert scene.settings().form_object.name == "Gem" and scene.positions() != original
    scene.check_bits_of_cubify()


def test():
    gui.simplify_viewport()
    gui.area().spaces.active.overlay.show_overlays = True
    scene.add_monkey(levels=1)
    original = scene.positions()
    yield from gui.open_sidebar("Cubic Craft")
    scene.show_front()
    for moment in (by_search, by_click, in_live):
        gui.log(moment.__name__)
        yield from moment(original)


gui.run(test)
