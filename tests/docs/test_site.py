# SPDX-License-Identifier: GPL-3.0-or-later
"""The hooks of the site that need no MkDocs."""

import struct
import sys
from types import SimpleNamespace

import pytest
from documents import ROOT

sys.path.insert(0, str(ROOT / "scripts" / "site"))

from lazy_pictures import with_lazy_pictures
from search_order import on_page_markdown
from self_contained import loaded_from_the_web


def test_all_pictures_but_the_first_are_loaded_when_they_are_seen(tmp_path):
    (tmp_path / "a.gif").write_bytes(b"GIF89a" + struct.pack("<HH", 800, 617) + bytes(20))
    header = b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sII", 13, b"IHDR", 1200, 405)
    (tmp_path / "b.png").write_bytes(header)
    html = '<p><img alt="a" src="a.gif" /></p><img alt="b" src="b.png"><img src="https://x/y.png">'
    first, second, foreign = with_lazy_pictures(html, tmp_path).split("<img")[1:]
    assert first.startswith(' alt="a" src="a.gif" width="800" height="617">')
    assert second.startswith(' alt="b" src="b.png" width="1200" height="405" loading="lazy">')
    assert foreign == ' src="https://x/y.png">'


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
