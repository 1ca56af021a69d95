# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line: options, their ranges, and what does not go together."""

import argparse
import math
from collections.abc import Callable, Collection
from decimal import Decimal
from pathlib import Path
from typing import NoReturn

from .batch.checks import check_batch
from .checks import check_single
from .errors import InputError
from .formats import KEEP_VERTICES, READABLE, listing
from .handles_file import read_handles

__all__ = ("as_arguments", "parse")

DEFAULTS = {
    "solidity": 0.1,
    "together": "selection",
    "refine": "auto",
    "rotation": "keep",
    "hold_rest": "on",
}
PAPER = {
    "solidity": 0.0,
    "together": "off",
    "refine": "off",
    "rotation": "free",
    "hold_rest": "off",
}
"""what ``--paper`` stands for"""

EPILOG = """\
The picture shows the original beside one result per cubeness. With --turntable it becomes a
sequence name_0001.png ... in which every object turns once about its vertical axis.
Orientation 0 0 0 means the axes of the scene, where Z is up; with --space object those of each
object, which for an .obj are those of the file.
In Blender: blender -b -P scripts/headless_render.py -- [options]

Several files, or folders of them, go to a folder: --output-folder DIR. A file that cannot be used
does not stop the others. What is there already, made of the same file with the same options, is
kept: start a batch again to go on where it was stopped.
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


class _Parser(argparse.ArgumentParser):
    """An ArgumentParser whose errors are one line, like all others."""

    def error(self, message: str) -> NoReturn:
        raise InputError(message.removeprefix("argument "))


def parse(arguments: list[str]) -> argparse.Namespace:
    """Read the command line and check everything that can be checked without Blender.

    Returns
    -------
    argparse.Namespace
        One attribute per option; what ``--paper`` stands for is set, and ``handles`` is a list of
        `GivenHandle`. For one file ``output_folder`` is None; ``output``, ``save_mesh`` and
        ``report`` are paths or None, and ``input`` is a path or None for the monkey. Else it is the
        folder of a batch;
        ``inputs`` are files and folders, and ``save_mesh`` is None or how the names shall end.

    Raises
    ------
    InputError
        An option, the input or an output path cannot be used.
    """
    options = _parser().parse_args(arguments)
    options.cubeness = list(dict.fromkeys(options.cubeness))
    for name, value in (PAPER if options.paper else DEFAULTS).items():
        if getattr(options, name) is None:
            setattr(options, name, value)
    options.input = None
    if len(options.inputs) > 1 or options.output_folder or any(p.is_dir() for p in options.inputs):
        check_batch(options)
    else:
        options.input = options.inputs[0] if options.inputs else None
        check_single(options)
    options.handles = read_handles(options.handles_file) if options.handles_file else []
    return options


def as_arguments(options: argparse.Namespace, names: Collection[str]) -> list[str]:
    """Return the command line that gives some of the options, named as their attributes are."""
    arguments = []
    for name in names:
        value = getattr(options, name)
        flag = "--handles" if name == "handles_file" else f"--{name.replace('_', '-')}"
        if isinstance(value, list) and len(value) > 1:
            arguments += [flag, *map(_as_text, value)]
        elif value is True:
            arguments.append(flag)
        elif value or isinstance(value, float):
            single = value[0] if isinstance(value, list) else value
            arguments.append(f"{flag}={_as_text(single)}")
    return arguments


def _as_text(value: object) -> str:
    # Without an exponent: argparse takes -1e-05 for an option.
    return format(Decimal(repr(value)), "f") if isinstance(value, float) else str(value)


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="headless_render.py",
        description="Turn meshes into cubic sculptures: pictures, meshes and a report.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    parser.add_argument(
        "inputs",
        nargs="*",
        type=Path,
        metavar="INPUT",
        help=f"{listing(READABLE)}; without it, Blender's monkey, subdivided; for a batch several "
        "files, or folders of them",
    )
    parser.add_argument("--object", metavar="NAME", help="this mesh object only (default: all)")
    _add_method(parser)
    _add_shape(parser)
    _add_outputs(parser)
    _add_batch(parser)
    _add_picture(parser)
    parser.add_argument(
        "--threads",
        type=_integer(1, 1024),
        metavar="N",
        help="of the processor (default: all of them, in a batch shared by its jobs)",
    )
    parser.add_argument("--worker", default="", metavar="KEY:BATCH", help=argparse.SUPPRESS)
    parser.add_argument("--verbose", action="store_true", help="show Blender's own messages")
    return parser


def _add_method(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("the cubic style")
    group.add_argument(
        "--cubeness",
        nargs="+",
        type=_number(0.0, 10.0),
        default=[0.4],
        metavar="L",
        help="0 keeps the shape, 0.1 to 1 are common (default: 0.4)",
    )
    group.add_argument(
        "--orientation",
        nargs=3,
        type=_number(-36000.0, 36000.0),
        default=[0.0, 0.0, 0.0],
        metavar=("X", "Y", "Z"),
        help="Euler angles of the cube in degrees, as in the panel",
    )
    group.add_argument(
        "--space",
        choices=("world", "object"),
        default="world",
        help="what they are relative to: the axes of the scene that the file is read into, where Z"
        " is up, or those of each object (default: world)",
    )
    group.add_argument(
        "--pin", nargs="+", default=[], metavar="GROUP", help="vertex groups that stay in place"
    )
    group.add_argument(
        "--handles",
        dest="handles_file",
        type=Path,
        metavar="FILE.json",
        help="parts of the mesh that are held or moved, see below",
    )
    group.add_argument(
        "--map", default="", metavar="GROUP", help="vertex group that scales the cubeness"
    )
    group.add_argument("--max-iterations", type=_integer(1, 1_000_000), default=1000, metavar="N")
    group.add_argument(
        "--tolerance", type=_number(1e-12, 1.0), default=1e-3, metavar="T", help="(default: 0.001)"
    )
    group.add_argument("--device", choices=("auto", "cpu", "gpu", "numpy"), default="auto")


def _add_shape(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("what holds together")
    group.add_argument(
        "--solidity",
        type=_number(0.0, 10.0),
        metavar="S",
        help="how firmly limbs, walls and the volume keep their thickness; 0 is a hollow skin "
        "(default: 0.1)",
    )
    group.add_argument(
        "--together",
        choices=("off", "parts", "selection"),
        help="parts: the parts of a mesh stay on each other; selection: all meshes of the file do "
        "(default: selection)",
    )
    group.add_argument(
        "--refine",
        choices=("auto", "off"),
        help="auto: coarse meshes are solved on a finer copy (default: auto)",
    )
    group.add_argument(
        "--rotation",
        choices=("keep", "free"),
        help="whether each part is held in its orientation, or may turn as a whole (default: keep)",
    )
    group.add_argument(
        "--symmetry",
        type=_axes,
        default="",
        metavar="AXES",
        help="x, y, z or several: halves that are mirror images about the object's origin stay so",
    )
    group.add_argument(
        "--floor", action="store_true", help="what stands on the ground keeps its height"
    )
    group.add_argument(
        "--with-modifiers",
        action="store_true",
        help="take what is seen: meshes with their modifiers applied, texts, curves, surfaces and "
        "metaballs as meshes",
    )
    group.add_argument(
        "--hold-rest",
        choices=("on", "off"),
        help="whether what is far from handles that are moved stays where it is (default: on)",
    )
    group.add_argument(
        "--paper",
        action="store_true",
        help="as in the paper: solidity 0, together off, refine off, rotation free, hold-rest off; "
        "each of them can be given beside it and counts then",
    )


def _add_outputs(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("what is written")
    group.add_argument(
        "--output", type=Path, metavar="PICTURE.png", help="(default: cubic_craft.png)"
    )
    group.add_argument("--no-render", action="store_true", help="no picture")
    group.add_argument(
        "--save-mesh",
        metavar="FILE",
        help=f"the result, vertex order and count kept: {listing(KEEP_VERTICES)}; with several "
        "cubeness values one file each (name_0.4.obj); in a batch the end of the names, such as "
        ".obj or _cubic.obj",
    )
    group.add_argument("--report", type=Path, metavar="FILE.json", help="numbers of the run")
    group.add_argument(
        "--error-file",
        type=Path,
        metavar="FILE",
        help="if the input cannot be used, write why to this file and end with exit code 0: for "
        "render farms, which would blame the machine",
    )


def _add_batch(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("several files")
    group.add_argument(
        "--output-folder",
        type=Path,
        metavar="DIR",
        help="for the results, each named as its input; made if it is not there",
    )
    group.add_argument(
        "--recursive",
        action="store_true",
        help="take folders with the folders in them, and lay the results out alike",
    )
    group.add_argument(
        "--jobs",
        type=_integer(1, 1024),
        metavar="N",
        help="files worked on at the same time, each in a Blender of its own (default: 1)",
    )
    group.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="of a Dask cluster whose workers do the files, such as tcp://host:8786",
    )
    group.add_argument("--force", action="store_true", help="do also what is done already")


def _add_picture(parser: argparse.ArgumentParser) -> None:
    group = parser.add_argument_group("the picture")
    group.add_argument("--engine", choices=("cycles", "workbench"), default="cycles")
    group.add_argument(
        "--samples",
        type=_integer(1, 65536),
        default=16,
        metavar="N",
        help="of cycles; denoised (default: 16)",
    )
    group.add_argument(
        "--resolution",
        nargs=2,
        type=_integer(16, 16384),
        default=[1600, 540],
        metavar=("W", "H"),
        help="(default: 1600 540)",
    )
    group.add_argument(
        "--turn",
        nargs=3,
        type=_number(-36000.0, 36000.0),
        default=[0.0, 0.0, 0.0],
        metavar=("X", "Y", "Z"),
        help="degrees that stand the objects upright, for files with another idea of up; the "
        "result does not change",
    )
    group.add_argument(
        "--turntable",
        type=_integer(1, 9999),
        default=0,
        metavar="FRAMES",
        help="a picture sequence name_0001.png ..., each object turning about its vertical axis",
    )


def _number(low: float, high: float) -> Callable[[str], float]:
    def number(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            hint = " (put the input file first)" if Path(text).suffix in READABLE else ""
            raise argparse.ArgumentTypeError(f"{text!r} is not a number{hint}") from None
        if not math.isfinite(value) or not low <= value <= high:
            raise argparse.ArgumentTypeError(f"{text} is not between {low:g} and {high:g}")
        return value

    return number


def _axes(text: str) -> str:
    axes = text.lower()
    if set(axes) - set("xyz") or len(set(axes)) < len(axes):
        raise argparse.ArgumentTypeError(f"{text!r} is none of x, y, z, xy, xz, yz and xyz")
    return "".join(sorted(axes))


def _integer(low: int, high: int) -> Callable[[str], int]:
    def integer(text: str) -> int:
        try:
            value = int(text)
        except ValueError:
            raise argparse.ArgumentTypeError(f"{text!r} is not a whole number") from None
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"{text} is not between {low} and {high}")
        return value

    return integer
