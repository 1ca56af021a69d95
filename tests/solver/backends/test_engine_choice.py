# SPDX-License-Identifier: GPL-3.0-or-later
"""Taichi where it is, else Quadrants, and the name of the one to install where neither is."""

import re
from pathlib import Path
from types import SimpleNamespace

import pytest
from in_a_process import passes

from solver.backends import engine_choice
from solver.backends.engine_choice import QUADRANTS, TAICHI

ROOT = Path(__file__).parents[3]
BOTH = {"taichi", "quadrants"}


@pytest.mark.parametrize(
    ("installed", "python", "system", "machine", "expected"),
    [
        (BOTH, (3, 11), "linux", "x86_64", TAICHI),
        (BOTH, (3, 14), "linux", "x86_64", TAICHI),  # built by its user
        ({"taichi"}, (3, 13), "win32", "AMD64", TAICHI),
        ({"quadrants"}, (3, 14), "linux", "x86_64", QUADRANTS),
        ({"quadrants"}, (3, 11), "darwin", "arm64", QUADRANTS),
        (set(), (3, 11), "linux", "x86_64", TAICHI),
        (set(), (3, 13), "darwin", "arm64", TAICHI),
        (set(), (3, 14), "win32", "AMD64", QUADRANTS),
        (set(), (3, 15), "linux", "x86_64", QUADRANTS),
        (set(), (3, 13), "linux", "aarch64", QUADRANTS),
    ],
)
def test_the_engine(monkeypatch, installed, python, system, machine, expected):
    specs = {name: SimpleNamespace(origin=f"{name}/__init__.py") for name in installed}
    monkeypatch.setattr(engine_choice, "find_spec", specs.get)
    there = SimpleNamespace(version_info=python, platform=system)
    monkeypatch.setattr(engine_choice, "sys", there)
    monkeypatch.setattr(engine_choice, "platform", SimpleNamespace(machine=lambda: machine))
    assert engine_choice.engine.__wrapped__() is expected


def test_a_folder_that_was_left_behind_is_no_engine(tmp_path):
    for name in BOTH:
        (tmp_path / name / "lang").mkdir(parents=True)
    passes(
        f"""
        sys.path[:] = [{str(tmp_path)!r}] + [p for p in sys.path if "site-packages" not in p]
        from solver.backends import engine_choice
        both = engine_choice.TAICHI, engine_choice.QUADRANTS
        assert not any(map(engine_choice._is_installed, both))
        """
    )


def test_one_file_imports_the_engine():
    statement = re.compile(r"^\s*(import|from) (taichi|quadrants)\b", re.MULTILINE)
    rooms = ("solver", "cubic_craft_addon", "operators", "library")
    files = [path for room in rooms for path in (ROOT / room).rglob("*.py")]
    assert [path.name for path in files if statement.search(path.read_text())] == ["engine.py"]
