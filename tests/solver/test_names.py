# SPDX-License-Identifier: GPL-3.0-or-later
"""The names of the solver are listed once, found by all tools, and imported on first use."""

import ast
import contextlib
import subprocess
import sys
from inspect import isclass, signature
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


def test_checkers_and_python_see_the_same():
    tree = ast.parse((ROOT / "solver" / "__init__.py").read_text(encoding="utf-8"))
    block = next(node for node in tree.body if isinstance(node, ast.If)).body
    lines = [line for line in block if isinstance(line, ast.ImportFrom)]
    assert {name.name: f".{x.module}" for x in lines for name in x.names} == solver._MODULES


def test_help_begins_with_the_first_call_and_can_be_read():
    assert solver.__doc__.startswith("`stylize` turns a mesh into a cubic sculpture")
    for name in solver.__all__:
        value = getattr(solver, name)
        methods = [x for key, x in vars(value).items() if key[0] != "_"] if isclass(value) else []
        for called in filter(callable, (value, *methods)):
            with contextlib.suppress(ValueError):  # an exception has none
                assert len(str(signature(called))) <= 1200, called


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
