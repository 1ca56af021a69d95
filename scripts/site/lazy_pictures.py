# SPDX-License-Identifier: GPL-3.0-or-later
"""A hook of MkDocs: all pictures of a page but the first are loaded when they come into sight.

Their size is written beside them, so that the text stays in place when they arrive.
"""

import re
import struct
from pathlib import Path

_PICTURE = re.compile(r'<img(?P<rest>[^>]*? src="(?P<address>[^":]+\.(?:png|gif))"[^>]*?) ?/?>')


def on_page_content(html, page, config, **_):
    """Add to the pictures how they are loaded, and how large they are."""
    folder = Path(config.docs_dir, page.file.dest_uri).parent
    return with_lazy_pictures(html, folder)


def with_lazy_pictures(html, folder):
    """Return a page of HTML; what its pictures are given by is seen from a folder of files."""
    is_first = True

    def replaced(match):
        nonlocal is_first
        width, height = size(folder / match["address"])
        loading = "" if is_first else ' loading="lazy"'
        is_first = False
        return f'<img{match["rest"]} width="{width}" height="{height}"{loading}>'

    return _PICTURE.sub(replaced, html)


def size(path):
    """Return the width and the height of a PNG or GIF file in pixels."""
    with path.open("rb") as file:
        head = file.read(24)
    if path.suffix == ".gif":
        return struct.unpack("<HH", head[6:10])
    return struct.unpack(">II", head[16:24])
