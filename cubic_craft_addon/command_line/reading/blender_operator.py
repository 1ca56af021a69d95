# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's importers and exporters, which a Blender may have been built without."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy

from ....solver.console.errors import InputError


def operator(name: str, path: Path) -> Callable[..., Any]:
    """Return an operator by its name, such as "wm.obj_import".

    Raises InputError: this Blender does not have it; ``path`` is the file that it was meant for.
    """
    group, _, verb = name.partition(".")
    if verb not in dir(getattr(bpy.ops, group)):
        message = f"{path}: this Blender was built without support for {path.suffix} files"
        raise InputError(f"{message}; choose another format")
    return getattr(getattr(bpy.ops, group), verb)


def reason(error: RuntimeError) -> str:
    """Return the first line of what an operator reported when it failed.

    Of an exception in an operator that is written in Python, it is the exception itself.
    """
    lines = str(error).strip().splitlines() or ["no reason given"]
    if "Traceback (most recent call last)" in lines[0]:
        own = [line for line in lines[1:] if not line.startswith((" ", "Location:"))]
        return own[-1].rstrip(". ") if own else "an exception in Blender"
    return lines[0].removeprefix("Error: ").rstrip(". ")
