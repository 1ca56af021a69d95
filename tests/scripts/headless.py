# SPDX-License-Identifier: GPL-3.0-or-later
"""Run the script as a user does, in a process of its own."""

import json
import pickle
import signal
import subprocess
import sys
from pathlib import Path

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "headless_render.py"
PATIENCE = 900
"""seconds: what takes longer on the slowest and busiest machine does not come at all"""


def headless(*arguments, cwd):
    """Run headless_render.py and return the completed process."""
    return subprocess.run(
        [sys.executable, str(SCRIPT), *map(str, arguments)],
        cwd=cwd,
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )


def start_headless(*arguments, cwd, script=(str(SCRIPT),)):
    """Start headless_render.py, or what stands in for it, and return the process."""
    return subprocess.Popen(
        [sys.executable, *script, *arguments],
        cwd=cwd,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        # A test run in the background may have SIGINT ignored, which children would inherit.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )


def headless_refused(*arguments, words, cwd):
    """Run headless_render.py, which must say these words in one line and leave all files alone."""
    before = sorted(cwd.rglob("*"))
    process = headless(*arguments, cwd=cwd)
    assert process.returncode == 2, process.stderr
    assert process.stdout == ""
    lines = process.stderr.splitlines()
    assert len(lines) == 1, process.stderr
    for word in words:
        assert word in lines[0]
    assert sorted(cwd.rglob("*")) == before


def headless_ok(*arguments, cwd):
    """Run headless_render.py, which must succeed and leave standard output empty."""
    process = headless(*arguments, cwd=cwd)
    assert process.returncode == 0, process.stderr
    assert process.stdout == ""
    return process


def make_blend(script, path):
    """Have a Blender of its own run a script that saves a file to ``sys.argv[1]``; return that."""
    subprocess.run([sys.executable, "-c", script, str(path)], check=True, capture_output=True)
    return path


def run_to_blend(source, folder, *options):
    """Cubify a file without a picture; return the report, and what the .blend has that it made."""
    target, report = folder / "out.blend", folder / "out.json"
    outputs = ("--no-render", "--save-mesh", target, "--report", report)
    headless_ok(source, *options, *outputs, cwd=folder)
    (found,) = read_files(target, folder=folder)
    return json.loads(report.read_text(encoding="utf-8")), found


def read_files(*paths, folder):
    """Return what `read_files.py` finds in each file, in a list."""
    target = folder / "read.pickle"
    script = Path(__file__).with_name("read_files.py")
    names = [str(path) for path in paths]
    subprocess.run([sys.executable, script, target, *names], check=True, capture_output=True)
    found = pickle.loads(target.read_bytes())
    return [found[name] for name in names]
