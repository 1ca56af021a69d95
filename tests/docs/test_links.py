# SPDX-License-Identifier: GPL-3.0-or-later
"""Links of README.md, CHANGELOG.md and docs/ lead to files and headings that are there."""

import re

import pytest
from documents import NAVIGATION, PAGES, ROOT, anchors, links

import solver


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
