# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the command; they mean what they do in ``blender -c cubic_craft``."""

import argparse
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from solver.console.errors import InputError
from solver.console.options import FORMS, OneLineParser, number

from .formats import FORMATS

__all__ = ("parse",)

DEFAULTS = {
    "solidity": (0.1, 0.0),
    "keep_pose": ("on", "off"),
    "detail": (0.05, 0.0),
    "keep_apart": ("on", "off"),
    "together": ("parts", "off"),
    "refine": ("auto", "off"),
    "rotation": ("keep", "free"),
}
"""name: by default, with ``--paper``"""

HELP = {
    "paths": f"surfaces ({', '.join(FORMATS)}), and at the end the result: a file, or for several "
    "surfaces a folder; - is standard input or output",
    "--format": "of what is written to standard output (default: that of the input)",
    "--quiet": "say nothing but what is wrong",
    "--cubeness": "0 keeps the shape, 0.1 to 1 are common (default: 0.4)",
    "--form": "what a ball would become (default: cube)",
    "--form-sides": "of a prism or pyramid (default: 6)",
    "--form-weights": "of the axes of a box, whose sides count that much; 1 1 0 makes slabs",
    "--orientation": "Euler angles of the form in degrees: about X, then Y, then Z",
    "--solidity": "how firmly limbs, walls and the volume keep their thickness; 0 is a hollow skin "
    "(default: 0.1)",
    "--keep-pose": "whether limbs become boxes along themselves, so that the pose stays "
    "(default: on)",
    "--detail": "features smaller than this share of the largest extent ride along instead of "
    "being flattened; 0 flattens all (default: 0.05)",
    "--keep-apart": "whether surfaces that do not cross are kept from crossing (default: on)",
    "--together": "parts: parts that touch stay on each other, and seams stay closed "
    "(default: parts)",
    "--refine": "auto: coarse meshes are solved on a finer copy (default: auto)",
    "--rotation": "whether each part is held in its orientation, or may turn as a whole "
    "(default: keep)",
    "--paper": "as in the paper: solidity 0, keep-pose off, detail 0, keep-apart off, together "
    "off, refine off, rotation free; each of them can be given beside it and counts then",
    "--max-iterations": "(default: 1000)",
    "--tolerance": "(default: 0.001)",
    "--device": "(default: auto)",
}

EPILOG = """\
An output has the vertices and faces of the input, in its order; only positions change.
Angles and the poles of forms are relative to the axes of the file, with the poles along its Z.
Exit codes: 0 all outputs are written, 2 one is not, with a line that says why, 130 interrupted.
"""


def parse(arguments: list[str]) -> argparse.Namespace:
    """Read the command line.

    Returns
    -------
    argparse.Namespace
        One attribute per option, and the ``inputs`` (str) and the ``output``; what ``--paper``
        stands for is set.

    Raises
    ------
    InputError
        An option cannot be used.
    """
    options = _parser().parse_intermixed_args(arguments)
    *options.inputs, options.output = options.paths
    if not options.inputs:
        raise InputError("the following arguments are required: OUTPUT")
    for name, values in DEFAULTS.items():
        if getattr(options, name) is None:
            setattr(options, name, values[options.paper])
    return options


def _parser() -> argparse.ArgumentParser:
    parser = OneLineParser(
        prog="cubic-craft",
        usage="cubic-craft [options] INPUT [INPUT ...] OUTPUT",
        description="Turn a mesh into a cubic sculpture.",
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )

    def add(name: str, **how: Any) -> None:
        parser.add_argument(name, help=HELP[name], **how)

    add("paths", nargs="+", metavar="INPUT ... OUTPUT")
    add("--cubeness", type=number(0, 10), default=0.4, metavar="L")
    add("--form", choices=FORMS, default="cube")
    add("--form-sides", type=number(3, 64, int), default=6, metavar="N")
    weights, degrees = number(0, 10), number(-36000, 36000)
    add("--form-weights", nargs=3, type=weights, default=[1.0] * 3, metavar=("X", "Y", "Z"))
    add("--orientation", nargs=3, type=degrees, default=[0.0] * 3, metavar=("X", "Y", "Z"))
    add("--solidity", type=number(0, 10), metavar="S")
    add("--keep-pose", choices=("on", "off"))
    add("--detail", type=number(0, 1), metavar="SIZE")
    add("--keep-apart", choices=("on", "off"))
    add("--together", choices=("off", "parts"))
    add("--refine", choices=("auto", "off"))
    add("--rotation", choices=("keep", "free"))
    add("--paper", action="store_true")
    add("--max-iterations", type=number(1, 1_000_000, int), default=1000, metavar="N")
    add("--tolerance", type=number(1e-12, 1), default=1e-3, metavar="T")
    add("--device", choices=("auto", "cpu", "gpu", "numpy"), default="auto")
    add("--format", choices=[suffix.removeprefix(".") for suffix in FORMATS])
    add("--quiet", action="store_true")
    parser.add_argument("--version", action="version", version=_version())
    return parser


def _version() -> str:
    try:
        return f"cubic-craft {version('cubic-craft')}"
    except PackageNotFoundError:  # in the checkout
        return "cubic-craft, not installed"
