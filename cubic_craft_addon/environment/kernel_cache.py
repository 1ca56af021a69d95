# SPDX-License-Identifier: GPL-3.0-or-later
"""Compiled kernels live in the extension's own user folder, not in that of all programs."""

from functools import cache

import bpy

from ... import solver

ROOT_PACKAGE = __name__.partition(".cubic_craft_addon.")[0]


@cache
def use_extension_folder() -> None:
    """Make the engine cache its kernels in the folder that Blender gives the extension."""
    try:
        folder = bpy.utils.extension_path_user(ROOT_PACKAGE, path="kernels", create=True)
    except (ValueError, OSError):
        # Not installed as an extension, or the folder cannot be created: use the usual one.
        return
    solver.set_cache_folder(folder)
