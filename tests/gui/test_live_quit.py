# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: trixie
"""Blender is quit while Live computes: it must quit in the regular way."""

import guidrive as gui
import live_scene as scene


def test():
    gui.simplify_viewport()
    scene.add_monkey(levels=2)
    yield from gui.open_sidebar("Cubic Craft")
    yield from scene.start_live()
    assert not scene.is_idle() and scene.live().current() is not None


gui.run(test)
