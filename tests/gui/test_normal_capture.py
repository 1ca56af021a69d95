# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""Pick a ball in the panel, drag its strength, Cubify, and sculpt the ball while Live runs."""

import bpy
import guidrive as gui
import live_scene as scene

HEADER = 60  # pixels from the button below to the middle of the header


def add_ball():
    """Add a ball with square sides beside the monkey, which stays active."""
    monkey = bpy.data.objects[scene.NAME]
    with gui.in_region():
        bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=5, location=(3.0, 0.0, 0.0))
        ball = bpy.context.object
        ball.name = "Cushion"
        shape(ball, 8)
        ball.select_set(False)
        monkey.select_set(True)
        bpy.context.view_layer.objects.active = monkey
        bpy.ops.ed.undo_push(message="Add the ball")
    return ball


def shape(ball, power):
    """Move the vertices along their directions, to square sides or cones."""
    for vertex in ball.data.vertices:
        vertex.co /= sum(abs(x) ** power for x in vertex.co) ** (1 / power)
    ball.data.update()


def open_advanced():
    """Click on the header above that of the next section, which begins with Show Form."""
    below = yield from gui.find_button("cubic_craft_overlay")
    x, y = below.at(0.5)
    yield from gui.click((x, round(y + HEADER)))
    yield from gui.wait_redraw("UI")


def by_click(original):
    yield from open_advanced()
    yield from gui.click((yield from gui.find_button("cubic_craft.capture_object")))
    yield 0.5
    yield from gui.screenshot("list.png")
    yield from gui.keys("DOWN_ARROW", "RET")
    yield from gui.wait_until(lambda: scene.settings().capture_object is not None, what="the ball")
    assert scene.settings().capture_object.name == "Cushion", "it is the only other surface"
    yield 0.5
    before = scene.settings().capture_strength
    slider = yield from gui.find_button("cubic_craft.capture_strength")
    yield from gui.drag_slider(slider, 0.4, 0.9)
    yield from gui.wait_until(
        lambda: scene.settings().capture_strength > before + 0.05, what="more strength"
    )
    scene.settings().cubeness = 0.0
    yield from gui.click((yield from gui.find_button("cubic_craft.cubify")))
    yield from gui.wait_until(lambda: scene.positions() != original, what="Cubify")
    yield from gui.screenshot("cushion.png")
    yield from gui.click((yield from gui.find_button("cubic_craft.restore")))
    yield from gui.wait_until(lambda: scene.positions() == original, what="Restore")


def in_live(original):
    yield from scene.start_live()
    yield from scene.wait_idle_with(lambda: scene.positions() != original, "the capture")
    yield from gui.screenshot("live.png")
    before = scene.positions()
    shape(bpy.data.objects["Cushion"], 1.2)
    yield from scene.wait_idle_with(lambda: scene.positions() != before, "the edited ball")
    yield from gui.screenshot("edited.png")
    yield from scene.end_by("RET")
    assert scene.settings().capture_object.name == "Cushion" and scene.positions() != original
    scene.check_bits_of_cubify()


def test():
    gui.simplify_viewport()
    scene.add_monkey(levels=1)
    original = scene.positions()
    add_ball()
    yield from gui.open_sidebar("Cubic Craft")
    scene.show_front()
    for moment in (by_click, in_live):
        gui.log(moment.__name__)
        yield from moment(original)


gui.run(test)
