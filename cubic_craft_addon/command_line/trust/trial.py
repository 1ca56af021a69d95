# SPDX-License-Identifier: GPL-3.0-or-later
"""Have another Blender read a file first: some broken files crash it while it reads them.

Run by itself, this file is that other Blender. What it says is of no interest, only how it ends.
"""

import contextlib
import os
import subprocess
import sys
from pathlib import Path

CRASHING = (".usd", ".usda", ".usdc", ".usdz", ".abc", ".fbx")
"""formats whose importers trust the file"""


def try_to_read(path: Path, importer: str) -> None:
    """Raise InputError if reading a file crashes Blender.

    `importer`: operator, such as "wm.usd_import".
    """
    import bpy

    from ....solver.console.errors import InputError
    from ....solver.console.interruption import before_ending

    blender, own = bpy.app.binary_path, str(Path(__file__).resolve())
    command = [blender, "--background", "--factory-startup", "--python", own, "--"]
    process = subprocess.Popen(
        [*(command if blender else [sys.executable, own, "--"]), str(path.resolve()), importer],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    before_ending(process.kill)
    if process.wait():
        reason = "it crashes Blender, or needs more memory than there is"
        raise InputError(f"{path}: cannot be read ({reason}); export it again")


def _read(path: str, importer: str) -> None:
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    group, _, verb = importer.partition(".")
    with contextlib.suppress(RuntimeError):  # it says why when it is read again
        getattr(getattr(bpy.ops, group), verb)(filepath=path)
    os._exit(0)  # Blender 4.2 crashes at its end


if __name__ == "__main__":
    _read(*sys.argv[sys.argv.index("--") + 1 :])
