# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets: looks that are included with the extension, and those that the artist has saved.

``files`` reads and writes them, ``pictures`` are their thumbnails, ``selector`` is the property
that the panel shows, and ``panel`` draws it.
"""

from pathlib import Path

import bpy

from . import pictures
from .files import INCLUDED_FOLDER
from .selector import forget

_ASSETS = str(Path(INCLUDED_FOLDER).parents[1])


def register():
    """Register the folder of our presets."""
    bpy.utils.register_preset_path(_ASSETS)


def unregister():
    """Unregister it, and free the pictures."""
    bpy.utils.unregister_preset_path(_ASSETS)
    forget()
    pictures.free()
