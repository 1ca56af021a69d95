# SPDX-License-Identifier: GPL-3.0-or-later
"""The names of the solver are listed once, found by all tools, and imported on first use."""

import subprocess
import sys
from pathlib import Path

import pytest

import solver

ROOT = Path(__file__).parents[2]


def test_dir_and_star_give_the_same_names():
    names = {}
    exec("from solver import *", names)
    assert set(solver.__all__) == set(names) - {"__builtins__"}
    assert set(solver.__all__) == {name for name in dir(solver) if not name.startswith("__")}
    assert "stylize" in names and len(names) > 40


def test_all_can_be_imported_and_no_other():
    for name in solver.__all__:
        assert getattr(solver, name) is not None
    with pytest.raises(AttributeError, match="no attribute 'stilize'"):
        _ = solver.stilize


def test_the_names_load_nothing_until_one_is_used():
    script = "import sys, solver; dir(solver); print(*sys.modules)"
    words = [sys.executable, "-c", script]
    loaded = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert {"numpy", "scipy", "taichi", "quadrants"}.isdisjoint(loaded.split())
