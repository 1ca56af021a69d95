# SPDX-License-Identifier: GPL-3.0-or-later
"""A hook of MkDocs: the search shows pages for artists first, and references last."""

FOLDER = "api/"
"""of the site, with the pages of names"""
BOOSTS = {"For artists": 4.0, "Development": 0.5}
"""heading of the navigation: weight of its pages; others have 1"""
PAGES = {"index.md": 4.0, "api.md": 0.05, "changelog.md": 0.05}
"""page: its own weight; references have a title for every name"""
NAME = 0.2
"""weight of the page of a name of the solver"""


def on_page_markdown(markdown, page, **_):
    """Give the page the weight of the heading that it stands below, at any depth."""
    headings = [ancestor.title for ancestor in page.ancestors]
    own = NAME if page.file.src_uri.startswith(FOLDER) else PAGES.get(page.file.src_uri)
    boost = own or next((BOOSTS[heading] for heading in headings if heading in BOOSTS), 1.0)
    page.meta["search"] = {"boost": boost}
    return markdown
