# SPDX-License-Identifier: GPL-3.0-or-later
"""A cubic bear: of each preset, and as the icon for the extensions platform.

The settings are those of the presets, the picture of what has none shows the bear as it was.
"""

from pathlib import Path
from typing import Any

from figures.shapes import bear as add_bear

from cubic_craft.cubic_craft_addon.command_line.picture.studio import surface
from cubic_craft.cubic_craft_addon.presets.files import PICTURES, presets
from cubic_craft.cubic_craft_addon.read.member import read_member
from cubic_craft.cubic_craft_addon.run.pipeline import prepare, solve
from cubic_craft.cubic_craft_addon.settings.values import Settings

from .studio import Picture, render, set_up

WITHOUT = "preset_without_picture"
IMAGES = Path(__file__).resolve().parents[2] / "docs" / "images"
PICTURE = Picture(size=160, width=2.62, lift=0.06, largest_bytes=30_000)
ICON = Picture(size=256, width=2.62, lift=0.06, largest_bytes=100_000)
FUR, GREY, GREEN = (0.62, 0.27, 0.06), (0.30, 0.31, 0.33), (0.16, 0.47, 0.06)
"""linear RGB; the last lighter than in the figures, as an icon is small"""


def render_presets(only: list[str] | None, samples: int) -> None:
    """Render all that come with the extension, or those that are named."""
    bear = _bear(FUR)
    scene = set_up(PICTURE, samples)
    if not only or WITHOUT in only:
        fur, bear.data.materials[0] = bear.data.materials[0], surface("Grey", GREY, roughness=0.5)
        render(scene, PICTURES.with_name(f"{WITHOUT}.png"), PICTURE)
        bear.data.materials[0] = fur
    for preset in presets():
        if preset.is_included and (not only or preset.identifier in only):
            with_original = [vertex.co.copy() for vertex in bear.data.vertices]
            _cubify(bear, preset.values)
            render(scene, preset.picture, PICTURE)
            for vertex, place in zip(bear.data.vertices, with_original, strict=True):
                vertex.co = place
            bear.data.update()


def render_icon(_only: list[str] | None, samples: int) -> None:
    """Render a cubic bear before nothing, a shape of our own that nobody's license is asked for."""
    _cubify(_bear(GREEN), {"cubeness": 1.0})
    render(set_up(ICON, samples), IMAGES / "platform_icon.png", ICON)


def _bear(color: tuple[float, float, float]) -> Any:
    bear = add_bear()
    bear.data.materials.append(surface("Fur", color, roughness=0.5))
    return bear


def _cubify(bear: Any, values: dict[str, Any]) -> None:
    member = read_member(bear, Settings(symmetry=(True, False, False), **values))
    (solution,) = solve(prepare([member]))
    bear.data.vertices.foreach_set("co", solution.positions.ravel())
    bear.data.update()
