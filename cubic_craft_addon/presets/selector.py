# SPDX-License-Identifier: GPL-3.0-or-later
"""The property that shows the current preset and applies a preset when it is set.

It stores nothing: settings that match no preset are "Custom".
"""

from typing import Any

import bpy.utils.previews
from bpy.props import EnumProperty

from ..screen import glimpse
from .files import PICTURES, Preset, find, presets

_WITHOUT = PICTURES.with_name("preset_without_picture.png")

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


CUSTOM, CUSTOM_NAME = "CUSTOM", "Custom"

_texts: dict[str, str] = {}  # all displayed items: Blender does not keep them alive
_last_applied = ""


def preset_property() -> Any:
    """Return the declaration of the property, for a group that has the settings."""
    return EnumProperty(
        name="Preset",
        description="Look of the result: how cubic and crisp, which details remain, and what stays"
        " together",
        items=_items_of,
        get=_get,
        set=_set,
        options={"SKIP_SAVE"},
    )


def preset_of(properties: Any) -> Preset | None:
    """Return the preset that the settings match, or None.

    If several match, it is the one that was chosen last.
    """
    fitting = [preset for preset in presets() if preset.is_of(properties)]
    chosen = [preset for preset in fitting if preset.identifier == _last_applied]
    return next(iter(chosen + fitting), None)


@glimpse.quiet()
def apply(identifier: str, properties: Any) -> Preset:
    """Apply the settings of a preset, given by its identifier or its name.

    Raises CubicCraftError: there is no such preset.
    """
    global _last_applied
    preset = find(identifier)
    for name, value in preset.values.items():
        setattr(properties, name, value)
    _last_applied = preset.identifier
    return preset


def forget() -> None:
    """Release the displayed items and all pictures."""
    global _last_applied, _collection
    _last_applied = ""
    _texts.clear()
    if _collection is not None:
        bpy.utils.previews.remove(_collection)
        _collection = None


def _items_of(properties, _context) -> Any:
    shown = [
        _item(preset.identifier, preset.name, preset.description, icon_of(preset), number)
        for number, preset in enumerate(presets())
    ]
    if properties is None or preset_of(properties) is None:
        about = "Settings that match no preset"
        shown.append(_item(CUSTOM, CUSTOM_NAME, about, icon_of(None), len(shown)))
    return shown


def _item(identifier, name, about, icon, number) -> tuple[str, str, str, int, int]:
    return _kept(identifier), _kept(name), _kept(about), icon, number


def _kept(text):
    return _texts.setdefault(text, text)


def _get(properties):
    preset = preset_of(properties)
    return len(presets()) if preset is None else presets().index(preset)


def _set(properties, number):
    if number < len(presets()):
        apply(presets()[number].identifier, properties)
