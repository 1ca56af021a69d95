# SPDX-License-Identifier: GPL-3.0-or-later
"""A random walk: anything, at any moment. WALK_SEED and WALK_ACTIONS choose another one."""

import faulthandler
import os

import guidrive as gui
import live_scene as scene
from walk.walk import walk

SEED = os.environ.get("WALK_SEED", "1")
ACTIONS = int(os.environ.get("WALK_ACTIONS", "120"))


def test():
    faulthandler.enable()  # a crash of Blender names the line of the step that it crashed in
    gui.simplify_viewport()
    scene.add_monkey()
    yield from gui.open_sidebar("Cubic Craft")
    yield from gui.screenshot("start.png")
    yield from walk(SEED, ACTIONS)
    yield from gui.screenshot("end.png")


gui.run(test, timeout=660.0 + 9.0 * ACTIONS)
