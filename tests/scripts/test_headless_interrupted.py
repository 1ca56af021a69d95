# SPDX-License-Identifier: GPL-3.0-or-later
"""Killed at any moment, the script leaves whole files only; told to end, it does so with one line.

``CUBIC_CRAFT_KILLS=100`` adds so many runs that are killed at moments spread over their length.
"""

import itertools
import os
import signal
import sys
import time

import pytest
from headless import PATIENCE, SCRIPT, headless, headless_ok, processor_seconds, start_headless

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals are not sent there")

OLD = b"of an earlier run"
CALM = {signal.SIGINT: "interrupted", signal.SIGTERM: "told to end"}
SIGNALS = [signal.SIGKILL, signal.SIGTERM, signal.SIGINT]
# The script with its last step, the move of the finished file to its place, held up.
HELD = f"""
import pathlib, runpy, sys, time
pathlib.Path.replace = lambda *_: time.sleep(600)
sys.argv[0] = {str(SCRIPT)!r}
runpy.run_path(sys.argv[0], run_name="__main__")
"""
QUICK = ("--device", "numpy", "--max-iterations", "3")
SMALL = ("--samples", "1", "--resolution", "64", "32")


def start(folder, *arguments, script=(str(SCRIPT),)):
    return start_headless(*QUICK, *arguments, cwd=folder, script=script)


def temporaries(folder):
    return [path for path in folder.iterdir() if path.name.startswith(".")]


def wait_until(process, is_reached):
    """Wait, with short pauses as moments are short; fail where the process ends before."""
    end = time.monotonic() + PATIENCE
    while not is_reached():
        assert process.poll() is None, process.stderr.read()
        assert time.monotonic() < end, "the moment does not come"
        time.sleep(0.001)


def stop(process, number):
    """Send a signal and check how the process ends, and what it says."""
    process.send_signal(number)
    _, errors = process.communicate(timeout=PATIENCE)
    if number == signal.SIGKILL:
        assert process.returncode == -number
        return
    assert process.returncode == 128 + number, errors
    assert "Traceback" not in errors
    assert errors.splitlines()[-1] == f"headless_render.py: {CALM[number]}"


# Each kind of file and each signal: what removes the temporary file knows of neither.
@pytest.mark.thorough(1)
@pytest.mark.parametrize(
    ("suffix", "number"),
    zip(["obj", "ply", "blend", "usdc", "abc", "png"], itertools.cycle(SIGNALS), strict=False),
)
def test_stopped_before_a_file_is_in_its_place(tmp_path, suffix, number):
    arguments = (*SMALL, "--output") if suffix == "png" else ("--no-render", "--save-mesh")
    target = tmp_path / f"result.{suffix}"
    target.write_bytes(OLD)
    process = start(tmp_path, *arguments, target.name, script=("-c", HELD))
    wait_until(process, lambda: temporaries(tmp_path))
    stop(process, number)
    left = temporaries(tmp_path)
    assert number == signal.SIGKILL or not left
    assert target.read_bytes() == OLD
    headless_ok(*QUICK, *arguments, target.name, cwd=tmp_path)
    assert target.read_bytes() != OLD
    assert sorted(tmp_path.iterdir()) == [target], "what the killed run has left is not cleaned up"


@pytest.mark.thorough(1)
@pytest.mark.parametrize("number", SIGNALS[::-1])
def test_stopped_while_a_picture_is_rendered(tmp_path, number):
    picture = tmp_path / "picture.png"
    picture.write_bytes(OLD)
    lasting = ("--samples", "65536", "--resolution", "1600", "540")
    process = start(tmp_path, *lasting, "--output", picture.name, "--save-mesh", "mesh.obj")
    wait_until(process, lambda: (tmp_path / "mesh.obj").exists())
    begin = processor_seconds(process.pid)
    # What comes between takes 0.3 s; then it renders, for hours.
    wait_until(process, lambda: processor_seconds(process.pid) > begin + 1.5)
    stop(process, number)
    assert picture.read_bytes() == OLD
    assert not temporaries(tmp_path)


def test_the_temporary_file_of_a_running_process_is_left_alone(tmp_path):
    target = tmp_path / "result.obj"
    process = start(tmp_path, "--no-render", "--save-mesh", target.name)
    wait_until(process, lambda: temporaries(tmp_path))
    process.send_signal(signal.SIGSTOP)
    left = temporaries(tmp_path)
    try:
        headless_ok(*QUICK, "--no-render", "--save-mesh", target.name, cwd=tmp_path)
        assert temporaries(tmp_path) == left
    finally:
        process.send_signal(signal.SIGCONT)
    process.communicate(timeout=PATIENCE)
    assert process.returncode == 0 and not temporaries(tmp_path)


@pytest.mark.thorough
def test_killed_at_any_moment(tmp_path):
    """Kill runs at moments spread evenly from the start to the end."""
    count = int(os.environ.get("CUBIC_CRAFT_KILLS", "2"))
    arguments = (*SMALL, "--save-mesh", "mesh.obj", "--report", "run.json")
    begin = time.monotonic()
    headless_ok(*QUICK, *arguments, cwd=tmp_path, run=headless)
    length = time.monotonic() - begin
    outputs = sorted(tmp_path.iterdir())
    for path in outputs:
        path.write_bytes(OLD)
    for number in range(count):
        process = start(tmp_path, *arguments)
        time.sleep(length * (number + 0.5) / count)
        process.send_signal(SIGNALS[number % 3])
        _, errors = process.communicate(timeout=PATIENCE)
        # Before the script has its own answer to Ctrl-C, that of Python is this one.
        assert "Traceback" not in errors or errors.endswith("KeyboardInterrupt\n"), errors
        for path in outputs:
            content = path.read_bytes()
            end = {".png": b"IEND\xaeB`\x82", ".json": b"}\n", ".obj": b"\n"}[path.suffix]
            assert content == OLD or content.endswith(end), path
    headless_ok(*QUICK, *arguments, cwd=tmp_path)
    assert sorted(tmp_path.iterdir()) == outputs
