# SPDX-License-Identifier: GPL-3.0-or-later
"""Options and their ranges."""

import argparse
from collections.abc import Callable
from pathlib import Path
from typing import NoReturn

from ..styles.form_names import FORMS as EVERY_FORM
from ..styles.form_names import OF_OBJECT
from .errors import InputError

FORMS = tuple(name.lower() for name, *_ in EVERY_FORM if name not in (*OF_OBJECT, "FACES"))
"""those that need no more than a number of sides or weights: the names of `styles.forms.named`"""


class OneLineParser(argparse.ArgumentParser):
    """An ArgumentParser whose errors are one line, like all others."""

    def error(self, message: str) -> NoReturn:
        """Raise InputError."""
        raise InputError(message.removeprefix("argument "))


def number(low: float, high: float, kind: type = float) -> Callable[[str], float]:
    """Return the type of an option with a number.

    `low`, `high`: the least and the largest. `kind`: float or int.
    """

    def checked(text: str) -> float:
        try:
            value = kind(text)
        except ValueError:
            what = "a number" if kind is float else "a whole number"
            # An option with any count of numbers takes a file behind them for one.
            is_file = Path(text).suffix[1:].isalpha()
            hint = " (put the input file first)" if is_file else ""
            raise argparse.ArgumentTypeError(f"{text!r} is not {what}{hint}") from None
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"{text} is not between {low} and {high}")
        return value

    return checked
