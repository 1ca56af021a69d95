# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of both command lines for the settings of the method, made from what is declared.

A choice is given in lower case, a switch as on or off, and angles in degrees.
"""

import argparse
import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, NoReturn

from ..setting import Setting, declared
from ..styles.form_names import FORMS as EVERY_FORM
from ..styles.form_names import OF_OBJECT
from .output import InputError

FORMS = tuple(name.lower() for name, *_ in EVERY_FORM if name not in (*OF_OBJECT, "FACES"))
"""those that need no more than a number of sides or weights: the names of `styles.forms.named`"""


class OneLineParser(argparse.ArgumentParser):
    """An ArgumentParser with errors of one line, like all others, and an epilog of several."""

    def __init__(self, **about: Any) -> None:
        layout = argparse.RawDescriptionHelpFormatter
        super().__init__(**about, formatter_class=layout, allow_abbrev=False)

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


Adder = Callable[..., None]
"""takes the name of an option, and what `ArgumentParser.add_argument` does"""


def add_settings(add: Adder, *groups: type, **others: Mapping[str, Any]) -> None:
    """Add an option for each setting that has one.

    `groups`: classes of `solver.method`. `others`: by the name of a setting, what is otherwise in
    its option.
    """
    settings = declared(*groups)
    for name, option in names_of_options(*groups).items():
        how = {**_how(settings[name]), **others.get(name, {})}
        add(f"--{option.replace('_', '-')}", **how)


def names_of_options(*groups: type) -> dict[str, str]:
    """Return the attribute that each setting has among the options, by its name."""
    settings = declared(*groups).items()
    return {n: (x.option or n).replace("-", "_") for n, x in settings if x.help is not None}


def defaults(*groups: type) -> dict[str, tuple[Any, Any]]:
    """Return what options are by default, and with ``--paper``, if that says so."""
    settings, names = declared(*groups), names_of_options(*groups)
    return {
        option: (_word(settings[name].default), _word(settings[name].paper))
        for name, option in names.items()
        if settings[name].paper is not None
    }


def fill_in(options: argparse.Namespace, values: Mapping[str, tuple[Any, Any]]) -> None:
    """Set the options that were not given to their `defaults`."""
    for name, (default, paper) in values.items():
        if getattr(options, name) is None:
            setattr(options, name, paper if options.paper else default)


def as_in_paper(values: Mapping[str, tuple[Any, Any]]) -> str:
    """Return the help of ``--paper``, from `defaults`."""
    given = (
        f"{name.replace('_', '-')} {_told(paper)}"
        for name, (default, paper) in values.items()
        if paper != default
    )
    what = ", ".join(given)
    return f"as in the paper: {what}; each of them can be given beside it and counts then"


def settings_from(options: Mapping[str, Any], *groups: type) -> dict[str, Any]:
    """Return the values of settings by their names, from those of options."""
    settings, names = declared(*groups), names_of_options(*groups)
    return {name: _value(settings[name], options[option]) for name, option in names.items()}


def _how(setting: Setting) -> dict[str, Any]:
    """Return what `ArgumentParser.add_argument` takes."""
    default = setting.default
    how: dict[str, Any] = {"help": _help(setting), "metavar": setting.metavar}
    how["default"] = _word(default) if setting.paper is None else None
    if setting.choices:
        how["choices"] = [identifier.lower() for identifier, *_ in setting.choices]
    elif isinstance(default, bool):
        how["choices"] = ("on", "off")
    elif isinstance(default, tuple):
        how["nargs"] = len(default)
    limits = (-36000, 36000) if setting.subtype == "EULER" else setting.limits
    if limits:
        how["type"] = number(*limits, int if isinstance(default, int) else float)
    return how


def _help(setting: Setting) -> str:
    """Return the help, with the default unless it says so itself, or that is nothing to tell."""
    text, word = (setting.help or "").replace("%", "%%"), _word(setting.default)
    is_told = "default" in text or word == "" or isinstance(word, list)
    return text if is_told else f"{text} (default: {_told(word)})".strip()


def _told(word: Any) -> str:
    return f"{word:g}" if isinstance(word, int | float) else word or "off"


def _word(value: Any) -> Any:
    """Return the value of an option for that of a setting."""
    if isinstance(value, bool):
        return "on" if value else "off"
    if isinstance(value, tuple):
        return list(value)
    return value.lower() if isinstance(value, str) else value


def _value(setting: Setting, word: Any) -> Any:
    """Return the value of a setting for that of its option."""
    if isinstance(setting.default, bool):
        return word == "on"
    if isinstance(setting.default, tuple):
        return tuple(map(math.radians, word) if setting.subtype == "EULER" else word)
    return word.upper() if setting.choices else word
