# SPDX-License-Identifier: GPL-3.0-or-later
"""A hook of MkDocs: examples of the solver reference import what its readers have installed.

The docstrings it is made of lie in ``solver/``, which the wheel calls ``cubic_craft``.
"""

import re

FOLDER = "api/"
"""of the site, with the pages that `pages_of_names` makes"""
_NAME = re.compile(
    r'(<span class="kn">from</span>\s*(?:<span class="w"> </span>)?<span class="nn">)solver\b'
)
_renamed = []


def on_page_content(html, page, **_):
    """Give the package the name of the wheel."""
    if not page.file.src_uri.startswith(FOLDER):
        return html
    html, count = _NAME.subn(r"\1cubic_craft", html)
    _renamed.extend([page.file.src_uri] * bool(count))
    return html


def on_post_build(**_):
    """See that there were any."""
    if not _renamed:
        raise ValueError(
            f"no example of {FOLDER} imports the solver; has the highlighting changed?"
        )
