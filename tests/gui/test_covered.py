# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""A modifier that hides the result is named before the click, and what is offered helps."""

import bpy
import guidrive as gui
import live_scene as scene


def test():
    gui.simplify_viewport()
    scene.add_monkey(levels=1)
    monkey = bpy.data.objects[scene.NAME]
    monkey.modifiers.new("Cast", "CAST").factor = 1.0
    original = scene.positions()
    yield from gui.open_sidebar("Cubic Craft")
    scene.show_front()
    yield from gui.screenshot("named.png")
    yield from gui.click((yield from gui.find_button("cubic_craft.cubify")))
    yield from gui.wait_until(lambda: scene.positions() != original, what="Cubify")
    yield from gui.screenshot("warned.png")
    yield from gui.undo()
    assert scene.positions() == original


gui.run(test)
