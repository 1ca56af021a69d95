# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the figures of the CubicCraft paper, and write them to a folder; see --help.

Without a folder of meshes Blender's own shapes take their place.
"""

import argparse
import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:1] = [str(ROOT / "scripts"), str(ROOT)]  # not this folder: its names are too common

from headless_render import leave  # noqa: E402

from cubic_craft.cubic_craft_addon.command_line.process.quiet import mute_stdout, terminal  # noqa: E402
from cubic_craft.solver.console.interruption import end_on_signals  # noqa: E402
from cubic_craft.solver.console.output import InputError  # noqa: E402

PROGRAM = "figures"
ALL = ["1", "2", "3", "5", "6", "character", "forms"]
"""figures; the fourth is a picture of the window tests"""


def arguments() -> argparse.Namespace:
    """Return the parsed command line."""
    parser = argparse.ArgumentParser(
        prog=PROGRAM,
        description=__doc__,
        allow_abbrev=False,
        formatter_class=argparse.ArgumentDefaultsHelpFormatter,
    )
    add = parser.add_argument
    files = "bunny.obj, spot.obj, owl.obj, horse.ply, armadillo.obj, or some of them"
    meshes = os.environ.get("CUBIC_CRAFT_MESHES")
    add("--meshes", type=Path, default=meshes and Path(meshes), help=f"folder with {files}")
    add("--output", type=Path, default=ROOT / "docs" / "figures", help="folder")
    add("--only", nargs="+", choices=ALL, default=ALL, help="numbers or names of figures")
    add("--width", type=int, default=1600, help="pixels")
    add("--samples", type=int, default=24, help="of Cycles, denoised")
    add("--rough", action="store_true", help="few iterations, to try things out")
    add("--engine", choices=("cycles", "workbench"), default="cycles", help="of Blender")
    add("--verbose", action="store_true", help="show Blender's own messages")
    options = parser.parse_args()
    if options.width < 16 or options.samples < 1:
        parser.error("--width must be 16 at least, and --samples 1")
    return options


def main() -> int:
    """Make what was asked for and return the exit code."""
    options = arguments()
    end_on_signals(PROGRAM, terminal)
    mute_stdout(options.verbose)
    try:
        if options.meshes is not None and not options.meshes.is_dir():
            raise InputError(f"--meshes {options.meshes}: there is no such folder; check the path")
        options.output.mkdir(parents=True, exist_ok=True)
        from figures.rendered import render_figures  # late: it takes Blender a second to start

        render_figures([name for name in ALL if name in options.only], options)
    except InputError as error:
        print(f"{PROGRAM}: error: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    leave(main())
