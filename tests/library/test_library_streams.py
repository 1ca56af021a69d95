# SPDX-License-Identifier: GPL-3.0-or-later
"""The command with several inputs, with standard input and output, and where it must not write."""

import json
import subprocess
import sys

import meshio
import numpy as np
import pytest
from command import COMMAND, QUICK, cubic_craft, in_this_process, quick, refused

from cubic_craft.command_line.standard_streams import format_of
from scripts.benchmark.shapes import blob

V, F = blob(1)
EXPECTED = quick(V, F).positions
ENDINGS = (".obj", ".ply", ".stl", ".off", ".vtk", ".vtu")


def save(path):
    meshio.Mesh(V, [("triangle", F.astype(np.int32))]).write(path)
    return path.name


def piped(content, *arguments, code=0):
    words = [COMMAND, *arguments, *QUICK]
    done = subprocess.run(words, input=content, capture_output=True, check=False)
    assert done.returncode == code, done.stderr
    return done.stdout, done.stderr.decode().splitlines()


@pytest.mark.parametrize("ending", ENDINGS)
def test_what_comes_is_known_by_its_content(ending, tmp_path):
    save(tmp_path / f"blob{ending}")
    nameless = (tmp_path / f"blob{ending}").rename(tmp_path / "blob")
    assert format_of(nameless) == ending


def test_a_binary_stl_is_known_by_its_size(tmp_path):
    content = bytes(80) + (2).to_bytes(4, "little") + bytes(2 * 50)
    for each, ending in ((content, ".stl"), (content + b"x", ".obj")):
        (tmp_path / "nameless").write_bytes(each)
        assert format_of(tmp_path / "nameless") == ending


def test_pipes_pass_meshes_on(tmp_path):
    save(tmp_path / "blob.ply")
    out, lines = piped((tmp_path / "blob.ply").read_bytes(), "-", "-")
    assert out.startswith(b"ply") and len(lines) == 1 and lines[0].startswith("cubic-craft: -: 42")
    (tmp_path / "out.ply").write_bytes(out)
    assert np.allclose(meshio.read(tmp_path / "out.ply").points, EXPECTED)
    out, lines = piped((tmp_path / "blob.ply").read_bytes(), "-", "-", "--format", "obj", "--quiet")
    assert out.count(b"\nv ") + out.startswith(b"v ") == len(V) and lines == []


def test_what_is_wrong_with_standard_input_is_said():
    for content, words in (
        (b"", "the file is empty"),
        (b"hello", "no faces"),
        (b"ply", "no .ply file"),
    ):
        out, lines = piped(content, "-", "-", code=2)
        assert not out and len(lines) == 1
        assert lines[0].startswith("cubic-craft: error: standard input: ") and words in lines[0]


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
    assert np.allclose(meshio.read(tmp_path / "new" / "out" / "b.ply").points, EXPECTED)


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
    assert "no .ply file" in found[1]["error"]


def test_an_obj_names_the_materials_of_its_input_from_another_folder(tmp_path):
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "skin.mtl").write_text("newmtl skin\n")
    text = "mtllib skin.mtl\nmtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl skin\nf 1 2 3\n"
    (tmp_path / "in" / "a.obj").write_text(text)
    cubic_craft("in", "out", *QUICK, folder=tmp_path)
    lines = (tmp_path / "out" / "a.obj").read_text().splitlines()
    assert lines[:2] == ["mtllib ../in/skin.mtl", "mtllib none.mtl"]
    cubic_craft("in/a.obj", "in/b.obj", *QUICK, folder=tmp_path)
    assert (tmp_path / "in" / "b.obj").read_text().startswith("mtllib skin.mtl\n")


def test_a_quiet_run_says_nothing(tmp_path):
    assert cubic_craft(save(tmp_path / "a.ply"), "b.ply", "--quiet", *QUICK, folder=tmp_path) == []


def test_inputs_that_would_be_lost_are_refused(tmp_path):
    (tmp_path / "other").mkdir()
    save(tmp_path / "a.ply")
    save(tmp_path / "other" / "a.ply")
    assert "this is the input" in refused("a.ply", ".", folder=tmp_path)
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
