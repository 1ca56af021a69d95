# SPDX-License-Identifier: GPL-3.0-or-later
"""The messages that the user guide explains are those of the program."""

import ast
import re
from functools import cache

from documents import GUIDE, ROOT

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
