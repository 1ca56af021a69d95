# SPDX-License-Identifier: GPL-3.0-or-later
"""What is loaded ahead is all that a first run needs, and nothing that fails stops anybody."""

import subprocess
import sys
import textwrap
from pathlib import Path

import pytest
from engine_marks import needs_engine

ROOT = Path(__file__).parents[3]


def run(code):
    """Run code in a process of its own, which has loaded nothing; return what it prints."""
    code = textwrap.dedent(code)
    command = [sys.executable, "-c", f"import sys; sys.path.insert(0, {str(ROOT)!r})\n{code}"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return done.stdout.splitlines()


@needs_engine
def test_afterwards_a_run_compiles_nothing_and_imports_nothing_that_takes_long():
    lines = run(
        """
        import numpy as np
        from solver import ProxyOptions, loading_steps, stylize
        steps = sum(1 for _ in loading_steps())
        before = set(sys.modules)
        V = np.array([[0.0, 0, 0], [2, 0, 0], [0, 1, 0], [0, 0, 1]])
        F = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
        result = stylize(V, np.array(F), 0.4, proxy=ProxyOptions(), keep_rotation=True)
        print(steps, result.compile_seconds)
        print(*(name for name in set(sys.modules) - before if not name.startswith("solver.")))
        """
    )
    steps, seconds = lines[-2].split()
    assert int(steps) >= 5 and float(seconds) == 0.0
    assert not lines[-1].split()


@pytest.mark.thorough(1)
@pytest.mark.parametrize("error", ["ImportError", "OSError", "RuntimeError"])
def test_an_engine_that_does_not_work_is_left_to_the_run(error):
    lines = run(
        f"""
        from solver import loading_steps
        from solver.backends import engine
        def broken():
            raise {error}("broken")
        engine.import_engine = broken
        print(sum(1 for _ in loading_steps("cpu")))
        """
    )
    assert int(lines[-1]) > 0


def test_without_an_engine_the_rest_is_loaded():
    lines = run(
        """
        from solver import loading_steps
        for _ in loading_steps("numpy"):
            pass
        print("scipy.sparse" in sys.modules, "taichi" in sys.modules, "quadrants" in sys.modules)
        """
    )
    assert lines[-1] == "True False False"
