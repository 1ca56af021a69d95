# SPDX-License-Identifier: GPL-3.0-or-later
"""The pages of the documentation, taken apart as Markdown."""

import re
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path

from markdown_it import MarkdownIt

ROOT = Path(__file__).resolve().parents[2]
PAGES = [ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").rglob("*.md"))]
GUIDE = ROOT / "docs" / "guide"
NAVIGATION = (ROOT / "mkdocs.yml").read_text(encoding="utf-8").split("\nvalidation:")[0]


@dataclass
class Section:
    """What stands below a heading of the first or second level, up to the next of these."""

    title: str
    text: str = ""
    code: list[str] = field(default_factory=list)
    """inline"""
    fences: list[tuple[str, str, int]] = field(default_factory=list)
    """language, content, and the number of its first line, from 0"""
    images: list[str] = field(default_factory=list)

    @property
    def commands(self):
        """What can be typed: inline code, and the lines of shell blocks."""
        shell = [
            content.replace("\\\n", " ") for language, content, _ in self.fences if language == "sh"
        ]
        lines = [line.split(" #")[0] for content in shell for line in content.splitlines()]
        return self.code + [line for line in lines if line.strip()]


@cache
def sections(page):
    """Return the sections of a page; the first is its introduction."""
    found = [Section("")]
    tokens = _tokens(page)
    for number, token in enumerate(tokens):
        section = found[-1]
        if token.type == "heading_open" and token.tag in ("h1", "h2"):
            if token.tag == "h2":
                found.append(Section(tokens[number + 1].content))
        elif token.type == "fence":
            section.fences.append((token.info.strip(), token.content, token.map[0] + 1))
        elif token.type == "inline":
            section.text += token.content + "\n\n"
            section.code += [
                child.content for child in token.children if child.type == "code_inline"
            ]
            section.images += [
                child.attrs["src"] for child in token.children if child.type == "image"
            ]
    return found


def pages_for(readers):
    """Return the pages below a heading of the site's navigation, such as "For artists"."""
    block = NAVIGATION.split(f"  - {readers}:\n")[1].split("\n  - ")[0]
    return [ROOT / "docs" / name for name in re.findall(r": (\S+\.md)$", block, re.MULTILINE)]


@cache
def anchors(page):
    """Return the anchors of the headings of a page, as GitHub makes them."""
    tokens = _tokens(page)
    headings = [tokens[n + 1] for n, token in enumerate(tokens) if token.type == "heading_open"]
    texts = ["".join(child.content for child in heading.children) for heading in headings]
    return {re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-") for text in texts}


def links(page):
    """Return what the links and images of a page lead to."""
    children = [child for token in _tokens(page) for child in token.children or ()]
    targets = [
        child.attrs.get("href") or child.attrs.get("src") for child in children if child.attrs
    ]
    return [target for target in targets if target]


def examples(package):
    """Return the Python examples as (page, title of the section), by what they need.

    `package`: blender, the installed wheel, or the folder of the repository.
    """
    found = []
    for page in PAGES:
        for section in sections(page):
            code = "".join(
                content for language, content, _ in section.fences if language == "python"
            )
            if code and _needs(code) == package:
                found.append((page, section.title))
    return found


def _needs(code):
    if "import bpy" in code:
        return "bpy"
    return "cubic_craft" if "from cubic_craft" in code else "solver"


def run_example(page, title):
    """Run the Python blocks of a section, one after the other; return the names they leave."""
    section = next(section for section in sections(page) if section.title == title)
    lines = [""] * len(page.read_text(encoding="utf-8").splitlines())
    for language, content, start in section.fences:
        if language == "python":
            block = content.splitlines()
            lines[start : start + len(block)] = block  # an error then names the line of the page
    names = {"__name__": "example"}
    exec(compile("\n".join(lines), str(page), "exec"), names)
    return names


def _tokens(page):
    return MarkdownIt("commonmark").enable("table").parse(page.read_text(encoding="utf-8"))
