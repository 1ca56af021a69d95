# SPDX-License-Identifier: GPL-3.0-or-later
"""A hook of MkDocs: examples of the solver reference import what its readers have installed.

The docstrings it is made of lie in ``solver/``, which the wheel calls ``cubic_craft``.
"""

import re

PAGE = "api.md"
_NAME = re.compile(
    r'(<span class="kn">from</span>\s*(?:<span class="w"> </span>)?<span class="nn">)solver\b'
)


def on_page_content(html, page, **_):
    """Give the package the name of the wheel."""
    if page.file.src_uri != PAGE:
        return html
    html, count = _NAME.subn(r"\1cubic_craft", html)
    if not count:
        raise ValueError(f"no example of {PAGE} imports the solver; has the highlighting changed?")
    return html
