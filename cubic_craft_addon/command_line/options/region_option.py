# SPDX-License-Identifier: GPL-3.0-or-later
"""A region as it is given on the command line: GROUP:FORM:CUBENESS."""

import argparse
import re
from typing import NamedTuple

from ....solver.console.method_options import FORMS
from ....solver.method import SETTINGS, Method
from ....solver.styles.form_names import WITH_SIDES

_FORMS = [name for name in FORMS if name != "box"]
"""those that need no further settings than a number of sides"""


class GivenRegion(NamedTuple):
    """A vertex group with a form and a cubeness of its own."""

    group: str
    form: str
    sides: int
    cubeness: float


def region_of(text: str) -> GivenRegion:
    """Read a region, such as "head:octahedron:0.8", or "hat:prism5:1" with a number of sides.

    Raises ValueError: it is none.
    """
    group, form, cubeness = text.rsplit(":", 2)
    found = re.fullmatch(r"([a-z]+?)(\d*)", form.lower())
    if not group or not found:
        raise ValueError
    name, sides, value = found[1], int(found[2] or Method.form_sides), float(cubeness)
    if found[2] and name.upper() not in WITH_SIDES:
        raise ValueError
    for setting, given in (("form_sides", sides), ("cubeness", value)):
        low, high = SETTINGS[setting].limits or (given, given)
        if not low <= given <= high:
            raise ValueError
    return GivenRegion(group, name, sides, value)


def region_option(text: str) -> str:
    """Check a text that is given for a region, and leave it as it is for the report.

    Raises argparse.ArgumentTypeError: it is none.
    """
    try:
        region = region_of(text)
    except ValueError:
        raise argparse.ArgumentTypeError(
            f"{text!r} is not GROUP:FORM:CUBENESS, such as head:octahedron:0.8 or hat:prism5:1"
        ) from None
    if region.form not in _FORMS:
        names = ", ".join(_FORMS)
        raise argparse.ArgumentTypeError(f"{text!r}: {region.form!r} is none of {names}")
    return text
