# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples of the library run as they are written, and draw their pictures."""

import subprocess
import sys
from pathlib import Path

import pytest

EXAMPLES = sorted((Path(__file__).parents[2] / "examples" / "library").glob("*.py"))


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_example_draws_its_picture(path, tmp_path):
    pytest.importorskip("matplotlib")
    picture = tmp_path / "plot.png"
    done = subprocess.run(
        [sys.executable, path, picture], cwd=tmp_path, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stderr
    assert picture.stat().st_size > 10_000
