# SPDX-License-Identifier: GPL-3.0-or-later
"""Build the extension with Blender's own tool: build_extension.py OUTPUT.zip."""

import subprocess
import sys
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[1]


def build(output):
    """Validate and build; exits with the tool's status where that is not 0."""
    output = Path(output).resolve()
    output.parent.mkdir(parents=True, exist_ok=True)
    addons = Path(bpy.utils.system_resource("SCRIPTS")) / "addons_core"
    tool = [sys.executable, addons / "bl_pkg" / "cli" / "blender_ext.py"]
    source = ["--source-dir", ROOT]
    for command in (
        ["validate", ROOT],
        ["build", *source, "--output-filepath", output],
        ["validate", output],
    ):
        status = subprocess.run([*tool, *command], check=False).returncode
        if status != 0:
            raise SystemExit(status)


if __name__ == "__main__":
    build(sys.argv[1])
