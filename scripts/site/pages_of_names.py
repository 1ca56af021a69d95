# SPDX-License-Identifier: GPL-3.0-or-later
"""A hook of MkDocs: each name of the solver reference has a page of its own.

The page ``docs/api.md`` has them in sections. On the site it is their list, each with the first
sentence of its docstring. The docstrings lie in ``solver/``, which the wheel calls ``cubic_craft``:
their examples import what readers have installed.
"""

import ast
import re
from functools import cache
from pathlib import Path

from mkdocs.structure.files import File  # pyright: ignore[reportMissingImports]
from search_order import FOLDER

ROOT = Path(__file__).resolve().parents[2]
LIST = "api.md"
_NAME = re.compile(r"^::: ([\w.]+)\.(\w+)\n(?! )", re.MULTILINE)  # constants have options below
_IMPORT = re.compile(
    r'(<span class="kn">from</span>\s*(?:<span class="w"> </span>)?<span class="nn">)solver\b'
)
_renamed = []


def on_config(config):
    """Put the pages below their list."""
    config.nav = _with_pages(config.nav)
    return config


def on_files(files, config):
    """Add the pages."""
    for page, names in _pages().items():
        texts = [
            f"::: {module}.{name}\n    options:\n      heading_level: 1\n" for module, name in names
        ]
        files.append(File.generated(config, page, content="\n".join(texts)))
    return files


def on_page_markdown(markdown, page, **_):
    """Let the list lead to the pages."""
    if page.file.src_uri != LIST:
        return markdown
    return _NAME.sub(
        lambda found: f"- [`{found[2]}`]({_page(found[2])}): {_summary(*found.groups())}", markdown
    )


def on_page_content(html, page, **_):
    """Give the package the name of the wheel."""
    if not page.file.src_uri.startswith(FOLDER):
        return html
    html, count = _IMPORT.subn(r"\1cubic_craft", html)
    _renamed.extend([page.file.src_uri] * bool(count))
    return html


def on_post_build(**_):
    """See that there were any."""
    if not _renamed:
        raise ValueError(
            f"no example of {FOLDER} imports the solver; has the highlighting changed?"
        )


@cache
def _pages():
    """Return the names of each page, as pairs of module and name."""
    pages = {}
    for module, name in _NAME.findall((ROOT / "docs" / LIST).read_text(encoding="utf-8")):
        pages.setdefault(_page(name), []).append((module, name))
    return pages


def _page(name):
    """Return the page of a name; `run` and `Run` would be one file on many disks, and share it."""
    return f"{FOLDER}{name.lower()}.md"


def _with_pages(nav):
    """Return a navigation, in which the pages stand below their list."""
    if isinstance(nav, list):
        return [_with_pages(entry) for entry in nav]
    if not isinstance(nav, dict):
        return nav
    ((title, below),) = nav.items()
    if below != LIST:
        return {title: _with_pages(below)}
    pages = [{", ".join(name for _, name in names): page} for page, names in _pages().items()]
    return {title: [LIST, *pages]}


def _summary(module, name):
    """Return the first sentence of a docstring, in one line."""
    text = ROOT.joinpath(*module.split(".")).with_suffix(".py").read_text(encoding="utf-8")
    for node in ast.parse(text).body:
        if isinstance(node, ast.ClassDef | ast.FunctionDef) and node.name == name:
            return " ".join((ast.get_docstring(node) or "").split("\n\n")[0].split())
    raise ValueError(f"{module} has no {name}, which docs/{LIST} names")
