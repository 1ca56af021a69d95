# SPDX-License-Identifier: GPL-3.0-or-later
"""What the documentation tells to type is there, and each figure names what makes it."""

import fnmatch
import json
import re
import subprocess
import sys
from functools import cache

import pytest
from documents import PAGES, ROOT, pages_for, sections

HEADLESS = ("headless_render.py", "blender -c cubic_craft")
PAGES_OF_HEADLESS = ("batch.md", "handles_scripts.md", "scripting.md")
MAKES_FIGURES = re.compile(r"^(make |pytest |python |\.venv/|scripts/|tests/|[A-Z_]+=)")
OF_DEVELOPERS = re.compile(r"^(make |pytest |\.venv/|tests/)")
PICTURES = ROOT / "docs" / "pictures.md"
LONGEST_README = 700  # words
MEASURED = re.compile(r"\d ?(ms|s|seconds|minutes|MB|GB|MiB|GiB|times) ")

by_page = pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)


def commands(page):
    return [command for section in sections(page) for command in section.commands]


@by_page
def test_make_targets_are_there(page):
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    targets = set(re.findall(r"^([a-z0-9-]+):", makefile, re.MULTILINE))
    for command in commands(page):
        words = re.sub(r'"[^"]*"', "", command).split()
        if words and words[0] == "make":
            named = {word for word in words[1:] if "=" not in word and not word.startswith("-")}
            assert named <= targets, f"{command}: there is no {named - targets} in the Makefile"


@by_page
def test_options_of_the_command_line_are_there(page):
    for command in commands(page):
        is_alone = command.startswith("--") and page.name in PAGES_OF_HEADLESS
        if is_alone or any(begin in command for begin in HEADLESS):
            given = set(re.findall(r"(?<=\s)--[a-z-]+", f" {command}".replace(" -- ", " ")))
            unknown = given - options_of_headless()
            assert not unknown, f"{command}: there is no {unknown}"


@cache
def options_of_headless():
    script = ROOT / "scripts" / HEADLESS[0]
    text = subprocess.run(
        [sys.executable, script, "--help"], capture_output=True, text=True, check=True
    ).stdout
    return set(re.findall(r"--[a-z-]+", text))


@by_page
def test_files_in_commands_are_there(page):
    for command in commands(page):
        for path in re.findall(r"\b(?:tests|scripts|examples|requirements)/[\w/.]+\.\w+", command):
            assert (ROOT / path).exists(), f"{command}: there is no {path}"


@by_page
def test_figures_name_the_command_that_makes_them(page):
    """In their section, in the introduction of the page, or for pictures on a page of its own."""
    introduction = sections(page)[0]
    for section in sections(page):
        unnamed = [image for image in section.images if not is_listed(page.parent / image)]
        if MEASURED.search(section.text):
            unnamed.append("numbers")
        named = [c for c in section.commands + introduction.commands if MAKES_FIGURES.match(c)]
        assert named or not unnamed, f'"{section.title}" has {unnamed}, but no command beside them'


def is_listed(image):
    """Return whether the page that lists pictures names this one, alone or by a pattern."""
    name = image.resolve().relative_to(PICTURES.parent).as_posix()
    return any(fnmatch.fnmatch(name, pattern) for pattern in commands(PICTURES))


@pytest.mark.parametrize("page", pages_for("For artists"), ids=lambda page: page.name)
def test_artists_are_told_no_commands_of_developers(page):
    assert not [command for command in commands(page) if OF_DEVELOPERS.match(command)]


def test_readme_has_the_two_commands_and_one_screen_of_words():
    readme = ROOT / "README.md"
    assert {"make render", "make test"} <= {command.strip() for command in commands(readme)}
    assert len(readme.read_text(encoding="utf-8").split()) <= LONGEST_README


def test_json_of_handles_can_be_read(tmp_path):
    sys.path.insert(0, str(ROOT / "scripts"))
    from cubic_craft.cubic_craft_addon.command_line.options.handles_file import read_handles

    blocks = [
        content
        for section in sections(ROOT / "docs" / "handles_scripts.md")
        for language, content, _ in section.fences
        if language == "json"
    ]
    path = tmp_path / "handles.json"
    path.write_text(blocks[0], encoding="utf-8")
    assert len(read_handles(path)) == len(json.loads(blocks[0]))
