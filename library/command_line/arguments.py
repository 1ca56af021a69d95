# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the command; they mean what they do in ``blender -c cubic_craft``."""

import argparse
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from solver.console import method_options
from solver.console.method_options import FORMS, OneLineParser
from solver.console.output import InputError
from solver.method import IN_LIBRARY

FORMATS = (".obj", ".ply", ".stl", ".off", ".glb", ".gltf")
DEFAULTS = {**method_options.defaults(*IN_LIBRARY), "together": ("parts", "off")}
"""name: by default, with ``--paper``"""

TOGETHER = {
    "choices": ("off", "parts"),
    "help": "parts: parts that touch stay on each other, and seams stay closed (default: parts)",
}

HELP = {
    "paths": f"surfaces ({', '.join(FORMATS)}) or folders of them, and at the end the result: a "
    "file, or for several surfaces a folder, which is made",
    "--report": "numbers of each file, written after it",
    "--quiet": "say nothing but what is wrong",
    "--paper": method_options.as_in_paper(DEFAULTS),
}

EPILOG = """\
An output has the vertices and faces of the input, in its order; only positions change.
Angles and the poles of forms are relative to the axes of the file, with the poles along its Z.
Exit codes: 0 all outputs are written, 2 nothing was begun because of what was given, 3 some files
failed, 130 interrupted.
"""


def parse(arguments: list[str]) -> argparse.Namespace:
    """Read the command line.

    Returns one attribute per option, and the ``inputs`` (str) and the ``output``; what ``--paper``
    stands for is set. Raises InputError: an option cannot be used.
    """
    options = _parser().parse_intermixed_args(arguments)
    *options.inputs, options.output = options.paths
    if not options.inputs:
        raise InputError("the following arguments are required: OUTPUT")
    method_options.fill_in(options, DEFAULTS)
    return options


def _parser() -> argparse.ArgumentParser:
    parser = OneLineParser(
        prog="cubic-craft",
        usage="cubic-craft [options] INPUT [INPUT ...] OUTPUT",
        description="Turn a mesh into a cubic sculpture.",
        epilog=EPILOG,
    )

    def add(name: str, **how: Any) -> None:
        parser.add_argument(name, **{"help": HELP.get(name), **how})

    add("paths", nargs="+", metavar="INPUT ... OUTPUT")
    method_options.add_settings(add, *IN_LIBRARY, form={"choices": FORMS}, together=TOGETHER)
    add("--paper", action="store_true")
    add("--report", type=Path, metavar="FILE.json")
    add("--quiet", action="store_true")
    parser.add_argument("--version", action="version", version=_version())
    return parser


def _version() -> str:
    try:
        return f"cubic-craft {version('cubic-craft')}"
    except PackageNotFoundError:  # in the checkout
        return "cubic-craft, not installed"
