# SPDX-License-Identifier: GPL-3.0-or-later
"""Functions that Blender calls when something happens (`bpy.app.handlers`)."""

from collections.abc import Callable, Sequence

import bpy

Handlers = Sequence[tuple[str, Callable]]
"""names of Blender's lists, each with a function of ours"""


def install(handlers: Handlers) -> None:
    """Let Blender call the functions."""
    for name, handler in handlers:
        getattr(bpy.app.handlers, name).append(handler)


def remove(handlers: Handlers) -> None:
    """Let it call them no longer; others may have removed some already."""
    for name, handler in handlers:
        installed = getattr(bpy.app.handlers, name)
        if handler in installed:
            installed.remove(handler)
