# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""Live: watch, drag the slider, take back, confirm as one step that equals Cubify; cancel."""

import bpy
import guidrive as gui
import live_scene as scene
import numpy as np
from mathutils import Matrix

FLAT = np.cos(np.radians(6.0))


def cubeness():
    return bpy.context.window_manager.cubic_craft_live.cubeness


def a_slider(original):
    """Take back a drag first; then, as nothing else has been done, Live itself."""
    slider = yield from scene.cubeness_slider()
    yield from scene.start_live()
    start = cubeness()
    yield from gui.drag_slider(slider, 0.5, 0.8)
    assert cubeness() > start
    yield from scene.wait_idle()
    drags = 0
    while cubeness() != start:
        drags += 1
        assert drags < 9  # one of a drag, but for pauses of a slow machine
        yield from scene.press("CTRL+Z")
        assert scene.live().current() is not None
        yield
    yield from scene.wait_idle()
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
    yield from gui.undo()
    assert scene.NAME not in bpy.data.objects, "the slider has left undo steps"
    scene.check_clean()
    yield from scene.redo()
    yield from scene.redo()
    assert scene.positions() == confirmed
    scene.check_bits_of_cubify()


def share_flat():
    """Return the share of the area along an axis of the cube, as it is now or was a moment ago."""
    mesh = bpy.data.objects[scene.NAME].data
    areas = np.array([polygon.area for polygon in mesh.polygons])
    normals = np.array([polygon.normal for polygon in mesh.polygons])
    shares = []
    for turn in np.linspace(0.0, bpy.context.window_manager.cubic_craft_live.orientation[2], 9):
        local = normals @ np.array(Matrix.Rotation(turn, 3, "Z"))
        shares.append(areas[np.abs(local).max(axis=1) > FLAT].sum() / areas.sum())
    return max(shares)


def stays_crisp(_original):
    """Drag the slider once the shape is crisp, and turn it: at no time is a soft one seen."""
    yield from scene.start_live()
    yield from scene.wait_idle()
    slider = yield from scene.cubeness_slider()
    session, seen, at_rest, before = scene.live().current(), [], share_flat(), scene.positions()
    tick = session.tick
    session.tick = lambda context: (tick(context), seen.append(share_flat()))
    yield from gui.drag_slider(slider, 0.5, 0.6, steps=8)
    yield from gui.screenshot("live_drag.png")
    assert scene.positions() != before, "nothing was seen"
    assert min(seen) > 0.9 * at_rest, f"{min(seen):.2f} of {at_rest:.2f}"
    yield from scene.wait_idle()
    yield from gui.screenshot("live_rest.png")
    seen.clear()
    before = scene.positions()
    turn = yield from gui.find_button("cubic_craft_live.orientation[2]")
    yield from gui.drag_slider(turn, 0.5, -4.0, steps=16)
    yield from gui.screenshot("live_turn.png")
    assert scene.positions() != before, "nothing was seen"
    least = min(seen)
    yield from scene.wait_idle()
    yield from gui.screenshot("live_turned.png")
    gui.log(f"{least:.2f} of {share_flat():.2f} flat, in {len(seen)} ticks")
    assert least > 0.8 * share_flat(), f"{least:.2f} of {share_flat():.2f}"
    yield from scene.end_by("ESC")


def cancelled(_original):
    """Click on the cross; whatever is active, the panel stays that of Live, with its buttons."""
    before = scene.positions()
    yield from scene.start_live()
    yield from gui.screenshot("live.png")
    bpy.context.view_layer.objects.active = None
    yield from gui.click((yield from gui.find_button("cubic_craft.live_cancel")))
    yield from gui.wait_until(scene.is_over, what="the end")
    assert scene.positions() == before
    scene.check_clean()


def test():
    gui.simplify_viewport()
    scene.add_monkey(is_refined=True)
    original = scene.positions()
    yield from gui.open_sidebar("Cubic Craft")
    for moment in (a_slider, one_step, stays_crisp, cancelled):
        gui.log(moment.__name__)
        yield from moment(original)


gui.run(test)
