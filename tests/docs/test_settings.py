# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables of the documentation say of each setting what is declared."""

import re

from documents import ROOT

from library.command_line.arguments import _parser, parse
from solver.method import SETTINGS, Advanced, Kept
from solver.setting import declared

KINDS = {bool: "on or off", int: "integer", float: "number", str: "text"}
HEAD = "| property | type | default | range |"
OF_VECTORS = {"EULER": "three angles in radians", "XYZ": "three "}


def rows(page, head):
    """Return the cells of the first table with these titles."""
    text = (ROOT / "docs" / page).read_text(encoding="utf-8")
    lines = text.split(f"{head}\n")[1].split("\n\n")[0].splitlines()[1:]
    return [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in lines]


def told(value):
    if isinstance(value, tuple | list):
        return ", ".join(map(told, value)) if any(value) or value[0] is not False else "off"
    if isinstance(value, bool):
        return "on" if value else "off"
    if isinstance(value, str):
        return f"`{value}`" if value else "none"
    return f"{value:g}" if value < 1e5 else f"{value:,}"


def type_of(name, setting):
    if setting.choices:
        return ", ".join(f"`{identifier}`" for identifier, *_ in setting.choices)
    if name.endswith("_group"):
        return "name of a vertex group"
    if isinstance(setting.default, tuple):
        return OF_VECTORS[setting.subtype]
    return KINDS[type(setting.default)]


def test_scripts_are_told_all_settings_of_the_method_in_the_order_of_the_panel():
    found = {row[0].strip("`"): row[1:] for row in rows("scripting.md", HEAD)}
    assert [name for name in found if name in SETTINGS] == [*SETTINGS]
    for name, setting in SETTINGS.items():
        kind, default, limits = found[name]
        assert kind.startswith(type_of(name, setting)), name
        assert default == told(setting.default), name
        if setting.limits:
            assert limits == " to ".join(map(told, setting.limits)), name


def test_the_command_of_the_library_is_told_with_its_defaults():
    found = {cells[0]: cells[1:] for cells in rows("library.md", "| option | default | |")}
    by_default = vars(parse(["a.obj", "b.obj"]))
    kept = {f"--{name.replace('_', '-')}" for name in declared(Kept, Advanced)}
    options = [a for a in _parser()._actions if a.option_strings and a.nargs != 0]
    for action in options:
        (option,), choices, names = action.option_strings, action.choices or (), action.metavar
        words = names if isinstance(names, tuple) else [names or r"\|".join(choices)]
        is_named = len(choices) > 3 or not choices
        title = f"`{option} {'NAME' if choices and is_named else ' '.join(words)}`"
        default, what = found.pop(title)
        value = by_default[action.dest]
        assert default == ("" if value is None else told(value).replace(",", "")), option
        if option in kept:
            assert what == action.help.partition(" (default")[0], option
    assert found.keys() == {"`--paper`", "`--quiet`"}
