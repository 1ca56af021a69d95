# SPDX-License-Identifier: GPL-3.0-or-later
"""Make the pictures of docs/real_art.md: meshes as they are, in an older version, and now.

page_pictures.py OLDER [PICTURE ...] [--output FOLDER]

OLDER is a source tree of the extension: git archive 9c85a9d | tar -x -C OLDER
The pictures "characters" and "thirty" are made only if they are named, and with bd16ae9 and
77d1518 as OLDER.
"""

import argparse
import contextlib
import io
import subprocess
import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np
import survey
import survey_pictures
from art_cases import CASES, outcome_of
from art_objects import Surface, surface_of
from mathutils import Matrix
from survey import ROOT

WIDTH = 900
"""pixels"""
SHADES = 63
"""of each color, besides black: the noise of more makes files half as large again"""
BOXES = 1.0
"""cubeness of boxes and houses; all else is shown at 0.4"""
PICTURES = {
    # name: rows of cases, height of a row
    "parts": ([["monkey"], ["character"]], 300),
    "seams": ([["teapot_seams"], ["monkey_flat"]], 290),
    "clothes": ([["clothes"], ["painted"]], 310),
    "coarse": ([["sphere", "torus"], ["monkey_507", "text"]], 200),
    "boxes": ([["house", "box_skew"], ["cube", "box_45"]], 200),
    "characters": (
        [["body", "clothes"], ["character", "fox"], ["hand", "spring"], ["teapot", "monkey"]],
        210,
    ),
    "thirty": (
        [
            ["monkey", "monkey_2012", "monkey_flat"],
            ["teapot", "cup", "bowl"],
            ["body", "clothes", "character"],
            ["skin", "fox", "hand"],
            ["painted", "character_seams", "teapot_seams"],
            ["sphere", "torus", "cylinder"],
            ["cone", "car", "text"],
            ["house", "house_30", "box_skew"],
            ["spring", "pipe", "waves"],
            ["cape", "pinched", "fin"],
        ],
        150,
    ),
}
LABELS = {"characters": "before", "thirty": "before"}
"""of the older version, where it is not the one of 9c85a9d, which solves the skin alone"""
STOOD_UP = ("text", "hand")
"""cases that lie on their back"""


def main():
    """Solve with both versions, each in a process of its own, and render."""
    options = _arguments()
    if options.solve:
        _solve(options.older, options.pictures, options.solve)
        return
    with tempfile.TemporaryDirectory() as folder:
        shapes = []
        for tree, file in ((options.older, "older.npz"), (ROOT, "now.npz")):
            path = Path(folder) / file
            command = [sys.executable, __file__, tree, *options.pictures, "--solve", path]
            subprocess.run(command, check=True)
            with np.load(path) as arrays:
                shapes.append(dict(arrays))
        for name in options.pictures:
            rows, height = PICTURES[name]
            files = [Path(folder) / f"{name}_{number}.png" for number in range(len(rows))]
            for cases, path in zip(rows, files, strict=True):
                label = LABELS.get(name, "skin alone")
                _render(cases, *shapes, label, path, (WIDTH, height))
            _stack(files, options.output / f"real_art_{name}.png")


def _arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("older", type=Path, metavar="OLDER")
    parser.add_argument("pictures", nargs="*", metavar="PICTURE", help=", ".join(PICTURES))
    parser.add_argument("--output", type=Path, default=ROOT / "docs" / "images", metavar="FOLDER")
    parser.add_argument("--solve", type=Path, help=argparse.SUPPRESS)
    options = parser.parse_args()
    options.pictures = options.pictures or [name for name in PICTURES if name not in LABELS]
    return options


def _solve(tree, pictures, path):
    """Write the positions after Cubify with the extension of a source tree."""
    shapes = {}
    with survey.registered(tree):
        for case in (case for name in pictures for row in PICTURES[name][0] for case in row):
            with contextlib.redirect_stdout(io.StringIO()):
                shapes[case] = outcome_of(case, BOXES if _is_box(case) else 0.4).U
    np.savez(path, **shapes)


def _is_box(case):
    return any(case in row for row in PICTURES["boxes"][0])


def _render(cases, older, now, older_label, path, resolution):
    """Write a picture of each case at rest and as both versions make it."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    shown = []
    for case in cases:
        with contextlib.redirect_stdout(io.StringIO()):
            objects = CASES[case].make()
        rest = surface_of(objects)
        for label, V, finish in (
            ("original", rest.V, "clay"),
            (older_label, older[case], "grey"),
            ("now", now[case], "teal"),
        ):
            turn = Matrix.Rotation(np.pi / 2 * (case in STOOD_UP), 3, "X")
            surface = Surface(V @ np.array(turn).T, rest.F, rest.owner)
            shown.append((label, objects, surface, finish, rest.V))
    survey_pictures.render_row(shown, path, resolution)


def _stack(files, path):
    """Write pictures below each other as one."""
    images = [bpy.data.images.load(str(file)) for file in files]
    width, height = images[0].size[0], sum(image.size[1] for image in images)
    whole = bpy.data.images.new("Whole", width, height)
    pixels = [np.empty(len(image.pixels), np.float32) for image in images]
    for image, values in zip(images, pixels, strict=True):
        image.pixels.foreach_get(values)
    joined = np.concatenate(pixels[::-1])  # from the bottom up
    whole.pixels.foreach_set(np.round(SHADES * joined) / SHADES)
    whole.file_format = "PNG"
    bpy.context.scene.render.image_settings.color_mode = "RGB"
    whole.save(filepath=str(path), quality=100)


if __name__ == "__main__":
    main()
