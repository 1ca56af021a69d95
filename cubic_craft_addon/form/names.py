# SPDX-License-Identifier: GPL-3.0-or-later
"""The further settings of the forms that an artist can choose."""

from ...solver.method import SETTINGS
from ...solver.styles.form_names import OF_OBJECT

_OF_FORMS = {name: each.of_forms for name, each in SETTINGS.items() if each.of_forms}
_OF_FORMS["form_object"] = OF_OBJECT
FORM_SETTINGS = tuple(_OF_FORMS)
"""further settings, of which each form has those of `form_settings`"""


def form_settings(form: str) -> list[str]:
    """Return the names of the further settings of a form."""
    return [name for name, forms in _OF_FORMS.items() if form in forms]
