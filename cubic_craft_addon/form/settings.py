# SPDX-License-Identifier: GPL-3.0-or-later
"""The settings of the form as plain values, and what is wrong with them."""

from dataclasses import dataclass
from typing import Any

import bpy
from bpy.props import PointerProperty

from ...solver.errors import CubicCraftError
from ...solver.method import SETTINGS, Method
from ...solver.styles.form_names import OF_OBJECT
from ..environment.declared import declared
from .pictures import items as form_items


@dataclass(frozen=True, kw_only=True)
class FormSettings(Method):
    """The settings with the objects that the surface of a mesh, or of a region, is turned toward.

    The defaults are those of the panel.
    """

    form_object: bpy.types.Object | None = None
    """the object that an OBJECT or DIRECTIONS form is made from"""


def check_form_object(
    form: str, form_object: bpy.types.Object | None, whose: str = "the form"
) -> None:
    """Refuse a form that is to be made from another object if none is set.

    Raises CubicCraftError: none is set.
    """
    if form in OF_OBJECT and form_object is None:
        raise CubicCraftError(f"no object is set for {whose}; pick one or choose another form")


def check_directions(form: str, form_directions: str) -> None:
    """Refuse a form of faces if none were picked.

    Raises CubicCraftError: none were picked.
    """
    if form == "FACES" and not form_directions.strip():
        raise CubicCraftError(
            "no faces were picked for the form; select some in Edit Mode and click Use"
            " Selection, or choose another form"
        )


_OF_FORMS = {name: each.of_forms for name, each in SETTINGS.items() if each.of_forms}
_OF_FORMS["form_object"] = OF_OBJECT
FORM_SETTINGS = tuple(_OF_FORMS)
"""further settings, of which each form has those of `form_settings`"""


def form_settings(form: str) -> list[str]:
    """Return the names of the further settings of a form."""
    return [name for name, forms in _OF_FORMS.items() if form in forms]


def form_property(name: str, **others: Any) -> Any:
    """Return the declaration of a setting, of an object or of a region; `others` as `declared`."""
    if name == "form_object":
        return PointerProperty(
            name="Form Object",
            description="Object that the form is made from, about its origin",
            type=bpy.types.Object,
        )
    if name == "form":
        others = {"items": form_items, **others}
    return declared(SETTINGS[name], **others)
