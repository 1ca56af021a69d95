# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: trixie
"""Live when the solver fails in the middle of it, and when another add-on takes the engine away."""

import contextlib
import importlib
import os
import time

import bpy
import guidrive as gui
import live_scene as scene


def stylization():
    return importlib.import_module(f"{scene.EXTENSION}.solver").Stylization


@contextlib.contextmanager
def slow_solver():
    """Have Live still work once it has started, however fast the machine is."""
    step = stylization().local_step

    def after_a_while(*arguments, **options):
        time.sleep(0.1)
        return step(*arguments, **options)

    stylization().local_step = after_a_while
    try:
        yield
    finally:
        stylization().local_step = step


def solver_fails(original):
    """Live ends by itself, says why, and has lost nothing."""
    step = stylization().local_step

    def fail(*_args, **_options):
        raise RuntimeError("the solver is broken")

    slider = yield from scene.cubeness_slider()
    for moment in ("working", "idle", "finishing"):
        with slow_solver():
            yield from scene.start_live()
        if moment == "idle":
            yield from scene.wait_idle()
        session = scene.live().current()
        stylization().local_step = fail
        try:
            if moment == "idle":
                yield from gui.drag_slider(slider, 0.5, 0.7)
            elif moment == "finishing":
                session.on(scene.live().Event.CONFIRM)
            yield from scene.wait_over()
        finally:
            stylization().local_step = step
        assert "the solver is broken" in session.error
        assert scene.positions() == original, moment
        assert gui.counts["undo"] == 0
        yield from gui.screenshot(f"failed_{moment}.png")
        yield from gui.keys("ESC")  # closes the report, which would get the next click
        yield from gui.wait_redraw()
        yield from scene.press()
        yield from gui.wait_redraw()
    yield from scene.start_live()  # nothing of it stays
    yield from scene.end_by("RET")
    scene.check_bits_of_cubify()


def another_add_on_has_the_engine():
    """Start it anew, or stop it, as another add-on may at any moment."""
    ti = importlib.import_module(os.environ["EXPECT_DEVICE"].removesuffix("-cpu"))
    slider = yield from scene.cubeness_slider()
    for disturb in (lambda: ti.init(arch=ti.cpu, default_fp=ti.f32), ti.reset):
        with slow_solver():
            yield from scene.start_live()
        disturb()
        before = scene.positions()
        yield from scene.wait_idle_with(lambda b=before: scene.positions() != b, "a change")
        disturb()
        yield from gui.drag_slider(slider, 0.4, 0.6)
        disturb()
        yield from scene.wait_idle()
        assert not scene.live().current().all_problems
        disturb()
        yield from scene.end_by("RET")
        scene.check_bits_of_cubify()


def test():
    gui.simplify_viewport()
    scene.add_monkey()
    original = scene.positions()
    yield from gui.open_sidebar("Cubic Craft")
    yield from solver_fails(original)
    if os.environ.get("EXPECT_DEVICE", "").endswith("-cpu"):
        yield from another_add_on_has_the_engine()
    expected = os.environ.get("EXPECT_DEVICE", "")
    assert expected in scene.settings().status
    assert bpy.context.object.name == scene.NAME


gui.run(test)
