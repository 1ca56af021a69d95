# SPDX-License-Identifier: GPL-3.0-or-later
"""A trial in a process of its own, of importers that crash Blender where a file is broken."""

import subprocess
import sys
from pathlib import Path

import bpy

from ....solver.console.output import InputError

CRASHING = (".usd", ".usda", ".usdc", ".usdz", ".abc", ".fbx")
"""formats whose importers trust the file"""
_LARGEST = 255  # exit codes of what has ended by itself; on Windows, crashes have others


def refuse_crashing(path: Path, importer: str) -> None:
    """Read a file of such a format in another Blender first.

    Raises InputError: that crashes. Whatever else is wrong, the import will tell.
    """
    if path.suffix.lower() not in CRASHING:
        return
    code = f"import bpy; bpy.ops.{importer}(filepath={str(path)!r})"
    blender = bpy.app.binary_path  # none: the module
    command = [sys.executable, "-c", code]
    if blender:
        command = [blender, "--background", "--factory-startup", "--python-expr", code]
    ended = subprocess.run(command, capture_output=True, check=False).returncode
    if ended < 0 or ended > _LARGEST:
        raise InputError(f"{path}: crashes Blender (exit code {ended}); export it again")
