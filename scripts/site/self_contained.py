# SPDX-License-Identifier: GPL-3.0-or-later
"""A hook of MkDocs: the build fails where a page would load something from the web.

The site is promised to work from a folder on the disk, without a network.
"""

import re
from pathlib import Path

_LOADED = re.compile(
    r'<(?:script|img|iframe|source)\b[^>]*\bsrc="(https?:[^"]+)"'
    r'|<link\b[^>]*\brel="(?:stylesheet|preload|preconnect)"[^>]*\bhref="(https?:[^"]+)"'
)


def on_post_build(config, **_):
    """Look at all pages."""
    for path in sorted(Path(config.site_dir).rglob("*.html")):
        if found := loaded_from_the_web(path.read_text(encoding="utf-8")):
            raise SystemExit(f"{path.name} loads from the web: {', '.join(found)}")


def loaded_from_the_web(html):
    """Return the addresses in the web that a page of HTML loads, not those that it links to."""
    return [script or sheet for script, sheet in _LOADED.findall(html)]
