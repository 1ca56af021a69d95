# SPDX-License-Identifier: GPL-3.0-or-later
"""The walk itself: draws actions, does them, and tells how to repeat a failure."""

import collections
import inspect
import random
import time

import bpy
import guidrive as gui

from . import actions, artist, extension, files, hands  # noqa: F401 - they fill the list
from .actions import is_cubifying, is_live, turns
from .invariants import Invariants

_REPORTED = 20  # last actions that a failure names


def walk(seed, count):
    """Take `count` steps, the same for the same seed but for what depends on speed."""
    extension.invariants = invariants = Invariants()
    last = collections.deque(maxlen=_REPORTED)
    done = collections.Counter()
    start = time.monotonic()
    number = 0
    try:
        for number in range(1, count + 1):
            # A source of its own for each step: what one draws does not shift the next.
            rng = random.Random(f"{seed}/{number}")
            action, text = yield from _step(rng, number, last)
            done[action.name] += 1
            yield from _settle()
            invariants.check(action, text)
            if number % 100 == 0:
                yield from gui.screenshot(f"step_{number}.png")
    except Exception:
        gui.log(f"seed {seed} failed at action {number} of {count}; the last ones were:")
        for text in last:
            gui.log("   ", text)
        raise
    gui.log(f"seed {seed}: {count} actions in {time.monotonic() - start:.0f} s")
    gui.log("done:", ", ".join(f"{name} {times}" for name, times in sorted(done.items())))


def _step(rng, number, last):
    """Do one action that can be done now; return it, and what it says of itself."""
    weights = [action.weight for action in actions.ALL]
    while True:
        (action,) = rng.choices(actions.ALL, weights)
        last.append(f"{number}: {action.name} ...")
        text = action.do(rng)
        if inspect.isgenerator(text):
            text = yield from text
        last.pop()
        if text is not None:
            mode = bpy.context.mode
            last.append(f"{number}: {action.name}: {text} [{mode}{', Live' if is_live() else ''}]")
            gui.log(last[-1])
            return action, str(text)


def _settle():
    """Let Blender handle all events; Live, where it runs, goes on computing."""
    yield from hands.close_popups()
    yield from gui.wait_redraw()
    yield from turns(2)
    yield from gui.wait_until(
        lambda: is_live() == ("CUBIC_CRAFT_OT_live" in gui.running_operators()),
        what="the operator of Live to end with it",
    )
    yield from gui.wait_until(
        lambda: is_cubifying() == ("CUBIC_CRAFT_OT_cubify" in gui.running_operators()),
        what="the operator of Cubify to end with it",
    )
