# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: trixie
"""Looks are chosen by their pictures, taken back by Ctrl-Z, kept, removed, and changed in Live."""

import guidrive as gui
import live_scene as scene
from preset_menu import choose_in_live, choose_preset, keep_and_remove, shown_preset


def test():
    gui.simplify_viewport()
    scene.add_monkey(is_refined=True)  # as the presets have it
    yield from gui.open_sidebar("Cubic Craft")
    scene.show_front()
    yield from choose_preset("Chunky")
    assert scene.settings().solidity == 1.0
    yield from gui.undo()
    assert shown_preset() == "Cubic"
    scene.settings().cubeness = 0.6
    yield from keep_and_remove("My_Look", choose_preset("My_Look"))
    yield from choose_in_live("Crisp")


gui.run(test)
