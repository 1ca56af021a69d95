# SPDX-License-Identifier: GPL-3.0-or-later
"""Render the icon and the feature picture for the extensions platform, in its sizes.

They show shapes of our own and Blender's monkey, so that nobody else's license is asked for.
"""

import argparse
import sys
from argparse import Namespace
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:1] = [str(ROOT / "scripts"), str(ROOT)]  # not this folder: its names are too common

from figures import teaser  # noqa: E402
from figures.figure_meshes import FigureMeshes  # noqa: E402
from figures.rendered import NOMINAL_WIDTH, Figure, render_figure  # noqa: E402
from figures.shapes import bear as add_bear  # noqa: E402
from preset_pictures.studio import Picture, render, set_up  # noqa: E402

from cubic_craft import registered  # noqa: E402
from cubic_craft.cubic_craft_addon.command_line.picture.studio import surface  # noqa: E402
from cubic_craft.cubic_craft_addon.command_line.process.progress import ProgressBar  # noqa: E402
from cubic_craft.cubic_craft_addon.read.member import read_member  # noqa: E402
from cubic_craft.cubic_craft_addon.run.pipeline import prepare, solve  # noqa: E402
from cubic_craft.cubic_craft_addon.settings.values import Settings  # noqa: E402

ICON = Picture(size=256, width=2.62, lift=0.06, largest_bytes=100_000)
GREEN = (0.16, 0.47, 0.06)
"""linear RGB; lighter than in the figures, as an icon is small"""
FEATURE_SIZE = 1920, 1080
FEATURE = Figure(
    "platform_feature",
    teaser.compose,
    NOMINAL_WIDTH * FEATURE_SIZE[1] // FEATURE_SIZE[0],
    teaser.in_two_rows,
)


def main() -> None:
    """Render both, or the one that is named."""
    parser = argparse.ArgumentParser(prog="platform_pictures", description=__doc__)
    both = ("icon", "feature")
    parser.add_argument("--only", choices=both, help="(default: both)")
    parser.add_argument("--samples", type=int, default=64, metavar="N", help="(default: 64)")
    parser.add_argument("--output", type=Path, default=ROOT / "docs" / "images", help="folder")
    options = parser.parse_args()
    with registered():
        if options.only in (None, "icon"):
            _render_icon(options)
        if options.only in (None, "feature"):
            _render_feature(options)


def _render_icon(options: Namespace) -> None:
    """Render a cubic bear before nothing."""
    bear = add_bear()
    settings = Settings(symmetry=(True, False, False), cubeness=1.0)
    member = read_member(bear, settings)
    (solution,) = solve(prepare([member]))
    bear.data.vertices.foreach_set("co", solution.positions.ravel())
    bear.data.materials.append(surface("Green", GREEN, roughness=0.5))
    scene = set_up(ICON, options.samples)
    render(scene, options.output / "platform_icon.png", ICON)


def _render_feature(options: Namespace) -> None:
    """Render shapes in a row, and before them what becomes of them."""
    bar = ProgressBar()
    meshes = FigureMeshes(None, bar, verbose=False)
    settings = Namespace(
        **vars(options), width=FEATURE_SIZE[0], engine="cycles", verbose=False, save_blend=None
    )
    with bar.task("feature") as task:
        path = render_figure(FEATURE, meshes, settings)
        task.finish(f"wrote {path}")


if __name__ == "__main__":
    main()
