# SPDX-License-Identifier: GPL-3.0-or-later
"""A hook of MkDocs: README.md and CHANGELOG.md, which lie in the root, are pages of the site.

Links between them and the pages of ``docs/`` are written as they lead on disk, and turned into
those of the site here.
"""

import re
from pathlib import Path

from mkdocs.structure.files import File  # pyright: ignore[reportMissingImports]

ROOT = Path(__file__).resolve().parents[2]
PAGES = {"README.md": "index.md", "CHANGELOG.md": "changelog.md"}
"""file in the root: page of the site"""
FILES = ("LICENSE",)
"""files in the root that are linked as they are"""


def on_files(files, config):
    """Add the pages."""
    for name, page in PAGES.items():
        text = (ROOT / name).read_text(encoding="utf-8")
        files.append(File.generated(config, page, content=_from_root(text)))
    for name in FILES:
        files.append(File.generated(config, name, abs_src_path=str(ROOT / name)))
    return files


def on_page_markdown(markdown, page, **_):
    """Let links to the root lead to the pages."""
    if page.file.src_uri in PAGES.values():
        return markdown
    up = "../" * page.file.src_uri.count("/")  # from there to docs/
    for name, target in PAGES.items():
        link = rf"\]\({re.escape(up)}\.\./{re.escape(name)}(?=[)#])"
        markdown = re.sub(link, f"]({up}{target}", markdown)
    return markdown


def _from_root(text):
    """Return a text of the root with its links as they lead from ``docs/``."""
    for name, target in PAGES.items():
        text = re.sub(rf"\]\({re.escape(name)}(?=[)#])", f"]({target}", text)
    return text.replace("](docs/", "](")
