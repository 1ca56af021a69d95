# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubify meshes without a window: the command line of the extension, from this tree.

Runs under the ``bpy`` module and in Blender alike, where the extension is not installed::

    python scripts/headless_render.py bunny.obj --cubeness 0.2 0.4
    blender -b -P scripts/headless_render.py -- bunny.obj --cubeness 0.2 0.4
    python scripts/headless_render.py meshes --output-folder cubic
"""

import os
import sys
from pathlib import Path

SCRIPTS = str(Path(__file__).resolve().parent)
if SCRIPTS not in sys.path:  # Blender does not put a script's folder there
    sys.path.insert(0, SCRIPTS)

import cubic_craft  # noqa: E402
from cubic_craft.cubic_craft_addon.command_line.main import main_of  # noqa: E402

IS_INSIDE_BLENDER = "bpy" in sys.modules
NAME = "headless_render.py"


def main() -> int:
    """Do what the command line says, and return the exit code."""
    return main_of(_arguments(), NAME, NAME, cubic_craft.registered)


def leave(code: int) -> None:
    """End the process.

    Blender 4.2 as a Python module crashes while it is freed, if property groups with callbacks were
    ever registered: it keeps the callbacks, and with them itself.
    """
    bpy = sys.modules.get("bpy")
    if bpy is not None and not IS_INSIDE_BLENDER and bpy.app.version < (4, 3):
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)
    sys.exit(code)


def _arguments() -> list[str]:
    """Return the script's own arguments; in Blender those behind ``--``."""
    if "--" in sys.argv:
        return sys.argv[sys.argv.index("--") + 1 :]
    return [] if IS_INSIDE_BLENDER else sys.argv[1:]


if __name__ == "__main__":
    leave(main())
