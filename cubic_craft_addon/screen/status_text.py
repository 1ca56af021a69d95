# SPDX-License-Identifier: GPL-3.0-or-later
"""Text in Blender's status bar, instead of its own, while one of our operators runs."""

from collections.abc import Callable
from typing import Any

import bpy

_is_shown = False


def show(draw: Callable[[Any, bpy.types.Context], None]) -> None:
    """Draw with this function until `hide`; once more if it is called again."""
    global _is_shown
    # A function, as opposed to a text, is shown in all workspaces: any of them will do.
    bpy.data.workspaces[0].status_text_set(draw)
    _is_shown = True


def hide() -> None:
    """Restore the status bar."""
    global _is_shown
    if _is_shown:
        _is_shown = False
        bpy.data.workspaces[0].status_text_set(None)
