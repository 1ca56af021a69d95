# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the figures and the table of the CubicCraft paper, and write them to a folder; see --help.

Without a folder of meshes Blender's own shapes take their place.
"""

import argparse
import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:1] = [str(ROOT / "scripts"), str(ROOT)]  # not this folder: its names are too common

from headless.errors import InputError  # noqa: E402
from headless.interruption import end_on_signals  # noqa: E402
from headless.quiet import mute_stdout  # noqa: E402
from headless_render import leave  # noqa: E402

from figures.copied import copy_screenshot, write_table  # noqa: E402

PROGRAM = "figures"
RENDERED = ("1", "2", "3", "5", "6")
"""figures that Blender renders; what is left, other commands have made"""
ALL = (*RENDERED, "4", "table")
BUILD = ROOT / "build"


def arguments() -> argparse.Namespace:
    """Return the parsed command line."""
    meshes = os.environ.get("CUBIC_CRAFT_MESHES")
    parser = argparse.ArgumentParser(prog=PROGRAM, description=__doc__, allow_abbrev=False)
    parser.add_argument(
        "--meshes",
        type=Path,
        default=Path(meshes) if meshes else None,
        metavar="FOLDER",
        help="folder with bunny.obj, spot.obj, owl.obj, horse.ply, armadillo.obj, or some of them",
    )
    parser.add_argument("--output", type=Path, default=ROOT / "docs" / "figures", metavar="FOLDER")
    parser.add_argument(
        "--only",
        nargs="+",
        choices=ALL,
        default=ALL,
        help="numbers of figures, or table (default: all)",
    )
    parser.add_argument("--width", type=int, default=1600, metavar="PIXELS", help="(default: 1600)")
    parser.add_argument(
        "--samples", type=int, default=24, metavar="N", help="of Cycles, denoised (default: 24)"
    )
    parser.add_argument("--engine", choices=("cycles", "workbench"), default="cycles")
    parser.add_argument(
        "--screenshots",
        type=Path,
        default=BUILD / "gui",
        metavar="FOLDER",
        help="what the window tests wrote, for figure 4 (default: build/gui)",
    )
    parser.add_argument(
        "--bench",
        type=Path,
        default=BUILD / "bench" / "results.json",
        metavar="FILE",
        help="what the benchmark wrote, for the table (default: build/bench/results.json)",
    )
    parser.add_argument(
        "--save-blend",
        type=Path,
        metavar="FOLDER",
        help="save the scene of each rendered figure there, to look at it in Blender",
    )
    parser.add_argument("--verbose", action="store_true", help="show Blender's own messages")
    options = parser.parse_args()
    if options.width < 16 or options.samples < 1:
        parser.error("--width must be 16 at least, and --samples 1")
    return options


def main() -> int:
    """Make what was asked for and return the exit code."""
    options = arguments()
    end_on_signals(PROGRAM)
    mute_stdout(options.verbose)
    try:
        if options.meshes is not None and not options.meshes.is_dir():
            raise InputError(f"--meshes {options.meshes}: there is no such folder; check the path")
        for folder in (options.output, options.save_blend):
            if folder is not None:
                folder.mkdir(parents=True, exist_ok=True)
        if "4" in options.only:
            print(copy_screenshot(options.screenshots, options.output), file=sys.stderr)
        if "table" in options.only:
            print(write_table(options.bench, options.output), file=sys.stderr)
        wanted = [name for name in RENDERED if name in options.only]
        if wanted:
            from figures.rendered import render_figures  # late: it takes Blender a second to start

            render_figures(wanted, options, ROOT)
    except InputError as error:
        print(f"{PROGRAM}: error: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    leave(main())
