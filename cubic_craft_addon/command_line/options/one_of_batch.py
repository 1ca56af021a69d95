# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of a batch, for the process that does one of its files."""

from argparse import Namespace
from pathlib import Path
from typing import NamedTuple


class Worker(NamedTuple):
    """Which file a process does."""

    path: str
    """absolute"""
    name: str
    """of its results"""
    key: str
    """of all that decides about its results"""


def options_for(options: Namespace, name: str, path: Path) -> Namespace:
    """Return the options of a batch as those of a run with one file."""
    folder = options.output_folder.resolve()
    own = Namespace(**vars(options))
    own.jobs = own.force = own.recursive = own.only = own.output_folder = None
    own.inputs, own.report = [path], folder / ".cubic_craft" / f"{name}.json"
    own.output = None if options.no_render or options.bake else folder / f"{name}.png"
    own.save_mesh = options.save_mesh and folder / f"{name}{options.save_mesh}"
    own.bake = options.bake and folder / f"{name}{options.bake}"
    return own
