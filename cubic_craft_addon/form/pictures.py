# SPDX-License-Identifier: GPL-3.0-or-later
"""The items of the property `form`, with a picture of each.

Blender reads the items when a class that has the property is registered, so that they are filled
in before. Computed at each redraw instead, they could have no default by name, and drivers and
scripts could not ask for them without a window. The pictures outlive the classes.
"""

from pathlib import Path
from typing import Any

import bpy.utils.previews

from ...solver.styles.form_names import FORMS

_FOLDER = Path(__file__).parents[1] / "assets" / "forms"

items: Any = [(*form, 0, number) for number, form in enumerate(FORMS)]
"""identifier, name, description, icon and number; the list stays the same one"""

_collection: Any = None


def path_of(form: str) -> Path:
    """Return the picture of a form."""
    return _FOLDER / f"{form}.png"


def register():
    """Load the pictures and give the items their icons; without a window all are 0."""
    global _collection
    _collection = bpy.utils.previews.new()
    for number, (form, name, about) in enumerate(FORMS):
        path = str(path_of(form))
        items[number] = form, name, about, _collection.load(form, path, "IMAGE").icon_id, number


def unregister():
    """Release the pictures; no class that shows them is left."""
    global _collection
    bpy.utils.previews.remove(_collection)
    _collection = None
