# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line: options, their ranges, and what does not go together."""

import argparse
import json
import shlex
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, NoReturn

from ..process.errors import InputError
from .checks import check_batch, check_single
from .formats import ANIMATED, KEEP_VERTICES, READABLE, listing
from .handles_file import read_handles
from .region_option import region_option

__all__ = ("parse",)

_Adder = Callable[..., None]
"""takes the name of an option, and what `ArgumentParser.add_argument` does besides its help"""

FORMS = (
    *("cube", "box", "rounded", "octahedron", "tetrahedron", "dodecahedron", "icosahedron"),
    *("rhombic", "prism", "pyramid", "cylinder", "cone", "object", "directions", "faces"),
)
OF_FILE = ("object", "directions")
"""forms that are made from a file"""
DEFAULTS = {
    "solidity": (0.1, 0.0),
    "keep_pose": ("on", "off"),
    "detail": (0.05, 0.0),
    "keep_apart": ("on", "off"),
    "together": ("selection", "off"),
    "refine": ("auto", "off"),
    "rotation": ("keep", "free"),
    "hold_rest": ("on", "off"),
}
"""name: by default, with ``--paper``"""

COMMON = (
    *("inputs", "--cubeness", "--form", "--orientation", "--pin", "--detail", "--output"),
    *("--no-render", "--save-mesh", "--bake", "--output-folder", "--jobs", "--turn"),
)
"""what --help shows; --help-all shows all"""

HELP = {
    "inputs": f"{listing(READABLE)}; without it, Blender's monkey, subdivided; for a batch several "
    "files, or folders of them",
    "--object": "this mesh object only (default: all that are shown and rendered)",
    "--threads": "of the processor (default: all of them, in a batch shared by its jobs)",
    "--timeout": "for each file: one that takes longer is given up (default: none)",
    "--memory": "for each file: one that takes more is given up (default: none)",
    "--options": "more of these options, in one text: for programs that hand on one",
    "--worker": argparse.SUPPRESS,
    "--limited": argparse.SUPPRESS,
    "--verbose": "show Blender's own messages",
    "--cubeness": "0 keeps the shape, 0.1 to 1 are common (default: 0.4)",
    "--form": "what a ball would become (default: cube)",
    "--form-sides": "of a prism or pyramid (default: 6)",
    "--form-weights": "of the axes of a box, whose sides count that much; 1 1 0 makes slabs",
    "--form-object": "for --form object the file whose convex hull is the form, for directions the "
    "one whose faces are, about the origin of its scene",
    "--region": "a vertex group with a form and a cubeness of its own, such as head:octahedron:0.8 "
    "or, with a number of sides, hat:prism5:1; where its weights are less than 1, it blends into "
    "the rest",
    "--capture": "file with a ball whose normals say which way a surface should face that faces as "
    "its vertices do from the origin of its scene",
    "--capture-strength": "of the normals of --capture, beside the cubeness (default: 0.4)",
    "--form-directions": "for --form faces the directions of its sides, three numbers for each: "
    '"0 0 1, 1 0 0"; where they leave a side open, those opposite are added',
    "--orientation": "Euler angles of the form in degrees, as in the panel",
    "--space": "what they are relative to: the axes of the scene that the file is read into, where "
    "Z is up, or those of each object (default: world)",
    "--pin": "vertex groups that stay in place",
    "--handles": "parts of the mesh that are held or moved, see below",
    "--map": "vertex group that scales the cubeness",
    "--tolerance": "(default: 0.001)",
    "--solidity": "how firmly limbs, walls and the volume keep their thickness; 0 is a hollow skin "
    "(default: 0.1)",
    "--keep-pose": "whether limbs become boxes along themselves, so that the pose stays "
    "(default: on)",
    "--detail": "features smaller than this share of the largest extent ride along instead of "
    "being flattened; 0 flattens all (default: 0.05)",
    "--keep-apart": "whether surfaces that do not cross are kept from crossing (default: on)",
    "--together": "parts: the parts of a mesh stay on each other; selection: all meshes of the "
    "file do (default: selection)",
    "--refine": "auto: coarse meshes are solved on a finer copy (default: auto)",
    "--rotation": "whether each part is held in its orientation, or may turn as a whole "
    "(default: keep)",
    "--symmetry": "x, y, z or several: halves that are mirror images about the object's origin "
    "stay so",
    "--floor": "what stands on the ground keeps its height",
    "--with-modifiers": "take what is seen: meshes with their modifiers applied, texts, curves, "
    "surfaces and metaballs as meshes",
    "--hold-rest": "whether what is far from handles that are moved stays where it is "
    "(default: on)",
    "--paper": "as in the paper: solidity 0, keep-pose off, detail 0, keep-apart off, together "
    "off, refine off, rotation free, hold-rest off; each of them can be given beside it and counts "
    "then",
    "--output": "(default: cubic_craft.png)",
    "--no-render": "no picture",
    "--save-mesh": f"the result, vertex order and count kept: {listing(KEEP_VERTICES)}; with "
    "several cubeness values one file each (name_0.4.obj); in a batch the end of the names, such "
    "as .obj or _cubic.obj",
    "--bake": f"the cubic version of each frame of an animation: {listing(ANIMATED)}; instead of "
    "a picture and a mesh; in a batch the end of the names. A run that was ended continues where "
    "it was",
    "--frames": "first and last frame for --bake (default: those of the file)",
    "--part": "for --bake on several machines: solves the Kth of N parts of the frames; when all "
    "are solved, the same command without --part writes the file",
    "--report": "numbers of the run",
    "--error-file": "if the input cannot be used, write why to this file and end with exit code 0: "
    "for render farms, which would blame the machine; in a batch with --only",
    "--output-folder": "for the results, each named as its input; made if it is not there",
    "--recursive": "take folders with the folders in them, and lay the results out alike",
    "--only": "this file of them only, counted from 1: for render farms, where each is a task",
    "--jobs": "files worked on at the same time, each in a Blender of its own (default: 1)",
    "--scheduler": "of a Dask cluster whose workers do the files, such as tcp://host:8786",
    "--force": "do also what is done already",
    "--samples": "of cycles; denoised (default: 16)",
    "--resolution": "(default: 1600 540)",
    "--turn": "degrees that stand the objects upright, for files with another idea of up; the "
    "result does not change",
    "--turntable": "a picture sequence name_0001.png ..., each object turning about its vertical "
    "axis",
}

EPILOG = """\
The picture shows the original beside one result per cubeness.
Several files, or folders of them, go to a folder: --output-folder DIR.
Exit codes: 0 all is done, 2 nothing was begun because of what was given, 3 some files failed,
130 interrupted.
"""
WHOLE_EPILOG = """\
The picture shows the original beside one result per cubeness. With --turntable it becomes a
sequence name_0001.png ... in which every object turns once about its vertical axis.
Orientation 0 0 0 means the axes of the scene, where Z is up; with --space object those of each
object, which for an .obj are those of the file.
Options of Blender itself stand before the command: blender --threads 2 -c cubic_craft [options];
where the extension is not installed: blender -b -P scripts/headless_render.py -- [options]

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


class _HelpAll(argparse.Action):
    """Shows all options."""

    def __call__(self, parser: argparse.ArgumentParser, *_: Any) -> NoReturn:
        _parser(parser.prog, is_whole=True).print_help()
        parser.exit()


def parse(arguments: list[str], program: str = "headless_render.py") -> argparse.Namespace:
    """Read the command line and check everything that can be checked without Blender.

    Parameters
    ----------
    program : how it is started, for --help

    Returns
    -------
    argparse.Namespace
        One attribute per option; what ``--paper`` stands for is set, and ``handles`` is a list of
        `GivenHandle`. For one file ``output_folder`` is None; ``output``, ``save_mesh`` and
        ``report`` are paths or None, and ``input`` is a path or None for the monkey. Else it is the
        folder of a batch; ``inputs`` are files and folders, and ``save_mesh`` is None or how the
        names shall end.

    Raises
    ------
    InputError
        An option, the input or an output path cannot be used.
    """
    options = _parser(program).parse_args(arguments)
    if options.options:
        options = _parser(program).parse_args([*arguments, *_words(options.options)])
    if options.worker:  # what is the same for all files, as `batch.plan.settings_of` has it
        vars(options).update(json.loads(sys.stdin.readline()))
    options.cubeness = list(dict.fromkeys(options.cubeness))
    for name, values in DEFAULTS.items():
        if getattr(options, name) is None:
            setattr(options, name, values[options.paper])
    options.input = None
    if len(options.inputs) > 1 or options.output_folder or any(p.is_dir() for p in options.inputs):
        check_batch(options)
    else:
        options.input = options.inputs[0] if options.inputs else None
        check_single(options)
    options.handles = read_handles(options.handles_file) if options.handles_file else []
    return options


def _parser(program: str, is_whole: bool = False) -> argparse.ArgumentParser:
    """Return the parser; if it is whole, its help shows all options."""
    parser = _Parser(
        prog=program,
        usage=f"{program} [INPUT ...] [options]",
        description="Turn meshes into cubic sculptures: pictures, meshes and a report.",
        epilog=WHOLE_EPILOG if is_whole else EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
        add_help=False,
    )

    def adder(group: argparse._ActionsContainer) -> _Adder:
        def add(name: str, **how: Any) -> None:
            is_shown = is_whole or name in COMMON
            group.add_argument(name, help=HELP.get(name) if is_shown else argparse.SUPPRESS, **how)

        return add

    add = adder(parser)
    add("inputs", nargs="*", type=Path, metavar="INPUT")
    add("--object", metavar="NAME")
    _add_method(adder(parser.add_argument_group("the cubic style")))
    _add_shape(adder(parser.add_argument_group("what holds together")))
    _add_outputs(adder(parser.add_argument_group("what is written")))
    _add_batch(adder(parser.add_argument_group("several files")))
    _add_picture(adder(parser.add_argument_group("the picture")))
    add("--timeout", type=_number(1, 1e8), metavar="SECONDS")
    add("--memory", type=_number(0.001, 1e6), metavar="GB")
    add("--threads", type=_number(1, 1024, int), metavar="N")
    add("--options", default="", metavar="TEXT")
    add("--worker", default="", metavar="KEY:BATCH")
    add("--limited", action="store_true")
    add("--verbose", action="store_true")
    parser.add_argument("-h", "--help", action="help", help="the most common options")
    none = {"nargs": 0, "default": argparse.SUPPRESS}
    parser.add_argument("--help-all", action=_HelpAll, help="all options", **none)
    return parser


def _add_method(add: _Adder) -> None:
    degrees = _number(-36000, 36000)
    add("--cubeness", nargs="+", type=_number(0, 10), default=[0.4], metavar="L")
    add("--form", choices=FORMS, default="cube")
    add("--form-sides", type=_number(3, 64, int), default=6, metavar="N")
    weights = _number(0, 10)
    add("--form-weights", nargs=3, type=weights, default=[1.0] * 3, metavar=("X", "Y", "Z"))
    add("--form-object", type=Path, metavar="FILE")
    add("--form-directions", default="", metavar="VECTORS")
    region = region_option([name for name in FORMS if name not in ("box", "faces", *OF_FILE)])
    add("--region", nargs="+", type=region, default=[], metavar="GROUP:FORM:CUBENESS")
    add("--capture", type=Path, metavar="FILE")
    add("--capture-strength", type=_number(0, 10), default=0.4, metavar="X")
    add("--orientation", nargs=3, type=degrees, default=[0.0] * 3, metavar=("X", "Y", "Z"))
    add("--space", choices=("world", "object"), default="world")
    add("--pin", nargs="+", default=[], metavar="GROUP")
    add("--handles", dest="handles_file", type=Path, metavar="FILE.json")
    add("--map", default="", metavar="GROUP")
    add("--max-iterations", type=_number(1, 1_000_000, int), default=1000, metavar="N")
    add("--tolerance", type=_number(1e-12, 1), default=1e-3, metavar="T")
    add("--device", choices=("auto", "cpu", "gpu", "numpy"), default="auto")


def _add_shape(add: _Adder) -> None:
    add("--solidity", type=_number(0, 10), metavar="S")
    add("--keep-pose", choices=("on", "off"))
    add("--detail", type=_number(0, 1), metavar="SIZE")
    add("--keep-apart", choices=("on", "off"))
    add("--together", choices=("off", "parts", "selection"))
    add("--refine", choices=("auto", "off"))
    add("--rotation", choices=("keep", "free"))
    add("--symmetry", type=_axes, default="", metavar="AXES")
    add("--floor", action="store_true")
    add("--with-modifiers", action="store_true")
    add("--hold-rest", choices=("on", "off"))
    add("--paper", action="store_true")


def _add_outputs(add: _Adder) -> None:
    add("--output", type=Path, metavar="PICTURE.png")
    add("--no-render", action="store_true")
    add("--save-mesh", metavar="FILE")
    add("--bake", type=Path, metavar="FILE")
    frame = _number(-1048574, 1048574, int)
    add("--frames", nargs=2, type=frame, metavar=("A", "B"))
    add("--part", nargs=2, type=_number(1, 10000, int), metavar=("K", "N"))
    add("--report", type=Path, metavar="FILE.json")
    add("--error-file", type=Path, metavar="FILE")


def _add_batch(add: _Adder) -> None:
    add("--output-folder", type=Path, metavar="DIR")
    add("--recursive", action="store_true")
    add("--only", type=_number(1, 1_000_000, int), metavar="K")
    add("--jobs", type=_number(1, 1024, int), metavar="N")
    add("--scheduler", metavar="ADDRESS")
    add("--force", action="store_true")


def _add_picture(add: _Adder) -> None:
    degrees = _number(-36000, 36000)
    size = _number(16, 16384, int)
    add("--engine", choices=("cycles", "workbench"), default="cycles")
    add("--samples", type=_number(1, 65536, int), default=16, metavar="N")
    add("--resolution", nargs=2, type=size, default=[1600, 540], metavar=("W", "H"))
    add("--turn", nargs=3, type=degrees, default=[0.0] * 3, metavar=("X", "Y", "Z"))
    add("--turntable", type=_number(1, 9999, int), default=0, metavar="FRAMES")


def _number(low: float, high: float, kind: type = float) -> Callable[[str], float]:
    def number(text: str) -> float:
        try:
            value = kind(text)
        except ValueError:
            what = "a number" if kind is float else "a whole number"
            hint = " (put the input file first)" if Path(text).suffix in READABLE else ""
            raise argparse.ArgumentTypeError(f"{text!r} is not {what}{hint}") from None
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"{text} is not between {low} and {high}")
        return value

    return number


def _words(text: str) -> list[str]:
    """Split a text as a shell does, but for backslashes, which stand in paths of Windows."""
    words = shlex.shlex(text, posix=True)
    words.whitespace_split, words.escape, words.commenters = True, "", ""
    try:
        return list(words)
    except ValueError:
        raise InputError(f"--options {text}: a quotation mark is not closed") from None


def _axes(text: str) -> str:
    axes = text.lower()
    if set(axes) - set("xyz") or len(set(axes)) < len(axes):
        raise argparse.ArgumentTypeError(f"{text!r} is none of x, y, z, xy, xz, yz and xyz")
    return "".join(sorted(axes))
