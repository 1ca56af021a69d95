# SPDX-License-Identifier: GPL-3.0-or-later
"""The menu of presets, which opens by the picture of the one that is shown."""

import importlib

import guidrive as gui
import live_scene as scene
from guidrive.pictures import save_screen


def choose_preset(name, scale=1.0):
    """Open the pictures of the presets, take one of the screen, and choose a preset by the keys.

    `scale` is that of Blender's interface.
    """
    files = importlib.import_module(f"{scene.EXTENSION}.cubic_craft_addon.presets.files")
    number = [preset.identifier for preset in files.presets()].index(name)
    beside = yield from gui.find_button("cubic_craft.reset")
    yield from gui.click((round(beside.left - 45 * scale), beside.at()[1]))
    yield 1.0
    save_screen(f"{name}.png")
    yield from gui.keys(*["DOWN_ARROW"] * (number + 1), "RET")
    yield from gui.wait_until(lambda: shown_preset() == name, what=f"the preset {name}")


def shown_preset():
    is_live = scene.live().current() is not None
    return (scene.live().live_properties() if is_live else scene.settings()).preset


def keep_and_remove(name, chosen):
    """Keep the present look under a name, do what `chosen` yields with it, and remove it again."""
    yield from _press("cubic_craft.preset_add")
    yield from gui.wait_until(lambda: shown_preset() == name, what="a preset that is kept")
    yield from chosen
    yield from _press("cubic_craft.preset_remove")
    yield from gui.wait_until(lambda: shown_preset() == "CUSTOM", what="a preset that is gone")
    yield from _press("cubic_craft.reset")
    assert shown_preset() == "Cubic"


def choose_in_live(name):
    """Choose another preset while Live runs, and leave it by Esc."""
    yield from scene.start_live()
    yield from scene.wait_idle()
    before = scene.positions()
    yield from choose_preset(name)
    yield from scene.wait_idle_with(lambda: scene.positions() != before, "the shape of the preset")
    yield from gui.screenshot("preset_in_live.png")
    yield from scene.end_by("ESC")
    assert shown_preset() == "Cubic"


def _press(name):
    """Click on a button of the panel, and confirm what it asks."""
    yield from gui.click((yield from gui.find_button(name)))
    yield 0.5
    yield from gui.keys("RET")
