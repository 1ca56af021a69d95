# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input of the installed command: one line, exit code 2, and nothing is written."""

import os
import platform
import signal
import subprocess
import sys
import time

import pytest
import trimesh
from command import COMMAND, QUICK, in_a_process, refused

from cubic_craft.console.output import replacing
from tests.icospheres import blob

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
PLY = """ply
format binary_little_endian 1.0
element vertex 3
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
"""
DIGITS = "1" * 30

ARGUMENTS = {
    "no output": (["ok.obj"], "OUTPUT"),
    "unknown option": (["ok.obj", "a.obj", "--cubenes", "1"], "--cubenes"),
    "missing": (["none.obj", "a.obj"], "none.obj: there is no such file"),
    "folder as input": (
        ["folder.obj", "a.obj"],
        "folder.obj: there are no meshes in this folder",
    ),
    "unknown format": (["ok.fbx", "a.obj"], "ok.fbx: cannot read '.fbx' files; give .obj"),
    "unknown output": (["ok.obj", "a.fbx"], "a.fbx: the name must end in .obj"),
    "no suffix": (["ok.obj", "a"], "a: the name must end in .obj"),
    "same file": (["ok.obj", "./ok.obj"], "ok.obj: this is an input"),
    "no folder": (["ok.obj", "none/a.obj"], "the folder none does not exist; create it"),
    "missing of several": (["ok.obj", "none.obj", "out"], "none.obj: there is no such file"),
    "report": (["ok.obj", "a.obj", "--report", "a.txt"], "--report a.txt: the name must end"),
    "not writable": (["ok.obj", "/proc/a.obj"], "cannot write to /proc"),
}

FILES = {
    "empty.obj": ("", "the file is empty"),
    "no_faces.obj": ("v 0 0 0\nv 1 0 0\nv 0 1 0\n", "no faces"),
    "nan.obj": (TRIANGLE.replace("1 0 0", "nan 0 0"), "not finite"),
    "words.obj": (TRIANGLE.replace("1 0 0", "a b c"), "three coordinates ('v a b c')"),
    "short.obj": (TRIANGLE.replace("v 1 0 0", "v 1 0"), "three coordinates"),
    "out_of_range.obj": (TRIANGLE.replace("3\n", "4\n"), "vertex 4, but there are only 3"),
    "index_0.obj": (TRIANGLE.replace("f 1", "f 0"), "there is no vertex 0"),
    "index_back.obj": (TRIANGLE.replace("f 1", "f -4"), "there is no vertex -4"),
    "two_corners.obj": (TRIANGLE.replace("f 1 2 3", "f 1 2"), "at least 3 corners"),
    "digits.obj": (TRIANGLE.replace("f 1", f"f {DIGITS}"), f"there is no vertex {DIGITS}"),
    "too_large.obj": (TRIANGLE.replace("1 0 0", "-1e308 0 0"), "which is too large"),
    "corner.obj": (TRIANGLE.replace("f 1", "f x"), "'x' is not a corner"),
    "huge.obj": (TRIANGLE.replace("f 1 2 3", "v 1e999 1 0\nf 1 2 4 3"), "not finite"),
    "binary.obj": ("\x00\x01\x02", "no faces"),
    "empty.ply": ("", "the file is empty"),
    "other.ply": ("hello", "Not a ply file"),
    "cut.ply": (PLY, "cannot be read as .ply"),
    "cut.stl": ("x" * 100, "has no vertices on faces; is the file cut off?"),
    "other.stl": ("hello", "has no vertices on faces"),
    "other.off": ("hello", "cannot be read as .off"),
}


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "ok.obj").write_text(TRIANGLE)
    (tmp_path / "folder.obj").mkdir()
    return tmp_path


@pytest.mark.parametrize("name", ARGUMENTS)
def test_arguments(name, folder):
    arguments, words = ARGUMENTS[name]
    assert words in refused(*arguments, folder=folder)


@pytest.mark.parametrize("name", FILES)
def test_files(name, tmp_path):
    content, words = FILES[name]
    (tmp_path / name).write_text(content)
    line = refused(name, "out.obj", folder=tmp_path)
    assert words in line and line.startswith(f"cubic-craft: error: {name}: ")


def test_a_gpu_that_is_not_there_is_named(folder, monkeypatch):
    for variable in ("VK_DRIVER_FILES", "VK_ICD_FILENAMES"):  # older loaders know the latter
        monkeypatch.setenv(variable, str(folder / "no_driver.json"))
    for engine in ("TI", "QD"):
        monkeypatch.setenv(f"{engine}_ENABLE_CUDA", "0")
    line = refused("ok.obj", "a.obj", "--device", "gpu", folder=folder, run=in_a_process)
    assert "gpu" in line.lower()


@pytest.mark.parametrize("rows", [0, 1, 2.5, 3])
def test_ply_files_that_were_cut_off_are_refused(rows, tmp_path):
    V, F = blob(1)
    trimesh.Trimesh(V, F, process=False).export(tmp_path / "whole.ply")
    content = (tmp_path / "whole.ply").read_bytes()
    (tmp_path / "cut.ply").write_bytes(content[: len(content) - int((len(F) - rows) * 13)])
    assert "cut.ply: " in refused("cut.ply", "out.ply", folder=tmp_path)


def test_what_a_format_of_32_bits_cannot_hold_is_said(tmp_path):
    (tmp_path / "large.obj").write_text(TRIANGLE.replace("1 0 0", "1e60 0 0"))
    line = refused("large.obj", "out.stl", *QUICK, folder=tmp_path)
    assert "out.stl: its coordinates are too large for this format" in line


def test_an_output_survives_a_refusal(folder):
    (folder / "old.obj").write_text("precious")
    (folder / "bad.obj").write_text("v 0 0 0\n")
    refused("bad.obj", "old.obj", folder=folder, run=in_a_process)
    assert (folder / "old.obj").read_text() == "precious"


@pytest.mark.parametrize(
    ("number", "words"), [(signal.SIGINT, "interrupted"), (signal.SIGTERM, "told to end")]
)
def test_a_run_that_is_stopped_leaves_nothing(number, words, tmp_path):
    V, F = blob(6)
    large = tmp_path / "large.ply"
    trimesh.Trimesh(V, F, process=False).export(large)
    process = subprocess.Popen(
        [COMMAND, "large.ply", "out.ply", *QUICK, "--tolerance", "1e-12"],
        cwd=tmp_path,
        env={**os.environ, "TMPDIR": str(tmp_path)},
        stderr=subprocess.PIPE,
        # A test run in the background may have SIGINT ignored, which children would inherit.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    time.sleep(3.0)  # it solves, for minutes
    process.send_signal(number)
    code, said = process.wait(timeout=60), process.stderr.read().decode()
    assert (code, said) == (128 + number, f"cubic-craft: {words}\n")
    assert list(tmp_path.iterdir()) == [large]


@pytest.mark.skipif(sys.platform == "win32", reason="it has no such files")
def test_no_pipe_is_waited_for_and_no_device_is_read_to_its_end(tmp_path):
    os.mkfifo(tmp_path / "pipe.obj")
    (tmp_path / "zero.ply").symlink_to("/dev/zero")
    for name in ("pipe.obj", "zero.ply"):
        line = refused(name, "a.obj", folder=tmp_path)
        assert f"{name}: is a device or a pipe" in line


@pytest.mark.skipif(sys.platform == "win32", reason="it needs rights for links")
def test_nothing_is_written_through_a_link(tmp_path):
    secret = tmp_path / "secret.txt"
    secret.write_text("secret")
    path = tmp_path / "a.obj"
    (tmp_path / f".a.cubic_craft-{platform.node()}-{os.getpid()}.obj").symlink_to(secret)
    path.symlink_to(secret)
    with replacing(path) as temporary:
        temporary.write_text("new")
    assert (path.read_text(), path.is_symlink(), secret.read_text()) == ("new", False, "secret")
