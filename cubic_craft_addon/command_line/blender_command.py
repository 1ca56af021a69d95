# SPDX-License-Identifier: GPL-3.0-or-later
"""The command that Blender knows while the extension is enabled: ``blender -c cubic_craft``."""

from typing import Any

import bpy

NAME = "cubic_craft"
_handle: Any = None


def register():
    """Offer the command."""
    global _handle
    _handle = bpy.utils.register_cli_command(NAME, _execute)


def unregister():
    """Withdraw the command."""
    bpy.utils.unregister_cli_command(_handle)


def _execute(arguments: list[str]) -> int:
    from .main import main_of  # late: hardly a start of Blender needs it

    try:
        return main_of(arguments, NAME, f"blender -c {NAME}")
    except SystemExit as end:  # after --help; Blender would take it for an error
        return int(end.code or 0)
