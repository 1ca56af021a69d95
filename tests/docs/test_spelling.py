# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages and what the program says have one spelling: American, as Blender's own texts have."""

import ast
import re
from pathlib import Path

import pytest
from documents import PAGES, ROOT

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
