# SPDX-License-Identifier: GPL-3.0-or-later
# Suite: sid
"""The command of the installed extension, ``blender -c cubic_craft``: no window is clicked on.

Its processes share the user folder with this Blender, in which the extension is installed.
"""

import json
import os
import signal
import subprocess
import tempfile
import time
from pathlib import Path

import bpy
import guidrive as gui

OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
QUICK = ("--max-iterations", "3")
SMALL = ("--samples", "1", "--resolution", "64", "32")
SECONDS = 300
ENDLESS = ("--tolerance", "1e-12", "--max-iterations", "1000000", "--device", "numpy")


def start(folder, *arguments, before=("--offline-mode",)):
    """Start the command in a folder; return the process."""
    return subprocess.Popen(
        [bpy.app.binary_path, *before, "-c", "cubic_craft", *arguments],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def ended(process, code):
    """Return what a process has written to standard output and standard error."""
    words = process.communicate(timeout=SECONDS)
    print(*words)
    assert process.returncode == code, (process.returncode, words)
    return words


def test():
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        for name in ("a.obj", "b.obj"):
            (folder / name).write_text(OBJ)
        (folder / "broken.ply").write_text("nothing")
        check_help(folder)
        check_one_file(folder)
        check_a_batch(folder)
        check_interruption(folder)
    yield


def check_help(folder):
    output, _ = ended(start(folder, "--help"), 0)
    assert "usage: blender -c cubic_craft [INPUT ...] [options]" in output
    assert "--cubeness" in output and "--tolerance" in output
    _, errors = ended(start(folder, "none.obj"), 2)
    assert "cubic_craft: error: none.obj: there is no such file; check the path\n" in errors


def check_one_file(folder):
    """Let the engine solve the monkey, and render a picture."""
    ended(start(folder, *QUICK, *SMALL, "--output", "m.png", "--report", "m.json"), 0)
    expected = os.environ.get("EXPECT_DEVICE")
    report = json.loads((folder / "m.json").read_text())
    assert expected in (None, report["device"]), report["device"]
    assert (folder / "m.png").stat().st_size


def check_a_batch(folder):
    """Do what can be done."""
    outputs = ("--output-folder", "out", "--no-render", "--save-mesh", ".obj")
    _, errors = ended(start(folder, "a.obj", "b.obj", "broken.ply", *outputs, *QUICK), 3)
    assert "1 of 3 files failed" in errors
    assert sorted(path.name for path in folder.glob("out/*.obj")) == ["a.obj", "b.obj"]


def check_interruption(folder):
    """Press Ctrl-C, which ends it with one line and no file."""
    process = start(folder, *ENDLESS, "--cubeness", "0", "1", "--no-render", "--save-mesh", "c.obj")
    while "cubeness 0.0" not in process.stderr.readline():
        assert process.poll() is None
    time.sleep(1)  # it now solves the second
    process.send_signal(signal.SIGINT)
    _, errors = ended(process, 130)
    assert errors.splitlines()[-1] == "cubic_craft: interrupted"
    assert not list(folder.glob("*c_*"))


gui.run(test)
