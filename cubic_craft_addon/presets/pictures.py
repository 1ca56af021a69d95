# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures of presets, as icons of Blender's interface."""

from typing import Any

import bpy.utils.previews

from .files import INCLUDED_FOLDER, Preset

_WITHOUT = INCLUDED_FOLDER.parents[1] / "preset_without_picture.png"

_collection: Any = None


def icon_of(preset: Preset | None) -> int:
    """Return the icon number of a preset; None and presets without a picture share one."""
    global _collection
    if _collection is None:
        _collection = bpy.utils.previews.new()
    path = _WITHOUT if preset is None or not preset.picture.exists() else preset.picture
    key = str(path)
    if key not in _collection:
        _collection.load(key, key, "IMAGE")
    return _collection[key].icon_id


def free() -> None:
    """Release all pictures."""
    global _collection
    if _collection is not None:
        bpy.utils.previews.remove(_collection)
        _collection = None
