# SPDX-License-Identifier: GPL-3.0-or-later
"""Broken files: a finite result, or one line that says why not, and never more than that."""

import sys
from pathlib import Path

import numpy as np
import pytest
from headless import headless, headless_shared

CORPUS = Path(__file__).resolve().parents[1] / "corpus"
sys.path.insert(0, str(CORPUS))
from expected import DONE, REFUSED  # noqa: E402

# In a process of their own, which might crash or speak at its end, one that is sound and one that
# is broken for each importer; all others go through one Blender, which they must leave sound.
ALONE = (
    *("moebius.obj", "index_too_large.ply", "buffer_too_short.gltf"),
    *("too_huge.obj", "cut_faces.ply", "text_cut.stl", "index_negative.usda", "cut.gltf"),
)
ARGUMENTS = (
    *("--no-render", "--save-mesh", "result.obj"),
    *("--device", "numpy", "--max-iterations", "10"),
)


def test_each_file_is_known():
    assert sorted(path.name for path in (CORPUS / "files").iterdir()) == sorted(DONE | REFUSED)


def run(name, folder):
    """Cubify a file of the corpus into a folder."""
    way = headless if name in ALONE else headless_shared
    return way(CORPUS / "files" / name, *ARGUMENTS, cwd=folder)


@pytest.mark.thorough(6)
@pytest.mark.parametrize("name", DONE)
def test_what_can_be_cubified_is(name, tmp_path):
    process = run(name, tmp_path)
    assert process.returncode == 0, process.stderr
    assert "Traceback" not in process.stderr
    lines = (tmp_path / "result.obj").read_text().splitlines()
    V = np.array([line.split()[1:4] for line in lines if line.startswith("v ")], float)
    assert V.shape == (DONE[name], 3)
    assert np.isfinite(V).all()


@pytest.mark.thorough(7)
@pytest.mark.parametrize("name", REFUSED)
def test_what_cannot_is_refused_in_one_line(name, tmp_path):
    process = run(name, tmp_path)
    assert process.returncode == 2, process.stderr
    assert process.stdout == ""
    lines = process.stderr.splitlines()
    assert len(lines) == 1, process.stderr
    for word in (name, *REFUSED[name]):
        assert word in lines[0]
    assert list(tmp_path.iterdir()) == []
