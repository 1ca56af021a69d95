# SPDX-License-Identifier: GPL-3.0-or-later
"""The feature picture for the extensions platform: the teaser of the figures, in its size."""

from argparse import Namespace

from figures import teaser
from figures.figure_meshes import FigureMeshes
from figures.rendered import NOMINAL_WIDTH, Figure, render_figure

from cubic_craft.cubic_craft_addon.command_line.process.progress import ProgressBar

from .bear import IMAGES

WIDTH, HEIGHT = 1920, 1080
FEATURE = Figure(
    "platform_feature", teaser.compose, NOMINAL_WIDTH * HEIGHT // WIDTH, teaser.in_two_rows
)


def render_feature(_only: list[str] | None, samples: int) -> None:
    """Render shapes of our own in a row, and before them what becomes of them."""
    bar = ProgressBar()
    settings = {"samples": samples, "output": IMAGES, "width": WIDTH, "engine": "cycles"}
    with bar.task("feature") as task:
        path = render_figure(FEATURE, FigureMeshes(None, bar), Namespace(**settings))
        task.finish(f"wrote {path}")
