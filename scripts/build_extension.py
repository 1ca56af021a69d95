# SPDX-License-Identifier: GPL-3.0-or-later
"""Build the extension with Blender's own tool: build_extension.py OUTPUT.zip."""

import subprocess
import sys
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[1]


def build(output, source=ROOT):
    """Validate and build; exits with the tool's status where that is not 0."""
    output = Path(output).resolve()
    output.parent.mkdir(parents=True, exist_ok=True)
    blender_tool("validate", source)
    blender_tool("build", "--source-dir", source, "--output-filepath", output)
    blender_tool("validate", output)


def blender_tool(*arguments):
    """Run a command of Blender's tool for extensions; exits with its status where not 0."""
    addons = Path(bpy.utils.system_resource("SCRIPTS")) / "addons_core"
    tool = [sys.executable, addons / "bl_pkg" / "cli" / "blender_ext.py"]
    status = subprocess.run([*tool, *arguments], check=False).returncode
    if status != 0:
        raise SystemExit(status)


if __name__ == "__main__":
    build(sys.argv[1])
