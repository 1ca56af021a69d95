# SPDX-License-Identifier: GPL-3.0-or-later
"""Batches that are not begun: one line on standard error, exit code 2, and nothing written."""

import os

import pytest
from batch_kit import CUBE
from headless import PATIENCE, SCRIPT, headless, headless_refused, start_headless

TO = ("--output-folder", "out")

# arguments, and what the one line must name
REFUSALS = {
    "folder of nothing": (["empty", *TO], ["empty", "no meshes", ".obj"]),
    "folder of folders": (["above", *TO], ["above", "no meshes", "--recursive"]),
    "empty all the way": (["empty", *TO, "--recursive"], ["empty", "no meshes"]),
    "no output folder": (["meshes"], ["meshes", "folder", "--output-folder"]),
    "files, no folder": (["a.obj", "b.obj"], ["several", "--output-folder"]),
    "no input": ([*TO], ["--output-folder", "give the files"]),
    "missing file": (["a.obj", "none.obj", *TO], ["none.obj", "no such file"]),
    "a pipe": (["a.obj", "pipe.obj", *TO], ["pipe.obj", "a device or a pipe"]),
    "a pipe alone": (["pipe.obj"], ["pipe.obj", "a device or a pipe"]),
    "unknown format": (["a.obj", "notes.txt", *TO], ["notes.txt", ".txt", ".obj"]),
    "the folder is a file": (["a.obj", "--output-folder", "b.obj"], ["--output-folder", "b.obj"]),
    "below a file": (["a.obj", "--output-folder", "b.obj/x"], ["--output-folder", "b.obj"]),
    "not writable": (["a.obj", "--output-folder", "/proc/x"], ["--output-folder", "/proc"]),
    "nothing to do": (["meshes", *TO, "--no-render"], ["--no-render", "--save-mesh"]),
    "one picture": (["meshes", *TO, "--output", "a.png"], ["--output", "one file"]),
    "error file": (["meshes", *TO, "--error-file", "e.txt"], ["--error-file", "--report"]),
    "a name, no ending": (["meshes", *TO, "--save-mesh", "a.obj"], ["--save-mesh", "_cubic.obj"]),
    "a path, no ending": (["meshes", *TO, "--save-mesh", "./_a.obj"], ["--save-mesh", "_cubic"]),
    "no format": (["meshes", *TO, "--save-mesh", "_cubic"], ["--save-mesh", ".ply"]),
    "stl": (["meshes", *TO, "--save-mesh", ".stl"], ["--save-mesh", "vertex order"]),
    "into the inputs": (
        ["meshes", "--output-folder", "meshes", "--save-mesh", "_c.obj"],
        ["--output-folder", "meshes", "inputs"],
    ),
    "over an input": (
        ["a.obj", "b.obj", "--output-folder", ".", "--save-mesh", ".obj"],
        ["a.obj", "input", "--output-folder"],
    ),
    "no jobs": (["meshes", *TO, "--jobs", "0"], ["--jobs", "0"]),
    "report format": (["meshes", *TO, "--report", "a.txt"], ["--report", "a.txt", ".json"]),
    "report nowhere": (["meshes", *TO, "--report", "no/a.json"], ["--report", "no", "create"]),
    "jobs for one": (["a.obj", "--jobs", "2"], ["--jobs", "--output-folder"]),
    "force for one": (["a.obj", "--force"], ["--force", "--output-folder"]),
    "recursive for one": (["a.obj", "--recursive"], ["--recursive", "--output-folder"]),
    "jobs of a cluster": (
        ["meshes", *TO, "--jobs", "2", "--scheduler", "tcp://127.0.0.1:9"],
        ["--jobs", "cluster"],
    ),
    "no address": (["meshes", *TO, "--scheduler", "no way"], ["--scheduler no way"]),
    "cluster for one": (["a.obj", "--scheduler", "x"], ["--scheduler", "--output-folder"]),
    "no handles": (["meshes", *TO, "--handles", "none.json"], ["--handles", "none.json"]),
}


@pytest.fixture
def folder(tmp_path):
    for name in ("a.obj", "b.obj", "meshes/c.obj", "above/below/d.obj"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(CUBE)
    (tmp_path / "notes.txt").write_text("no mesh")
    (tmp_path / "empty").mkdir()
    os.mkfifo(tmp_path / "pipe.obj")
    return tmp_path


@pytest.mark.thorough(12)
@pytest.mark.parametrize("case", REFUSALS)
def test_refusal(folder, case):
    arguments, words = REFUSALS[case]
    headless_refused(*arguments, words=words, cwd=folder, run=headless)


SOON = f"""
import runpy, sys
sys.argv[0] = {str(SCRIPT)!r}
sys.path.insert(0, {str(SCRIPT.parent)!r})
from cubic_craft.cubic_craft_addon.command_line.batch import engine
engine.SECONDS_TO_ANSWER = 1
runpy.run_path(sys.argv[0], run_name="__main__")
"""


def test_where_no_cluster_answers_it_says_so(folder):
    address = "tcp://127.0.0.1:9"
    process = start_headless("meshes", *TO, "--scheduler", address, cwd=folder, script=("-c", SOON))
    _, errors = process.communicate(timeout=PATIENCE)
    assert process.returncode == 2, errors
    (line,) = errors.splitlines()
    assert f"--scheduler {address}: no scheduler answers" in line and "dask scheduler" in line
    assert not (folder / "out").exists()


WITHOUT = f"""
import runpy, sys
sys.modules["distributed"] = None
sys.argv[0] = {str(SCRIPT)!r}
runpy.run_path(sys.argv[0], run_name="__main__")
"""


@pytest.mark.parametrize("option", [("--jobs", "2"), ("--scheduler", "tcp://127.0.0.1:9")])
def test_dask_is_missing(folder, option):
    before = sorted(folder.rglob("*"))
    process = start_headless("a.obj", "b.obj", *TO, *option, cwd=folder, script=("-c", WITHOUT))
    _, errors = process.communicate(timeout=PATIENCE)
    assert process.returncode == 2, errors
    (line,) = errors.splitlines()
    assert option[0] in line and line.endswith("-m pip install distributed")
    assert sorted(folder.rglob("*")) == before


def test_one_after_the_other_needs_no_package(folder):
    quick = ("--device", "numpy", "--max-iterations", "1", "--no-render", "--save-mesh", ".obj")
    for arguments in (["a.obj", "b.obj"], ["meshes", "--jobs", "2"]):  # with one file in it
        process = start_headless(*arguments, *TO, *quick, cwd=folder, script=("-c", WITHOUT))
        _, errors = process.communicate(timeout=PATIENCE)
        assert process.returncode == 0, errors
