# SPDX-License-Identifier: GPL-3.0-or-later
"""The map of the tree in `docs/development.md` is true: each room is there, and arrows go one way.

The rooms of the map stand in an order in which each imports only those above it. What a feature
draws lies in its room, but is a part of the interface.
"""

import ast
import re
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[2]
PACKAGES = ("solver", "cubic_craft_addon", "operators")
DRAWN = ("panel.py", "overlay.py")
INTERFACE = "cubic_craft_addon/ui"
FILES = [
    path
    for name in PACKAGES
    for path in (ROOT / name).rglob("*.py")
    if "assets" not in path.parts  # presets, which are no modules
]


@cache
def rooms():
    """Return the rooms of the extension in the order of the map, such as ``solver/styles``.

    Those that are named inside the row of another stand before it.
    """
    text = (ROOT / "docs" / "development.md").read_text(encoding="utf-8")
    listed = []
    for room, row in re.findall(r"^\| `([a-z_/]+)/` \|(.*)", text, re.MULTILINE):
        if room.partition("/")[0] in PACKAGES:
            listed += [f"{room}/{inner}" for inner in re.findall(r"`([a-z_]+)/`", row)]
            listed.append(room)
    return listed


def room_of(path):
    """Return the innermost room that a file or folder lies in, None for what registers all."""
    file = path.with_suffix(".py")
    if file.name in DRAWN and file.exists():
        return INTERFACE
    name = path.relative_to(ROOT).as_posix()
    found = [room for room in rooms() if name == room or name.startswith(f"{room}/")]
    return max(found, key=len, default=None)


def imported(path):
    """Give the files and folders of ours that a file imports."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if not isinstance(node, ast.ImportFrom) or not node.level:
            continue
        base = path.parents[node.level - 1].joinpath(*(node.module or "").split("."))
        for alias in node.names:
            inner = base / alias.name
            yield inner if inner.is_dir() or inner.with_suffix(".py").exists() else base


def test_every_folder_is_on_the_map():
    folders = {path.parent.relative_to(ROOT).as_posix() for path in FILES} - {"cubic_craft_addon"}
    assert folders == set(rooms())


def test_arrows_go_up_the_map():
    order = {room: number for number, room in enumerate(rooms())}
    wrong = []
    for path in FILES:
        own = room_of(path)
        for other in imported(path) if own else ():  # the package itself registers all
            room = room_of(other)
            is_inside = own.startswith("solver") and room and room.startswith("solver")
            if room and not is_inside and order[room] > order[own]:  # to others the solver is one
                wrong.append(f"{own} imports {room} in {path.name}")
    assert not wrong
