# SPDX-License-Identifier: GPL-3.0-or-later
"""Batches that are not begun: one line on standard error, exit code 2, and nothing written."""

import os

import pytest
from batch_kit import CUBE
from headless import headless, headless_refused

TO = ("--output-folder", "out")

# arguments, and what the one line must name
REFUSALS = {
    "folder of nothing": (["empty", *TO], ["empty", "no meshes", "only 1 .max", ".obj"]),
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
    "one name twice": (["a.obj", "twin/a.obj", *TO], ["twin/a.obj", "rename"]),
    "a name, no ending": (["meshes", *TO, "--save-mesh", "a.obj"], ["--save-mesh", "_cubic.obj"]),
    "a path, no ending": (["meshes", *TO, "--save-mesh", "./_a.obj"], ["--save-mesh", "_cubic"]),
    "no format": (["meshes", *TO, "--save-mesh", "_cubic"], ["--save-mesh", ".ply"]),
    "gltf": (["meshes", *TO, "--save-mesh", ".gltf"], ["--save-mesh", ".gltf", ".glb"]),
    "levels without files": (["meshes", *TO, "--low-poly", "100"], ["--low-poly", "--save-mesh"]),
    "levels of nothing": (
        ["meshes", *TO, "--low-poly", "100", "--save-mesh", ".obj"],
        ["--low-poly", ".glb or .fbx"],
    ),
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
    "no handles": (["meshes", *TO, "--handles", "none.json"], ["--handles", "none.json"]),
}


@pytest.fixture
def folder(tmp_path):
    for name in ("a.obj", "b.obj", "meshes/c.obj", "above/below/d.obj", "twin/a.obj"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(CUBE)
    (tmp_path / "notes.txt").write_text("no mesh")
    (tmp_path / "empty").mkdir()
    (tmp_path / "empty" / "scene.max").write_text("no mesh")
    os.mkfifo(tmp_path / "pipe.obj")
    return tmp_path


@pytest.mark.thorough(8)
@pytest.mark.parametrize("case", REFUSALS)
def test_refusal(folder, case):
    arguments, words = REFUSALS[case]
    headless_refused(*arguments, words=words, cwd=folder, run=headless)
