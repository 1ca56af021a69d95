# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: trixie
"""The viewport stays usable while Live runs, and Live at rest does nothing at all."""

import time

import bpy
import guidrive as gui
import live_scene as scene


def view_matrix():
    return [tuple(row) for row in gui.area().spaces.active.region_3d.view_matrix]


def orbited(is_at_rest):
    """Move the view by the middle mouse button and the wheel: Live goes on."""
    if is_at_rest:
        yield from scene.wait_idle()
    session = scene.live().current()
    iteration = session.meshes[0].iterations
    before = view_matrix()
    start = gui.viewport_point(0.3, 0.4)
    yield from gui.drag(start, (start[0] + 80, start[1] + 40), button="MIDDLEMOUSE")
    yield from gui.wait_until(lambda: view_matrix() != before, what="another view")
    before = view_matrix()
    yield from gui.move_mouse(start)
    yield from gui.turn_wheel("WHEELDOWNMOUSE", 2)
    yield from gui.wait_until(lambda: view_matrix() != before, what="another distance")
    before = view_matrix()
    yield from gui.keys("NUMPAD_1")
    yield from gui.wait_until(lambda: view_matrix() != before, what="the front view")
    assert scene.live().current() is session
    if not is_at_rest:
        assert session.meshes[0].iterations > iteration
    else:
        yield from scene.wait_idle()
        assert session.meshes[0].iterations == iteration


def cpu_share(seconds=2.0):
    """Leave Blender alone; return the share of a core that it used, and its draws."""
    draws = gui.counts["WINDOW"], gui.counts["UI"]
    used, begin = time.process_time(), time.monotonic()
    yield seconds
    share = (time.process_time() - used) / (time.monotonic() - begin)
    return share, gui.counts["WINDOW"] - draws[0], gui.counts["UI"] - draws[1]


def last_redraws():
    """Leave Blender alone until it has drawn nothing for a second; it gets no more than ten."""
    for _ in range(10):
        _, views, panels = yield from cpu_share(1.0)
        if not views + panels:
            break


def at_rest(base):
    yield from scene.press()
    yield from scene.wait_idle()
    yield from last_redraws()
    session = scene.live().current()
    ticks = []
    tick = type(session).tick
    type(session).tick = lambda self, context: (ticks.append(1), tick(self, context))
    try:
        share, views, panels = yield from cpu_share()
    finally:
        type(session).tick = tick
    gui.log(f"at rest: {share:.1%} of a core, {views} and {panels} draws; without Live {base:.1%}")
    assert scene.is_idle()
    assert not ticks and session._timer is None
    assert views == panels == 0
    # With events of its own making, Blender never sleeps; so this needs the run script's -x.
    assert share < 0.05 or bpy.app.use_event_simulate


def test():
    gui.simplify_viewport()
    scene.add_monkey(levels=1)
    original = scene.positions()
    yield from gui.open_sidebar("Cubic Craft")
    slider = yield from scene.cubeness_slider()
    yield from scene.press()
    yield from last_redraws()
    base, views, _ = yield from cpu_share()
    gui.log(f"without Live: {base:.1%} of a core, {views} draws")

    yield from scene.start_live()
    yield from orbited(is_at_rest=False)
    yield from gui.screenshot("orbited.png")
    yield from orbited(is_at_rest=True)
    yield from at_rest(base)

    # A slider wakes it, and it comes to rest again.
    before = scene.positions()
    yield from gui.drag_slider(slider, 0.5, 0.8)
    yield from scene.wait_idle_with(lambda: scene.positions() != before, "another shape")
    yield from at_rest(base)

    gui.log("woken by a script")
    # So does a script, or a driver, without a mouse event.
    before = scene.positions()
    bpy.context.window_manager.cubic_craft_live.cubeness = 0.3
    yield from scene.wait_idle_with(lambda: scene.positions() != before, "another shape")

    gui.log("playback")
    # Playback does not hinder it.
    with gui.in_region():
        bpy.ops.screen.animation_play()
    before = scene.positions()
    bpy.context.window_manager.cubic_craft_live.cubeness = 0.35
    yield from gui.wait_until(lambda: scene.positions() != before, what="a change in playback")
    with gui.in_region():
        bpy.ops.screen.animation_play()
    gui.log("the end")
    yield from scene.wait_idle()
    yield from scene.end_by("RET")
    assert scene.positions() != original
    scene.check_bits_of_cubify()


gui.run(test)
