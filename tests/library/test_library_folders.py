# SPDX-License-Identifier: GPL-3.0-or-later
"""The command with several inputs, and where it must not write."""

import json
import subprocess
import sys

import numpy as np
import pytest
import trimesh
from command import COMMAND, QUICK, cubic_craft, in_this_process, quick, refused

from tests.icospheres import blob

V, F = blob(1)
EXPECTED = quick(V, F).positions


def save(path):
    trimesh.Trimesh(V, F, process=False).export(path)
    return path.name


def test_several_inputs_go_to_a_folder_that_is_made(tmp_path):
    names = [save(tmp_path / f"{name}.ply") for name in "ab"]
    (tmp_path / "cut.ply").write_text("ply\n")
    words = [COMMAND, "a.ply", "cut.ply", "b.ply", "new/out", *QUICK]
    done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=False)
    lines = done.stderr.splitlines()
    assert done.returncode == 3 and len(lines) == 4, done.stderr
    assert lines[1].startswith("cubic-craft: error: cut.ply: ")
    assert lines[3] == "cubic-craft: 1 of 3 files failed"
    assert sorted(path.name for path in (tmp_path / "new" / "out").iterdir()) == names
    made = trimesh.load_mesh(tmp_path / "new" / "out" / "b.ply", process=False)
    assert np.allclose(made.vertices, EXPECTED, atol=1e-6)


def test_a_folder_and_its_report(tmp_path):
    (tmp_path / "in").mkdir()
    save(tmp_path / "in" / "a.ply")
    for name in ("cut.ply", "scene.max", ".hidden.ply"):
        (tmp_path / "in" / name).write_text("ply\n")
    done = in_this_process(("in", "out", "--report", "report.json", *QUICK), tmp_path)
    assert done.returncode == 3, done.stderr
    kinds, *_ = done.stderr.splitlines()
    assert kinds == "cubic-craft: left out, of kinds that are not read: 1 .max"
    whole = json.loads((tmp_path / "report.json").read_text())
    assert whole["counts"] == {"done": 1, "kept": 0, "failed": 1} and not whole["unfinished"]
    found = whole["files"]
    assert [each["status"] for each in found] == ["done", "failed"]
    assert (found[0]["vertices"], found[0]["outputs"]) == (42, ["out/a.ply"])
    assert "cut.ply: cannot be read" in found[1]["error"]


def test_a_quiet_run_says_nothing(tmp_path):
    assert cubic_craft(save(tmp_path / "a.ply"), "b.ply", "--quiet", *QUICK, folder=tmp_path) == []


def test_inputs_that_would_be_lost_are_refused(tmp_path):
    (tmp_path / "other").mkdir()
    save(tmp_path / "a.ply")
    save(tmp_path / "other" / "a.ply")
    assert "this is an input" in refused("a.ply", ".", folder=tmp_path)
    assert "two inputs have this name" in refused("a.ply", "other/a.ply", "out", folder=tmp_path)
    (tmp_path / "file").write_text("")
    (tmp_path / "b.ply").write_text("")
    assert "file: is a file" in refused("a.ply", "b.ply", "file", folder=tmp_path)


@pytest.mark.skipif(sys.platform == "win32", reason="it needs rights for links")
def test_links_and_what_is_protected_stay(tmp_path):
    save(tmp_path / "a.obj")
    (tmp_path / "old.obj").write_text("precious")
    (tmp_path / "link.obj").symlink_to("old.obj")
    assert "link.obj: this is a link" in refused("a.obj", "link.obj", folder=tmp_path)
    (tmp_path / "old.obj").chmod(0o444)
    assert "old.obj: this file is write-protected" in refused("a.obj", "old.obj", folder=tmp_path)
    assert (tmp_path / "link.obj").is_symlink()
    assert (tmp_path / "old.obj").read_text() == "precious"
