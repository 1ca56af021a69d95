# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: trixie
"""The viewport stays usable while Live runs, Live at rest does nothing, and Blender may quit."""

import guidrive as gui
import live_scene as scene


def view_matrix():
    return [tuple(row) for row in gui.area().spaces.active.region_3d.view_matrix]


def orbited(is_at_rest):
    """Move the view by the middle mouse button: Live goes on."""
    if is_at_rest:
        yield from scene.wait_idle()
    session = scene.live().current()
    iteration = session.meshes[0].run.iterations
    before = view_matrix()
    start = gui.viewport_point(0.3, 0.4)
    yield from gui.drag(start, (start[0] + 80, start[1] + 40), button="MIDDLEMOUSE")
    yield from gui.wait_until(lambda: view_matrix() != before, what="another view")
    assert scene.live().current() is session
    if not is_at_rest:
        assert session.meshes[0].run.iterations > iteration
    else:
        yield from scene.wait_idle()
        assert session.meshes[0].run.iterations == iteration


def draws_in(seconds):
    """Leave Blender alone; return how often it has drawn the view and the panel."""
    before = gui.counts["WINDOW"] + gui.counts["UI"]
    yield seconds
    return gui.counts["WINDOW"] + gui.counts["UI"] - before


def last_redraws():
    """Leave Blender alone until it has drawn nothing for a second; it gets no more than ten."""
    for _ in range(10):
        if not (yield from draws_in(1.0)):
            break


def at_rest():
    yield from scene.press()
    yield from scene.wait_idle()
    yield from last_redraws()
    session = scene.live().current()
    ticks = []
    tick = type(session).tick
    type(session).tick = lambda self, context: (ticks.append(1), tick(self, context))
    try:
        draws = yield from draws_in(2.0)
    finally:
        type(session).tick = tick
    assert scene.is_idle()
    assert not ticks and session._timer is None and not draws


def test():
    gui.simplify_viewport()
    scene.add_monkey(levels=1)
    original = scene.positions()
    yield from gui.open_sidebar("Cubic Craft")
    slider = yield from scene.cubeness_slider()
    yield from scene.start_live()
    yield from orbited(is_at_rest=False)
    yield from gui.screenshot("orbited.png")
    yield from orbited(is_at_rest=True)
    yield from at_rest()

    # A slider wakes it, and it comes to rest again.
    before = scene.positions()
    yield from gui.drag_slider(slider, 0.5, 0.8)
    yield from scene.wait_idle_with(lambda: scene.positions() != before, "another shape")
    yield from at_rest()

    yield from scene.end_by("RET")
    assert scene.positions() != original
    scene.check_bits_of_cubify()

    scene.add_monkey(levels=2)
    yield from scene.start_live()
    assert not scene.is_idle()  # and Blender quits while it computes


gui.run(test)
