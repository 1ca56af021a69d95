# SPDX-License-Identifier: GPL-3.0-or-later
"""What a terminal shows: names as they are, how far a run is, and after Ctrl-C one line."""

import os
import re
import signal
import sys
import time

import pytest
from batch_kit import CUBE, MESHES, QUICK
from headless import PATIENCE, SCRIPT

pty = pytest.importorskip("pty", reason="there are no pseudo-terminals on this system")

CTRL_C = b"\x03"


def in_terminal(*arguments, cwd, interrupt_at=None):
    """Run the script in a terminal of its own; return its exit code and all it has shown.

    With ``interrupt_at`` Ctrl-C is pressed as soon as that is shown.
    """
    process, terminal = pty.fork()
    if process == 0:
        os.chdir(cwd)
        # A test run in the background may have it ignored, which children would inherit.
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        environment = os.environ | {"TERM": "xterm-256color", "COLUMNS": "200"}
        command = [sys.executable, str(SCRIPT), *map(str, arguments)]
        os.execve(sys.executable, command, environment)
    shown, end = b"", time.monotonic() + PATIENCE
    while time.monotonic() < end:
        try:
            piece = os.read(terminal, 65536)
        except OSError:  # the other side is closed
            break
        shown += piece
        if interrupt_at is not None and interrupt_at in shown:
            interrupt_at = None
            os.write(terminal, CTRL_C)
    _, status = os.waitpid(process, 0)
    os.close(terminal)
    return os.waitstatus_to_exitcode(status), shown


def test_a_batch_shows_names_with_brackets_as_they_are(tmp_path):
    (tmp_path / "[red]a [b].obj").write_text(CUBE)
    arguments = (".", "--output-folder", "out", *MESHES)
    code, shown = in_terminal(*arguments, cwd=tmp_path)
    assert code == 0, shown
    assert shown.count(b"[red]a [b].obj") >= 2, "in the line of the file, and of what is written"
    assert re.search(rb"cubeness 0\.4: \d+%", shown)


def test_ctrl_c_while_one_file_is_solved_leaves_one_line(tmp_path):
    endless = ("--tolerance", "1e-12", "--max-iterations", "1000000")
    arguments = ("--device", "numpy", "--no-render", "--save-mesh", "a.obj", *endless)
    code, shown = in_terminal(*arguments, cwd=tmp_path, interrupt_at=b"cubeness 0.4")
    assert code == 130, shown
    assert shown.endswith(b"headless_render.py: interrupted\r\n")


def test_objects_with_brackets_in_their_names(tmp_path):
    (tmp_path / "a.obj").write_text(CUBE.replace("o part", "o [/part]"))
    arguments = ("a.obj", *QUICK, "--no-render", "--save-mesh", "b.obj")
    code, shown = in_terminal(*arguments, cwd=tmp_path)
    assert code == 0, shown
    assert b"[/part], cubeness 0.4" in shown
