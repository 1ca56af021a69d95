# SPDX-License-Identifier: GPL-3.0-or-later
"""The further settings of the forms that an artist can choose."""

from ...solver.styles.form_names import OF_OBJECT, WITH_SIDES

FORM_SETTINGS = ("form_sides", "form_weights", "form_object", "form_directions")
"""further settings, of which each form has those of `form_settings`"""


def form_settings(form: str) -> list[str]:
    """Return the names of the further settings of a form."""
    names = []
    if form in WITH_SIDES:
        names.append("form_sides")
    if form == "BOX":
        names.append("form_weights")
    if form in OF_OBJECT:
        names.append("form_object")
    if form == "FACES":
        names.append("form_directions")
    return names
