# SPDX-License-Identifier: GPL-3.0-or-later
"""Test of the kit itself, with the extension dummy_ext beside it (see README.md of the tests).

Clicks a button, drags sliders while its modal operator runs, ends it by Enter and Esc, undoes,
types into a field to which it must scroll, takes screenshots.
"""

import sys

import bpy
import guidrive as gui
import numpy as np

status = sys.modules["bl_ext.user_default.dummy_ext"].status


def heights():
    return [round(vertex.co.z, 4) for vertex in bpy.data.meshes["Cube"].vertices]


def start(button):
    yield from gui.click(button)
    yield from gui.wait_until(lambda: status["ticks"] > 1 and not status["end"], what="ticks")
    assert gui.running_operators() == ["DUMMY_OT_run"]


def end(key):
    yield from gui.move_mouse(gui.viewport_point())
    yield from gui.keys(key)
    yield from gui.wait_until(lambda: status["end"] == key, what=f"the end by {key}")
    assert gui.running_operators() == []


def lost_clicks(run):
    """Click on what was grey when the mouse came to it, and on what has moved since."""
    settings = bpy.context.window_manager.dummy_ext
    settings.is_grey = True
    yield from gui.wait_redraw("UI")
    yield from gui.move_mouse(run.at())
    settings.is_grey = False
    yield from gui.wait_redraw("UI")
    yield from start(run)
    yield from end("ESC")
    settings.lines_above = 3
    yield from gui.wait_redraw("UI")
    yield from start(run)
    yield from end("ESC")
    settings.lines_above = 0
    yield from gui.wait_redraw("UI")


def is_black(path):
    image = bpy.data.images.load(path)
    pixels = np.empty(len(image.pixels), dtype=np.float32)  # pyright: ignore[reportArgumentType]
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    return len(np.unique(pixels)) < 10


def test():
    gui.log("Blender", bpy.app.version_string, "Python", sys.version.split()[0])
    gui.simplify_viewport()
    yield from gui.open_sidebar("Dummy")
    run = yield from gui.find_button("dummy.run")
    strength = yield from gui.find_button("dummy_ext.strength")
    speed = yield from gui.find_button("dummy_ext.speed")
    gui.log(run, strength, speed)
    rest = heights()

    # A slider on the Scene: its drag in the middle of the run is an undo step of its own.
    yield from start(run)
    yield from gui.drag_slider(strength, 0.2, 0.8)
    yield from gui.wait_until(lambda: len(status["strengths"]) > 1, what="a new strength")
    path = yield from gui.screenshot("running.png")
    assert gui.running_operators() and bpy.context.scene.dummy_ext.strength > 0.3
    yield from end("RET")
    assert heights() != rest
    yield from gui.undo()
    assert heights() != rest
    yield from gui.undo()
    assert heights() == rest
    assert not is_black(path)

    # A slider on the WindowManager: no undo step.
    yield from start(run)
    yield from gui.drag_slider(speed, 0.2, 0.8)
    yield from gui.wait_until(lambda: len(status["speeds"]) > 1, what="a new speed")
    yield from end("RET")
    assert heights() != rest
    yield from gui.undo()
    assert heights() == rest

    yield from start(run)
    yield from gui.enter_value(speed, 0.75)
    yield from gui.wait_until(lambda: 0.75 in status["speeds"], what="the speed typed in")
    yield from end("ESC")
    assert heights() == rest

    yield from lost_clicks(run)

    note = yield from gui.find_button("dummy_ext.note")
    yield from gui.enter_value(note, "Typed text, v_1.0-2")
    yield from gui.wait_until(
        lambda: bpy.context.scene.dummy_ext.note == "Typed text, v_1.0-2", what="the note"
    )
    yield from gui.screenshot("end.png")
    assert (yield from gui.find_button("dummy.run"))  # scrolls back


gui.run(test)
