# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: trixie
"""A narrow sidebar is read and clicked: clothes that are left behind are named, and come along."""

import importlib

import bpy
import guidrive as gui
import live_scene as scene
import open_sections

NARROW = 180  # pixels
HAT = "Hat"


def add_hat():
    """Put what covers the upper half of the monkey on it, and select the monkey alone."""
    scene.add_monkey(levels=1)
    monkey = bpy.data.objects[scene.NAME]
    with gui.in_region():
        bpy.ops.object.duplicate()
        hat = bpy.context.object
        hat.name, hat.scale = HAT, (1.04, 1.04, 1.04)
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="DESELECT")
        bpy.ops.object.mode_set(mode="OBJECT")
        for face in hat.data.polygons:
            face.select = face.center.z < 0.45
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.delete(type="FACE")
        bpy.ops.object.mode_set(mode="OBJECT")
        hat.select_set(False)
        monkey.select_set(True)
        bpy.context.view_layer.objects.active = monkey
        bpy.ops.ed.undo_push(message="Add a hat")
    scene.show_front()


def make_narrow():
    """Drag the edge of the sidebar."""
    bpy.context.preferences.system.use_region_overlap = False  # the edge is where the region ends
    yield from gui.wait_redraw()
    sidebar = gui.region("UI")
    edge = sidebar.x - 1, sidebar.y + sidebar.height // 4
    yield from gui.drag(edge, (edge[0] + sidebar.width - NARROW, edge[1]), steps=10)
    yield from gui.wait_until(lambda: gui.region("UI").width <= NARROW + 2, what="the narrow one")


def test():
    open_sections.as_shipped()
    add_hat()
    before = scene.positions(HAT)
    yield from gui.open_sidebar("Cubic Craft")
    yield from make_narrow()
    shown = importlib.import_module(f"{scene.EXTENSION}.cubic_craft_addon.worn.panel")
    monkey, hat = (bpy.data.objects[name] for name in (scene.NAME, HAT))
    known = shown._worn._known.values()  # to ask would put off that it is looked for
    yield from gui.wait_until(lambda: any(names == (HAT,) for _, names in known), what="the hint")
    assert shown.left_out(monkey) == [HAT]
    button = yield from gui.find_button("cubic_craft.select_worn")
    yield from gui.screenshot("named.png")
    yield from gui.click(button)
    yield from gui.wait_until(hat.select_get, what="the hat to be selected")
    yield from gui.click((yield from gui.find_button("cubic_craft.cubify")))
    yield from gui.wait_until(lambda: scene.positions(HAT) != before, what="a cubic hat")
    assert scene.note() and shown.left_out(monkey) == []
    yield from gui.screenshot("cubified.png")
    yield from gui.undo()
    assert scene.positions(HAT) == before and not scene.note(), "one step of undo is of both"


gui.run(test)
