# SPDX-License-Identifier: GPL-3.0-or-later
"""The hooks of the site that need no MkDocs."""

import sys
from types import SimpleNamespace

import pytest
from documents import ROOT

sys.path.insert(0, str(ROOT / "scripts" / "site"))

from search_order import on_page_markdown
from self_contained import loaded_from_the_web


@pytest.mark.parametrize(
    ("html", "loaded"),
    [
        ('<script src="https://x.org/a.js"></script>', ["https://x.org/a.js"]),
        ('<link rel="stylesheet" href="https://x.org/a.css">', ["https://x.org/a.css"]),
        ('<a href="https://x.org">x</a> <script src="assets/a.js"></script>', []),
    ],
)
def test_what_is_loaded_from_the_web(html, loaded):
    assert loaded_from_the_web(html) == loaded


def test_the_search_shows_the_guide_before_the_reference():
    def boost(name, *headings):
        page = SimpleNamespace(
            file=SimpleNamespace(src_uri=name),
            ancestors=[SimpleNamespace(title=heading) for heading in headings],
            meta={},
        )
        on_page_markdown("", page)
        return page.meta["search"]["boost"]

    guide = boost("guide/live.md", "User guide", "For artists")
    assert guide == boost("index.md") > boost("scripting.md", "For scripting")
    assert boost("scripting.md", "For scripting") > boost("api.md", "For scripting")
