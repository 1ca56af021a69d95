# SPDX-License-Identifier: GPL-3.0-or-later
"""Run the script as a user does, in a process of its own or in one for many runs."""

import json
import pickle
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import psutil
from shared_process import SharedProcess

SCRIPT = Path(__file__).resolve().parents[2] / "scripts" / "headless_render.py"
PATIENCE = 900
"""seconds: what takes longer on the slowest and busiest machine does not come at all"""
_shared = SharedProcess(PATIENCE)


def headless(*arguments, cwd):
    """Run headless_render.py in a process of its own, and return that once it is completed."""
    return subprocess.run(
        [sys.executable, str(SCRIPT), *map(str, arguments)],
        cwd=cwd,
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )


def headless_shared(*arguments, cwd):
    """Run headless_render.py where others ran before it, and return what a process would be."""
    return _shared.run(SCRIPT, ["--", *arguments], cwd)  # as in Blender, which is there already


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


def processor_seconds(number):
    """Return how long a process, by its number, has used the processor."""
    return sum(psutil.Process(number).cpu_times()[:2])


def headless_refused(*arguments, words, cwd, run=headless_shared):
    """Run headless_render.py, which must say these words in one line and leave all files alone."""
    before = sorted(cwd.rglob("*"))
    process = run(*arguments, cwd=cwd)
    assert process.returncode == 2, process.stderr
    assert process.stdout == ""
    lines = process.stderr.splitlines()
    assert len(lines) == 1, process.stderr
    for word in words:
        assert word in lines[0]
    assert sorted(cwd.rglob("*")) == before


def headless_ok(*arguments, cwd, run=headless_shared):
    """Run headless_render.py, which must succeed and leave standard output empty."""
    process = run(*arguments, cwd=cwd)
    assert process.returncode == 0, process.stderr
    assert process.stdout == ""
    return process


def make_blend(text, path):
    """Have Blender alone run a script that saves a file to ``sys.argv[1]``; return that."""
    with tempfile.NamedTemporaryFile("w", suffix=".py") as script:
        script.write(text)
        script.flush()
        _run_beside(script.name, path)
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
    names = [str(path) for path in paths]
    _run_beside(Path(__file__).with_name("read_files.py"), target, *names)
    found = pickle.loads(target.read_bytes())
    return [found[name] for name in names]


def _run_beside(script, *arguments):
    """Run a script of the tests, which must succeed."""
    process = _shared.run(script, arguments, Path(__file__).parent)
    assert process.returncode == 0, process.stderr
