# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the command line, those of the method made from what `solver.method` declares."""

import argparse
from pathlib import Path
from typing import Any

from ....solver.console.method_options import (
    Adder,
    OneLineParser,
    add_settings,
    as_in_paper,
    defaults,
    fill_in,
    number,
)
from ....solver.console.sources import listing
from ....solver.method import Advanced, Computation, Kept, KeptInScene, Method, Style, StyleInScene
from .checks import check
from .formats import ANIMATED, READABLE, WRITABLE
from .handles_file import read_handles
from .region_option import region_option

DEFAULTS = {**defaults(Method), "symmetry": ("auto", "")}
"""name: by default, with ``--paper``"""

EPILOG = """\
The picture shows the original beside one result per cubeness. With --turntable it becomes a
sequence name_0001.png ... in which every object turns once about its vertical axis.
Orientation 0 0 0 means the axes of the scene, where Z is up; with --space object those of each
object, which for an .obj are those of the file.
Options of Blender itself stand before the command: blender --threads 2 -c cubic_craft [options];
where the extension is not installed: blender -b -P scripts/headless_render.py -- [options]

Several files, or folders of them, go to a folder: --output-folder DIR. A file that cannot be used
does not stop the others, and one whose results are there and are newer than it is left out: start
a batch again to go on where it was stopped.
Exit codes: 0 all is done, 2 nothing was begun because of what was given, 3 some files failed,
130 interrupted.

--handles FILE.json poses the mesh: a list of parts to hold, and where; the rest follows.
  [{"box": [[-1, -1, -1], [1, 1, -0.8]]},
   {"group": "ear", "translate": [0, 0, 0.4], "rotate": [0, 30, 0]}]
Each has one of
  "group": name of a vertex group, with "threshold": least weight (0.5)
  "vertices": numbers of vertices in the input file, from 0
  "box": lowest and highest corner; all vertices in it
and any of
  "translate": [x, y, z]      "rotate": degrees about [x, y, z], in this order
  "scale": number or [x, y, z]
  "pivot": [x, y, z] that it is turned and scaled about (the middle of its bounding box)
Coordinates are the object's own, as they stand in the file (for an .obj those of its "v" lines),
before --turn. Without any of these the part stays in place. Where parts overlap the first counts,
--pin before all. --cubeness 0 poses only.
"""


def parse(arguments: list[str], program: str = "headless_render.py") -> argparse.Namespace:
    """Read the command line and check everything that can be checked without Blender.

    `program`: how it is started, for --help. Returns one attribute per option; what ``--paper``
    stands for is set, and ``handles`` is a list of `GivenHandle`. For one file ``output_folder`` is
    None; ``output``, ``save_mesh`` and ``report`` are paths or None, and ``input`` is a path or
    None for the monkey. Else it is the folder of a batch, and `options_for` gives those of one of
    its files. Raises InputError: an option, the input or an output path cannot be used.
    """
    options = _parser(program).parse_args(arguments)
    options.cubeness = list(dict.fromkeys(options.cubeness))
    fill_in(options, DEFAULTS)
    check(options)
    options.handles = read_handles(options.handles_file) if options.handles_file else []
    return options


def options_for(options: argparse.Namespace, name: str, path: Path) -> argparse.Namespace:
    """Return the options of a batch as those of a run with one file, whose results have a name."""
    stem = str(options.output_folder.resolve() / name)
    own = argparse.Namespace(**vars(options))
    own.input, own.report = path, None
    own.output = None if options.no_render else Path(f"{stem}.png")
    own.save_mesh = options.save_mesh and Path(f"{stem}{options.save_mesh}")
    own.bake = options.bake and Path(f"{stem}{options.bake}")
    return own


def _parser(program: str) -> argparse.ArgumentParser:
    parser = OneLineParser(
        prog=program,
        usage=f"{program} [INPUT ...] [options]",
        description="Turn meshes into cubic sculptures: pictures, meshes and a report.",
        epilog=EPILOG,
    )
    for title, add_options in GROUPS.items():
        add_options(parser.add_argument_group(title).add_argument)
    return parser


def _add_inputs(add: Adder) -> None:
    what = f"{listing(READABLE)}; without it, Blender's monkey, subdivided; for a batch several"
    add("inputs", nargs="*", type=Path, metavar="INPUT", help=f"{what} files, or folders of them")
    which = "this mesh object only (default: all that are shown and rendered)"
    add("--object", metavar="NAME", help=which)
    seen = "take what is seen: meshes with their modifiers applied, texts, curves, surfaces and"
    add("--with-modifiers", action="store_true", help=f"{seen} metaballs as meshes")
    add("--verbose", action="store_true", help="show Blender's own messages")


def _add_method(add: Adder) -> None:
    several: dict[str, Any] = {"nargs": "+", "default": [Method.cubeness]}
    in_scene = {"choices": ("world", "object")}
    add_settings(add, Style, StyleInScene, cubeness=several, space=in_scene)
    add(
        "--form-object",
        type=Path,
        metavar="FILE",
        help="for --form object the file whose convex hull is the form, for directions the one"
        " whose faces are, about the origin of its scene",
    )
    add(
        "--region",
        nargs="+",
        type=region_option,
        default=[],
        metavar="GROUP:FORM:CUBENESS",
        help="a vertex group with a form and a cubeness of its own, such as head:octahedron:0.8 or,"
        " with a number of sides, hat:prism5:1; where its weights are less than 1, it blends into"
        " the rest",
    )
    pins = "vertex groups that stay in place"
    add("--pin", nargs="+", default=[], metavar="GROUP", help=pins)
    handles = "parts of the mesh that are held or moved, see below"
    add("--handles", dest="handles_file", type=Path, metavar="FILE.json", help=handles)
    add_settings(add, Computation)


def _add_shape(add: Adder) -> None:
    add_settings(add, Kept, Advanced, KeptInScene)
    add(
        "--symmetry",
        type=_axes,
        metavar="AXES",
        help="x, y, z or several: halves that are mirror images about the object's origin stay so;"
        " auto: those that are so in 99 %%, of a mesh or of what is solved together; off (default:"
        " auto)",
    )
    add("--paper", action="store_true", help=as_in_paper(DEFAULTS))


def _add_outputs(add: Adder) -> None:
    add("--output", type=Path, metavar="PICTURE.png", help="(default: cubic_craft.png)")
    add("--no-render", action="store_true", help="no picture")
    add(
        "--save-mesh",
        metavar="FILE",
        help=f"the result: {listing(WRITABLE)}; with several cubeness values one file each"
        " (name_0.4.obj); in a batch the end of the names, such as .obj or _cubic.obj",
    )
    add(
        "--low-poly",
        nargs="+",
        type=number(12, 10_000_000, int),
        default=[],
        metavar="N",
        help="levels of detail beside each .glb or .fbx, name_lod1.glb and so on, with so many"
        " triangles and a normal map",
    )
    add(
        "--bake",
        type=Path,
        metavar="FILE",
        help=f"the cubic version of each frame of an animation: {listing(ANIMATED)}; instead of a"
        " picture and a mesh; in a batch the end of the names. A run that was ended continues where"
        " it was",
    )
    frame = number(-1048574, 1048574, int)
    frames = "first and last frame for --bake (default: those of the file)"
    add("--frames", nargs=2, type=frame, metavar=("A", "B"), help=frames)
    report = "numbers of the run; in a batch written after each file"
    add("--report", type=Path, metavar="FILE.json", help=report)


def _add_batch(add: Adder) -> None:
    folder = "for the results, each named as its input; made if it is not there"
    add("--output-folder", type=Path, metavar="DIR", help=folder)
    recursive = "take folders with the folders in them, and lay the results out alike"
    add("--recursive", action="store_true", help=recursive)
    add("--force", action="store_true", help="do also what is done already")


def _add_picture(add: Adder) -> None:
    degrees = number(-36000, 36000)
    size = number(16, 16384, int)
    add("--engine", choices=("cycles", "workbench"), default="cycles")
    samples = "of cycles; denoised (default: 16)"
    add("--samples", type=number(1, 65536, int), default=16, metavar="N", help=samples)
    whole, axes = "(default: 1600 540)", ("X", "Y", "Z")
    add("--resolution", nargs=2, type=size, default=[1600, 540], metavar=("W", "H"), help=whole)
    upright = "degrees that stand the objects upright, for files with another idea of up; the"
    upright += " result does not change"
    add("--turn", nargs=3, type=degrees, default=[0.0] * 3, metavar=axes, help=upright)
    side = "that the objects are turned about the vertical toward the camera (default: 32; files"
    side += " that show their back have another idea of front: 212)"
    add("--view", type=degrees, default=32.0, metavar="DEGREES", help=side)
    turns = "a picture sequence name_0001.png ..., each object turning about its vertical axis"
    add("--turntable", type=number(1, 9999, int), default=0, metavar="FRAMES", help=turns)


GROUPS = {
    "what is read": _add_inputs,
    "the cubic style": _add_method,
    "what holds together": _add_shape,
    "what is written": _add_outputs,
    "several files": _add_batch,
    "the picture": _add_picture,
}


def _axes(text: str) -> str:
    axes = text.lower()
    if axes in ("auto", "off"):
        return axes.removeprefix("off")
    if set(axes) - set("xyz") or len(set(axes)) < len(axes):
        raise argparse.ArgumentTypeError(
            f"{text!r} is none of auto, off, x, y, z, xy, xz, yz and xyz"
        )
    return "".join(sorted(axes))
