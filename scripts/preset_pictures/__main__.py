# SPDX-License-Identifier: GPL-3.0-or-later
"""Render a picture of each preset that comes with the extension, beside its file.

The settings are taken from the files, the picture of what has none shows the bear as it was.
"""

import argparse
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
sys.path[:1] = [str(ROOT / "scripts"), str(ROOT)]  # not this folder: its names are too common

import bpy  # noqa: E402
from figures.shapes import bear as add_bear  # noqa: E402

from cubic_craft import registered  # noqa: E402
from cubic_craft.cubic_craft_addon.command_line.picture.studio import surface  # noqa: E402
from cubic_craft.cubic_craft_addon.mesh_bridge import original_positions  # noqa: E402
from cubic_craft.cubic_craft_addon.presets.files import INCLUDED_FOLDER, presets  # noqa: E402
from cubic_craft.cubic_craft_addon.read.member import read_member  # noqa: E402
from cubic_craft.cubic_craft_addon.run.pipeline import prepare, solve  # noqa: E402
from cubic_craft.cubic_craft_addon.settings.values import Settings  # noqa: E402
from preset_pictures.studio import Picture, render, set_up  # noqa: E402

WITHOUT = "preset_without_picture"
PICTURE = Picture(size=160, width=2.62, lift=0.06, largest_bytes=30_000)
FUR, GREY = (0.62, 0.27, 0.06), (0.30, 0.31, 0.33)
"""linear RGB"""


def main() -> None:
    """Render all, or those that are named."""
    parser = argparse.ArgumentParser(prog="preset_pictures", description=__doc__)
    parser.add_argument("--only", nargs="+", metavar="NAME", help="(default: all)")
    parser.add_argument("--samples", type=int, default=64, metavar="N", help="(default: 64)")
    options = parser.parse_args()
    with registered():
        bear = add_bear()
        fur = surface("Fur", FUR, roughness=0.5)
        bear.data.materials.append(fur)
        scene = set_up(PICTURE, options.samples)
        _render_presets(scene, bear, options.only)
        folder = INCLUDED_FOLDER.parents[1]
        if not options.only or WITHOUT in options.only:
            bear.data.materials[0] = surface("Grey", GREY, roughness=0.5)
            render(scene, folder / f"{WITHOUT}.png", PICTURE)


def _render_presets(scene: bpy.types.Scene, bear: Any, only: list[str] | None) -> None:
    original = original_positions(bear.data)
    for preset in presets():
        if preset.is_included and (not only or preset.identifier in only):
            settings = Settings(symmetry=(True, False, False), **preset.values)
            member = read_member(bear, settings)
            (solution,) = solve(prepare([member]))
            _move(bear, solution.positions)
            render(scene, preset.picture, PICTURE)
            _move(bear, original)


def _move(bear: Any, positions: Any) -> None:
    bear.data.vertices.foreach_set("co", positions.ravel())
    bear.data.update()


if __name__ == "__main__":
    main()
