# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""Cubify by the search, choose a form by hand, flatten the sides."""

import guidrive as gui
import live_scene as scene


def choose(steps):
    """Open the list of forms by a click, go down by so many, and take that one."""
    before = scene.settings().form
    yield from gui.click((yield from gui.find_button("cubic_craft.form")))
    yield 0.5
    yield from gui.keys(*["DOWN_ARROW"] * steps, "RET")
    yield from gui.wait_until(lambda: scene.settings().form != before, what="another form")


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


def test():
    gui.simplify_viewport()
    gui.area().spaces.active.overlay.show_overlays = True
    scene.add_monkey(levels=1)
    original = scene.positions()
    yield from gui.open_sidebar("Cubic Craft")
    scene.show_front()
    for moment in (by_search, by_click):
        gui.log(moment.__name__)
        yield from moment(original)


gui.run(test)
