# SPDX-License-Identifier: GPL-3.0-or-later
"""The command ``cubic-craft`` of the wheel: a mesh file in, its cubic version out, no Blender."""

from .program import main

__all__ = ["main"]
