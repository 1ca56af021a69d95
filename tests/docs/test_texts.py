# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages and what the program says: links, messages, names of settings, spelling and versions."""

import ast
import re
import tomllib
from functools import cache
from pathlib import Path

import pytest
from documents import GUIDE, NAVIGATION, PAGES, ROOT, anchors, links

import solver
from library.command_line.arguments import _parser, parse
from solver.method import SETTINGS, Advanced, Kept
from solver.setting import declared


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_lead_somewhere(page):
    for link in links(page):
        if link.startswith("https://"):
            continue
        path, _, anchor = link.partition("#")
        target = (page.parent / path).resolve() if path else page
        assert target.is_relative_to(ROOT), f"{link} leads out of the repository"
        assert target.is_file(), f"{link}: there is no such file"
        if anchor:
            assert anchor in anchors(target), f"{link}: there is no such heading"


def test_every_public_name_is_in_the_reference():
    text = (ROOT / "docs" / "api.md").read_text(encoding="utf-8")
    shown = set(re.findall(r"^::: \S+\.(\w+)$", text, re.MULTILINE))
    shown |= set(re.findall(r"\w+", " ".join(re.findall(r"members: \[(.*)\]", text))))
    assert [name for name in solver.__all__ if name not in shown] == []


def test_every_page_is_in_the_navigation():
    for page in (ROOT / "docs").rglob("*.md"):
        name = page.relative_to(ROOT / "docs").as_posix()
        assert f": {name}\n" in NAVIGATION, f"{name} is not in mkdocs.yml"


_SHORTEST = 4  # characters of a part between two "..."


@cache
def texts():
    """Return all texts of the sources; those of f-strings in their parts."""
    files = [
        path
        for room in ("solver", "cubic_craft_addon", "operators")
        for path in (ROOT / room).rglob("*.py")
    ]
    nodes = [node for path in files for node in ast.walk(ast.parse(path.read_text("utf-8")))]
    return [
        node.value for node in nodes if isinstance(node, ast.Constant) and type(node.value) is str
    ]


def test_messages_are_those_of_the_program():
    page = (GUIDE / "troubleshooting.md").read_text(encoding="utf-8")
    messages = re.findall(r"^\| \*(.+?)\* \|", page, re.MULTILINE)
    assert len(messages) > 10
    for message in messages:
        for part in re.split(r"\.\.\.|\(\.\.\.\)", message):
            if len(part.strip()) >= _SHORTEST:
                assert any(part.strip() in text for text in texts()), f"{message}: no {part!r}"


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


BRITISH = re.compile(
    r"\b\w*(?:colour|behaviour|neighbour|favour|centre[sd]?\b|licence|grey|artefact"
    r"|(?:factor|minim|maxim|optim|normal|recogn|initial|organ|styl|summar|visual|real)is(?:e|ing|ation))\w*",
    re.IGNORECASE,
)
NOT_PROSE = re.compile(r"```.*?```|`[^`]*`|\]\([^)]*\)|<[^>]*>|https?:\S*", re.DOTALL)
ROOMS = ("cubic_craft_addon", "operators", "solver", "library")


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_a_page(page):
    assert BRITISH.findall(NOT_PROSE.sub("", page.read_text())) == []


@pytest.mark.parametrize("room", ROOMS)
def test_what_the_program_says(room):
    found = [
        f"{path.relative_to(ROOT)}: {text}"
        for path in sorted((ROOT / room).rglob("*.py"))
        for text in _texts(path)
        if BRITISH.search(text)
    ]
    assert found == []


def _texts(path: Path):
    """Return the sentences in a file, without those that stand alone, such as docstrings."""
    tree = ast.parse(path.read_text())
    alone = {node.value for node in ast.walk(tree) if isinstance(node, ast.Expr)}
    return [
        node.value
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and type(node.value) is str
        if " " in node.value and node not in alone
    ]


CHANGELOG = ROOT / "CHANGELOG.md"


def test_the_changelog_knows_the_version():
    manifest = tomllib.loads((ROOT / "blender_manifest.toml").read_text(encoding="utf-8"))
    version = manifest["version"]
    text = CHANGELOG.read_text(encoding="utf-8")
    if re.search(rf"^## \[{re.escape(version)}\] - \d{{4}}-\d\d-\d\d$", text, re.MULTILINE):
        return
    unreleased = text.split("\n## [Unreleased]\n")[1].split("\n## ")[0]
    assert f"This will be {version}" in unreleased
    for page in set(PAGES) - {CHANGELOG}:
        words = page.read_text(encoding="utf-8")
        assert not re.search(rf"\b{re.escape(version)}\b", words), f"{page.name} has {version}"
