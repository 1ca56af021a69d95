# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""A random walk: anything, at any moment. WALK_SEED and WALK_ACTIONS choose another one.

What a walk meets depends on the speed of the machine, too. So this one is short, and only keeps the
walk itself in order; those that are to find something are `make test-walk`.
"""

import faulthandler
import os

import guidrive as gui
import live_scene as scene
from walk.walk import walk

SEED = os.environ.get("WALK_SEED", "1")
ACTIONS = int(os.environ.get("WALK_ACTIONS", "40"))


def test():
    faulthandler.enable()  # a crash of Blender names the line of the step that it crashed in
    gui.simplify_viewport()
    scene.add_monkey(is_refined=True)
    yield from gui.open_sidebar("Cubic Craft")
    yield from gui.screenshot("start.png")
    yield from walk(SEED, ACTIONS)
    yield from gui.screenshot("end.png")


gui.run(test, timeout=660.0 + 9.0 * ACTIONS)
