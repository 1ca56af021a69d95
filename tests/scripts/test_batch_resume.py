# SPDX-License-Identifier: GPL-3.0-or-later
"""Batches that are stopped and what the next run does again."""

import json
import os
import signal
import sys

import pytest
from batch_kit import (
    CUBE,
    ENDLESS,
    batch,
    files_in,
    files_of,
    start,
    statuses,
    wait_for_files,
    wait_until_gone,
    wait_until_they_solve,
    waves,
)
from headless import PATIENCE

on_posix = pytest.mark.skipif(sys.platform == "win32", reason="signals are not sent there")
CALM = {signal.SIGINT: "interrupted", signal.SIGTERM: "told to end"}
NAMES = ["a.obj", "b.obj"]


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "meshes").mkdir()
    for name in NAMES:
        (tmp_path / "meshes" / name).write_text(CUBE)
    return tmp_path


def run(folder, *arguments):
    """Run the batch to its end; return {name: status}."""
    process = batch("meshes", "--report", "report.json", *arguments, cwd=folder)
    assert process.returncode == 0, process.stderr
    return statuses(folder)


def test_only_what_has_changed_is_done_again(folder):
    assert run(folder) == dict.fromkeys(NAMES, "done")
    written = (folder / "out" / "a.obj").stat().st_mtime_ns
    os.utime(folder / "meshes" / "a.obj", (0, 0))  # copied, but the same
    (folder / "out" / "b.obj").write_text("cut off")
    assert run(folder) == {"a.obj": "kept", "b.obj": "done"}
    assert (folder / "out" / "a.obj").stat().st_mtime_ns == written
    (folder / "meshes" / "a.obj").write_text(CUBE.replace("v 1 1 1", "v 1 1 2"))
    assert run(folder) == {"a.obj": "done", "b.obj": "kept"}


@pytest.mark.thorough(1)
@on_posix
@pytest.mark.parametrize("number", [*CALM, signal.SIGKILL])
def test_stopped_in_the_middle(folder, number):
    process = start("meshes", "--report", "report.json", cwd=folder)
    assert process.stderr.readline().startswith("1 of 2, a.obj: ")
    (worker,) = wait_for_files(process)
    process.send_signal(number)
    _, errors = process.communicate(timeout=PATIENCE)
    if number == signal.SIGKILL:
        assert process.returncode == -number
    else:
        assert process.returncode == 128 + number
        assert errors == f"headless_render.py: {CALM[number]}\n"
    wait_until_gone([worker])
    assert set(files_in(folder / "out")) <= set(NAMES), "something half-written is left"
    report = json.loads((folder / "report.json").read_text())
    assert statuses(folder) == {"a.obj": "done"} and report["unfinished"] == 1
    assert run(folder) == {"a.obj": "kept", "b.obj": "done"}
    assert files_in(folder / "out") == NAMES


@on_posix
def test_all_workers_end_with_the_batch(folder):
    for name in NAMES:
        (folder / "meshes" / name).write_text(waves(200))
    process = start("meshes", "--jobs", "2", cwd=folder, options=ENDLESS)
    workers = wait_for_files(process, 2)
    wait_until_they_solve(workers)
    assert files_of(process) == workers
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=PATIENCE)
    assert (process.returncode, errors) == (130, "headless_render.py: interrupted\n")
    wait_until_gone(workers)
    assert files_in(folder / "out") == []


@pytest.mark.thorough(1)
@on_posix
@pytest.mark.parametrize(
    ("number", "word"), [(signal.SIGSEGV, "crashes"), (signal.SIGKILL, "ended from outside")]
)
def test_a_worker_that_dies_is_a_file_that_failed(folder, number, word):
    process = start("meshes", cwd=folder)
    (worker,) = wait_for_files(process)
    os.kill(worker, number)
    _, errors = process.communicate(timeout=PATIENCE)
    assert process.returncode == 3, errors
    lines = errors.splitlines()
    assert lines[0].startswith("1 of 2, a.obj: failed: ") and word in lines[0]
    assert lines[-1] == "headless_render.py: 1 of 2 files failed"
    assert files_in(folder / "out") == ["b.obj"]
    assert run(folder) == {"a.obj": "done", "b.obj": "kept"}
