# SPDX-License-Identifier: GPL-3.0-or-later
"""A package that the extensions platform would send back is not built."""

import struct
from pathlib import Path

import pytest
from made_up import NEEDED, PACKAGE, good_wheels, lock_of, package

from scripts.package.check import check

IMAGES = Path(__file__).resolve().parents[2] / "docs" / "images"
RGB, RGBA = 2, 6  # kinds of color in a PNG


@pytest.fixture
def problems(tmp_path):
    """Return a function that makes a good package with some files or fields, and checks it."""

    def find(files=(), **fields):
        wheels = good_wheels()
        path = package(tmp_path / "package.zip", wheels, files=files, **fields)
        return check(path, PACKAGE, lock_of(wheels), NEEDED)

    return find


@pytest.mark.parametrize(
    ("code", "words"),
    [
        ("from urllib.request import urlopen", "imports urllib"),
        ("import json, socket", "imports socket"),
        ("import pip", "may install something"),
        ("eval(text)", "line 1, runs what it makes up"),
        ("import sys\nsys.path.append(folder)", "line 2, changes sys.path"),
        ("import sys\nsys.path[:0] = [folder]", "line 2, changes sys.path"),
        ("import sys\nsys.modules['a'] = b", "line 2, changes sys.modules"),
        ("import sys\ndel sys.modules['a']", "line 2, changes sys.modules"),
        ("import sys\nsys.stdout = None", "line 2, changes sys.stdout"),
        ("import numpy as np, os\nos.path.join = f", "line 2, changes os.path.join"),
        ("import inspect\ninspect.getmodule = f", "line 2, changes inspect.getmodule"),
        ("import sys\na = sys.modules.get('a')\na.print = f", "line 3, changes a.print"),
        ("import sys\na: Any = sys.modules['a']\ndel a.print", "line 3, changes a.print"),
        ("import inspect\nsetattr(inspect, name, f)", "line 2, changes inspect"),
    ],
)
def test_code_that_a_reviewer_objects_to(problems, code, words):
    assert problems({"solver/new.py": code}) == [
        f"solver/new.py{',' if words.startswith('line') else ''} {words}"
    ]


def test_what_is_explained_may_be_replaced_for_a_time_in_its_file_only(problems):
    code = "import sys\nsys.setdlopenflags = f"
    assert problems({"solver/backends/engine.py": code}) == []
    assert problems({"solver/backends/warmup.py": code}) != []


def test_code_that_looks_like_it_and_is_not(problems):
    code = """
import sys, weakref, bpy
from . import http
modules = sys.modules.get("a")
modules.b()
setattr(self, name, sys)
weakref.finalize(a, b).atexit = False
bpy.context.scene.name = "A"
self.path.append(sys.path)
"""
    assert problems({"solver/new.py": code}) == []


def test_what_nobody_can_review(problems):
    name = "solver/__pycache__/new.cpython-311.pyc"
    assert problems({name: ""}) == [f"{name} is compiled, so nobody can review it"]


def test_a_website_is_not_needed_and_may_be_there(problems):
    assert problems() == problems(website="https://docs.cubes.org/page") == []


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"name": "Cubes for Blender"}, "its name has the word Blender in it"),
        ({"tagline": "The best."}, "or ends like a sentence"),
        ({"tagline": "a" * 65}, "over 64 letters"),
        ({"website": "http://cubes.org"}, "is no public address"),
        ({"website": "https://localhost:8000/"}, "is no public address"),
        ({"website": "https://example.com"}, "is no public address"),
    ],
)
def test_texts_of_the_manifest(problems, fields, words):
    [problem] = problems(**fields)
    assert words in problem


@pytest.mark.parametrize(
    ("name", "size", "kinds"),
    [
        ("platform_icon.png", (256, 256), [RGBA]),
        ("platform_feature.png", (1920, 1080), [RGB, RGBA]),
    ],
)
def test_pictures_have_the_sizes_that_the_platform_takes(name, size, kinds):
    head = (IMAGES / name).read_bytes()[:26]
    assert head.startswith(b"\x89PNG\r\n\x1a\n")
    assert struct.unpack(">II", head[16:24]) == size
    assert head[25] in kinds
