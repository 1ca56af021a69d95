# SPDX-License-Identifier: GPL-3.0-or-later
"""A cubic bear, of each preset.

The settings are those of the presets, the picture of what has none shows the bear as it was.
"""

from typing import Any

from figures.shapes import bear as add_bear

from cubic_craft.cubic_craft_addon.command_line.picture.studio import surface
from cubic_craft.cubic_craft_addon.presets.files import PICTURES, presets
from cubic_craft.cubic_craft_addon.read.member import read_member
from cubic_craft.cubic_craft_addon.run.pipeline import prepare, solve
from cubic_craft.cubic_craft_addon.settings.values import Settings

from .studio import render, set_up

WITHOUT = "preset_without_picture"
LARGEST = 30_000
"""bytes of a file"""
FUR, GREY = (0.62, 0.27, 0.06), (0.30, 0.31, 0.33)
"""linear RGB"""


def render_presets(only: list[str] | None, samples: int) -> None:
    """Render all that come with the extension, or those that are named."""
    bear = add_bear()
    bear.data.materials.append(surface("Fur", FUR, roughness=0.5))
    scene = set_up(160, 2.62, samples, lift=0.06)
    if not only or WITHOUT in only:
        fur, bear.data.materials[0] = bear.data.materials[0], surface("Grey", GREY, roughness=0.5)
        render(scene, PICTURES.with_name(f"{WITHOUT}.png"), LARGEST)
        bear.data.materials[0] = fur
    for preset in presets():
        if preset.is_included and (not only or preset.identifier in only):
            with_original = [vertex.co.copy() for vertex in bear.data.vertices]
            _cubify(bear, preset.values)
            render(scene, preset.picture, LARGEST)
            for vertex, place in zip(bear.data.vertices, with_original, strict=True):
                vertex.co = place
            bear.data.update()


def _cubify(bear: Any, values: dict[str, Any]) -> None:
    member = read_member(bear, Settings(symmetry=(True, False, False), **values))
    (solution,) = solve(prepare([member]))
    bear.data.vertices.foreach_set("co", solution.positions.ravel())
    bear.data.update()
