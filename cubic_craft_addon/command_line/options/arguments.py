# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line: options, their ranges, and what does not go together."""

import argparse
import json
from pathlib import Path
from typing import Any, NamedTuple, NoReturn

from ....solver.console.method_options import (
    Adder,
    OneLineParser,
    add_settings,
    as_in_paper,
    defaults,
    number,
)
from ....solver.method import Advanced, Computation, Kept, KeptInScene, Method, Style, StyleInScene
from .checks import check_batch, check_single
from .handles_file import read_handles
from .help_texts import COMMON, EPILOG, HELP, WHOLE_EPILOG
from .region_option import region_option

DEFAULTS = {**defaults(Method), "symmetry": ("auto", "")}
"""name: by default, with ``--paper``"""


class _HelpAll(argparse.Action):
    def __call__(self, parser: argparse.ArgumentParser, *_: Any) -> NoReturn:
        _parser(parser.prog, is_whole=True).print_help()
        parser.exit()


def parse(arguments: list[str], program: str = "headless_render.py") -> argparse.Namespace:
    """Read the command line and check everything that can be checked without Blender.

    `program`: how it is started, for --help. Returns one attribute per option; what ``--paper``
    stands for is set, and ``handles`` is a list of `GivenHandle`. For one file ``output_folder`` is
    None; ``output``, ``save_mesh`` and ``report`` are paths or None, and ``input`` is a path or
    None for the monkey. Else it is the folder of a batch; ``inputs`` are files and folders, and
    ``save_mesh`` is None or how the names shall end. Raises InputError: an option, the input or an
    output path cannot be used.
    """
    options = _parser(program).parse_args(arguments)
    options.cubeness = list(dict.fromkeys(options.cubeness))
    for name, values in DEFAULTS.items():
        if getattr(options, name) is None:
            setattr(options, name, values[options.paper])
    options.input = None
    if options.worker:
        options.worker = Worker(*json.loads(options.worker))
        options = options_for(options, options.worker.name, Path(options.worker.path))
    if len(options.inputs) > 1 or options.output_folder or any(p.is_dir() for p in options.inputs):
        check_batch(options)
    else:
        options.input = options.inputs[0] if options.inputs else None
        check_single(options)
    options.handles = read_handles(options.handles_file) if options.handles_file else []
    return options


def _parser(program: str, is_whole: bool = False) -> argparse.ArgumentParser:
    """Return the parser; if it is whole, its help shows all options."""
    parser = OneLineParser(
        prog=program,
        usage=f"{program} [INPUT ...] [options]",
        description="Turn meshes into cubic sculptures: pictures, meshes and a report.",
        epilog=WHOLE_EPILOG if is_whole else EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
        add_help=False,
    )

    def adder(group: argparse._ActionsContainer) -> Adder:
        def add(name: str, **how: Any) -> None:
            is_shown = is_whole or name in COMMON
            how.setdefault("help", HELP.get(name))
            group.add_argument(name, **how if is_shown else {**how, "help": argparse.SUPPRESS})

        return add

    add = adder(parser)
    add("inputs", nargs="*", type=Path, metavar="INPUT")
    add("--object", metavar="NAME")
    _add_method(adder(parser.add_argument_group("the cubic style")))
    _add_shape(adder(parser.add_argument_group("what holds together")))
    _add_outputs(adder(parser.add_argument_group("what is written")))
    _add_batch(adder(parser.add_argument_group("several files")))
    _add_picture(adder(parser.add_argument_group("the picture")))
    add("--timeout", type=number(1, 1e8), metavar="SECONDS")
    add("--threads", type=number(1, 1024, int), metavar="N")
    add("--worker", default="", metavar="JSON")
    add("--child", action="store_true")
    add("--verbose", action="store_true")
    parser.add_argument("-h", "--help", action="help", help="the most common options")
    none = {"nargs": 0, "default": argparse.SUPPRESS}
    parser.add_argument("--help-all", action=_HelpAll, help="all options", **none)
    return parser


def _add_method(add: Adder) -> None:
    several = {"nargs": "+", "default": [Method.cubeness]}
    in_scene = {"choices": ("world", "object")}
    add_settings(add, Style, StyleInScene, cubeness=several, space=in_scene)
    add("--form-object", type=Path, metavar="FILE")
    add("--region", nargs="+", type=region_option, default=[], metavar="GROUP:FORM:CUBENESS")
    add("--capture", type=Path, metavar="FILE")
    add("--pin", nargs="+", default=[], metavar="GROUP")
    add("--handles", dest="handles_file", type=Path, metavar="FILE.json")
    add_settings(add, Computation)


def _add_shape(add: Adder) -> None:
    add_settings(add, Kept, Advanced, KeptInScene)
    add("--symmetry", type=_axes, metavar="AXES")
    add("--with-modifiers", action="store_true")
    add("--paper", action="store_true", help=as_in_paper(DEFAULTS))


def _add_outputs(add: Adder) -> None:
    add("--output", type=Path, metavar="PICTURE.png")
    add("--no-render", action="store_true")
    add("--save-mesh", metavar="FILE")
    add("--low-poly", nargs="+", type=number(12, 10_000_000, int), default=[], metavar="N")
    add("--bake", type=Path, metavar="FILE")
    frame = number(-1048574, 1048574, int)
    add("--frames", nargs=2, type=frame, metavar=("A", "B"))
    add("--part", nargs=2, type=number(1, 10000, int), metavar=("K", "N"))
    add("--report", type=Path, metavar="FILE.json")


def _add_batch(add: Adder) -> None:
    add("--output-folder", type=Path, metavar="DIR")
    add("--recursive", action="store_true")
    add("--only", type=number(1, 1_000_000, int), metavar="K")
    add("--jobs", type=number(1, 1024, int), metavar="N")
    add("--force", action="store_true")


def _add_picture(add: Adder) -> None:
    degrees = number(-36000, 36000)
    size = number(16, 16384, int)
    add("--engine", choices=("cycles", "workbench"), default="cycles")
    add("--samples", type=number(1, 65536, int), default=16, metavar="N")
    add("--resolution", nargs=2, type=size, default=[1600, 540], metavar=("W", "H"))
    add("--turn", nargs=3, type=degrees, default=[0.0] * 3, metavar=("X", "Y", "Z"))
    add("--view", type=degrees, metavar="DEGREES")
    add("--turntable", type=number(1, 9999, int), default=0, metavar="FRAMES")


def _axes(text: str) -> str:
    axes = text.lower()
    if axes in ("auto", "off"):
        return axes.removeprefix("off")
    if set(axes) - set("xyz") or len(set(axes)) < len(axes):
        raise argparse.ArgumentTypeError(
            f"{text!r} is none of auto, off, x, y, z, xy, xz, yz and xyz"
        )
    return "".join(sorted(axes))


class Worker(NamedTuple):
    """Which file a process does."""

    path: str
    """absolute"""
    name: str
    """of its results"""
    key: str
    """of all that decides about its results"""


def options_for(options: argparse.Namespace, name: str, path: Path) -> argparse.Namespace:
    """Return the options of a batch as those of a run with one file."""
    folder = options.output_folder.resolve()
    own = argparse.Namespace(**vars(options))
    own.jobs = own.force = own.recursive = own.only = own.output_folder = None
    own.inputs, own.report = [path], folder / ".cubic_craft" / f"{name}.json"
    own.output = None if options.no_render or options.bake else folder / f"{name}.png"
    own.save_mesh = options.save_mesh and folder / f"{name}{options.save_mesh}"
    own.bake = options.bake and folder / f"{name}{options.bake}"
    return own
