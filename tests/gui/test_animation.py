# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: trixie
"""Cubify Animation by a click: watched, stopped by Esc, continued, and undone."""
# Window: 1000x1400

import importlib
import tempfile
from pathlib import Path

import bpy
import guidrive as gui
import live_scene as scene
import numpy as np

TRIANGLE, HEADER = 18, 22  # pixels from the lower left corner of the button above
FRAMES = 5
OPERATOR = "CUBIC_CRAFT_OT_bake_animation"
CUBIC = f"{scene.NAME} Cubic"


def add_bending_monkey():
    """Leave a monkey that bends."""
    scene.add_monkey()
    monkey = bpy.data.objects[scene.NAME]
    bend = monkey.modifiers.new("Bend", "SIMPLE_DEFORM")
    bend.deform_method, bend.deform_axis = "BEND", "Z"
    for frame, angle in ((1, 0.0), (FRAMES, 1.2)):
        bend.angle = angle
        bend.keyframe_insert("angle", frame=frame)
    bpy.context.scene.frame_end = FRAMES
    bpy.context.scene.frame_set(3)
    with gui.in_region():
        bpy.ops.ed.undo_push(message="Bend")


def open_section():
    """Click on the header of the section, which is below that of the result."""
    above = yield from gui.find_button("cubic_craft.sharp_edges")
    yield from gui.click((round(above.left + TRIANGLE - 120), round(above.bottom - HEADER)))
    yield from gui.wait_redraw("UI")


def make_slow(is_slow):
    watched = importlib.import_module(f"{scene.job().__name__}.watched")
    watched._SLICE, watched._TIMER_STEP = (0.0, 0.02) if is_slow else (0.4, 0.01)
    watched._REDRAW_STEP = 0.5  # of the panel, which takes software longer than an iteration
    scene.job().FIRST_SLICE = 0.0 if is_slow else 0.7


def is_over():
    return scene.job().current() is None and OPERATOR not in gui.running_operators()


def cached(folder):
    data = (folder / f"{scene.NAME}.pc2").read_bytes()
    return np.frombuffer(data, "<f4", offset=32).reshape(-1, 3)


def stopped(folder):
    """Start, wait for some frames, and press Esc: they are kept."""
    make_slow(True)
    yield from gui.click((yield from gui.find_button("cubic_craft.bake_animation")))
    yield from gui.wait_until(
        lambda: scene.job().current() and "left" in scene.job().current().step.texts[0],
        what="some frames",
    )
    yield from gui.wait_redraw("UI")
    yield from gui.screenshot("baking.png")
    assert not bpy.ops.cubic_craft.cubify.poll() and not bpy.ops.cubic_craft.bake_animation.poll()
    yield from scene.press("ESC")
    yield from gui.wait_until(is_over, what="the end")
    count = len(cached(folder)) // len(bpy.data.objects[CUBIC].data.vertices)
    gui.log(f"stopped after {count} frames")
    assert 1 <= count < FRAMES
    assert bpy.context.scene.frame_current == 3
    assert bpy.context.object.name == CUBIC and bpy.data.objects[scene.NAME].hide_get()
    yield from gui.wait_redraw("UI")
    return count


def test():
    gui.simplify_viewport()
    folder = Path(tempfile.mkdtemp())
    add_bending_monkey()
    before = scene.positions()
    bpy.context.scene.cubic_craft_animation.folder = str(folder)
    yield from gui.open_sidebar("Cubic Craft")
    scene.show_front()
    yield from open_section()
    yield from stopped(folder)

    make_slow(False)
    yield from gui.click((yield from gui.find_button("cubic_craft.bake_animation")))
    yield from gui.wait_until(
        lambda: is_over() and [path.name for path in folder.iterdir()] == [f"{scene.NAME}.pc2"],
        what="the whole animation",
    )
    assert len(cached(folder)) == FRAMES * len(bpy.data.objects[CUBIC].data.vertices)
    assert scene.positions() == before, "the original mesh was changed"
    scene.check_clean()

    for _ in range(2):  # the bake and its continuation
        yield from gui.undo()
    assert CUBIC not in bpy.data.objects and not bpy.data.objects[scene.NAME].hide_get()
    assert scene.positions() == before


gui.run(test)
