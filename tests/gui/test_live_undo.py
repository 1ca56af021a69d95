# SPDX-License-Identifier: GPL-3.0-or-later
"""Live and Ctrl-Z: settings, steps from the middle of Live, and Live as one step."""

import bpy
import guidrive as gui
import live_scene as scene


def cubeness():
    return bpy.context.window_manager.cubic_craft_live.cubeness


def frame():
    return bpy.data.objects["Frame"]


def add_frame():
    """Give the monkey a frame object beside it."""
    with gui.in_region():
        bpy.ops.object.empty_add(type="PLAIN_AXES", radius=0.6, location=(-2.2, 0, 0))
        bpy.context.object.name = "Frame"
        monkey = bpy.data.objects[scene.NAME]
        frame().select_set(False)
        monkey.select_set(True)
        bpy.context.view_layer.objects.active = monkey
        scene.settings().space = "FRAME"
        scene.settings().frame = frame()
        bpy.ops.ed.undo_push(message="Add the frame")


def live_goes_on():
    assert scene.live().current() is not None
    assert "CUBIC_CRAFT_OT_live" in gui.running_operators()


def a_slider(original):
    """Take back a drag first; then, as nothing else has been done, Live itself."""
    slider = yield from scene.cubeness_slider()
    yield from scene.start_live()
    start = cubeness()
    yield from gui.drag_slider(slider, 0.5, 0.8)
    dragged = cubeness()
    assert dragged > start
    yield from scene.wait_idle()
    drags = 0
    while cubeness() != start:
        drags += 1
        assert drags < 9  # one of a drag, but for pauses of a slow machine
        yield from scene.press("CTRL+Z")
        live_goes_on()
        yield
    gui.log(f"{drags} step(s) of the drag")
    yield from scene.wait_idle()
    assert gui.counts["undo"] == 0
    yield from scene.end_by("CTRL+Z")
    assert scene.positions() == original
    assert gui.counts["undo"] == 0, "Blender has undone what came before Live"


def one_step(original):
    """Have one step of all that was done in Live."""
    yield from scene.start_live()
    slider = yield from scene.cubeness_slider()
    for end in (0.6, 0.3, 0.7):  # each changes it: at its end, a drag would be a click
        yield from gui.drag_slider(slider, 0.5, end)
        yield from scene.wait_idle()
    yield from scene.end_by("RET")
    confirmed = scene.positions()
    assert confirmed != original
    yield from gui.undo()
    assert scene.positions() == original
    yield from scene.redo()
    assert scene.positions() == confirmed
    yield from gui.undo()
    assert scene.positions() == original
    yield from gui.undo()
    assert scene.NAME not in bpy.data.objects, "the slider has left undo steps"
    scene.check_clean()
    yield from scene.redo()
    assert scene.positions() == original


def steps_from_the_middle(original):
    """Go to steps made while the mesh was on its way: they hold what Live had overwritten."""
    add_frame()
    for end in ("ESC", "RET"):
        yield from scene.start_live()
        frame().location.z += 0.5
        with gui.in_region():
            bpy.ops.ed.undo_push(message="Move the frame")
        moved = frame().location.z
        yield from scene.wait_idle()
        frame().location.z += 0.5
        with gui.in_region():
            bpy.ops.ed.undo_push(message="Move the frame again")
        yield
        yield from scene.end_by(end)
        final = scene.positions()
        assert (final == original) == (end == "ESC")
        yield from gui.undo()  # of Live, or, had it been cancelled, of the second move
        assert scene.positions() == original, "a mesh on its way has come back"
        scene.check_clean()
        if end == "RET":
            yield from gui.undo()
            assert scene.positions() == original
        assert frame().location.z == moved
        yield from gui.undo()
        assert scene.positions() == original and frame().location.z != moved
        scene.check_clean()
        for _ in range(2 + (end == "RET")):
            yield from scene.redo()
            scene.check_clean()
        assert scene.positions() == final
        yield from gui.undo()
        yield from gui.undo()


def test():
    gui.simplify_viewport()
    scene.add_monkey()
    original = scene.positions()
    yield from gui.open_sidebar("Cubic Craft")
    for moment in (a_slider, one_step, steps_from_the_middle):
        gui.log(moment.__name__)
        yield from moment(original)


gui.run(test)
