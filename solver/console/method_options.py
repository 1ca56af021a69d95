# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of the method, which mean the same on both command lines."""

from collections.abc import Callable

from .options import number

__all__ = ("DEFAULTS", "HELP", "Adder", "add_form", "add_kept", "add_solver")

Adder = Callable[..., None]
"""takes the name of an option, and what `ArgumentParser.add_argument` does besides its help"""

DEFAULTS = {
    "crispness": (0.9, 0.0),
    "solidity": (0.3, 0.0),
    "keep_pose": ("on", "off"),
    "detail": (0.05, 0.0),
    "detail_strength": (1.0, 1.0),
    "keep_apart": ("on", "off"),
    "refine": ("auto", "off"),
    "rotation": ("keep", "free"),
}
"""name: by default, with ``--paper``"""

HELP = {
    "--cubeness": "0 keeps the shape, 0.1 to 1 are common (default: 0.4)",
    "--form": "what a ball would become (default: cube)",
    "--form-sides": "of a prism or pyramid (default: 6)",
    "--form-weights": "of the axes of a box, whose sides count that much; 1 1 0 makes slabs",
    "--crispness": "how far sides are made flat and edges straight: from 0, soft, to 1 "
    "(default: 0.9)",
    "--solidity": "how firmly limbs, walls and the volume keep their thickness; 0 is a hollow skin "
    "(default: 0.3)",
    "--keep-pose": "whether limbs become boxes along themselves, so that the pose stays "
    "(default: on)",
    "--detail": "features smaller than this share of the largest extent ride along instead of "
    "being flattened; 0 flattens all (default: 0.05)",
    "--detail-strength": "how high these features stand out: 0 removes them, 2 doubles them "
    "(default: 1)",
    "--keep-apart": "whether surfaces that do not cross are kept from crossing (default: on)",
    "--refine": "auto: coarse meshes are solved on a finer copy (default: auto)",
    "--rotation": "whether each part is held in its orientation, or may turn as a whole "
    "(default: keep)",
    "--max-iterations": "(default: 1000)",
    "--tolerance": "(default: 0.001)",
    "--device": "(default: auto)",
}


def add_form(add: Adder) -> None:
    """Add the settings of forms with a name, and how they lie."""
    add("--form-sides", type=number(3, 64, int), default=6, metavar="N")
    weights, degrees = number(0, 10), number(-36000, 36000)
    add("--form-weights", nargs=3, type=weights, default=[1.0] * 3, metavar=("X", "Y", "Z"))
    add("--orientation", nargs=3, type=degrees, default=[0.0] * 3, metavar=("X", "Y", "Z"))


def add_kept(add: Adder) -> None:
    """Add what is kept of the mesh; without a default, which is one of `DEFAULTS`."""
    add("--crispness", type=number(0, 1), metavar="C")
    add("--solidity", type=number(0, 10), metavar="S")
    add("--keep-pose", choices=("on", "off"))
    add("--detail", type=number(0, 1), metavar="SIZE")
    add("--detail-strength", type=number(0, 10), metavar="S")
    add("--keep-apart", choices=("on", "off"))
    add("--refine", choices=("auto", "off"))
    add("--rotation", choices=("keep", "free"))


def add_solver(add: Adder) -> None:
    """Add when the solver stops, and where it runs."""
    add("--max-iterations", type=number(1, 1_000_000, int), default=1000, metavar="N")
    add("--tolerance", type=number(1e-12, 1), default=1e-3, metavar="T")
    add("--device", choices=("auto", "cpu", "gpu", "numpy"), default="auto")
