# SPDX-License-Identifier: GPL-3.0-or-later
"""Batches on a Dask cluster: a scheduler and workers that were started by themselves, elsewhere."""

import signal
import sys
import time

import pytest
from batch_kit import (
    CUBE,
    ENDLESS,
    batch,
    cluster_of,
    files_in,
    files_of,
    start,
    statuses,
    wait_for_files,
    wait_until_they_solve,
    waves,
)
from headless import PATIENCE

NAMES = ["a.obj", "b.obj", "c.obj"]


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    """Return the address of a cluster, and the process of its workers."""
    with cluster_of(2, tmp_path_factory.mktemp("cluster")) as found:
        yield found


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "meshes").mkdir()
    for name in NAMES:
        (tmp_path / "meshes" / name).write_text(CUBE)
    return tmp_path


def test_a_batch_on_a_cluster(folder, cluster):
    (folder / "meshes" / "broken.ply").write_text("nothing")
    (folder / "h.json").write_text('[{"vertices": [0, 1, 2, 3]}]')
    arguments = ("--scheduler", cluster[0], "--handles", "h.json", "--report", "report.json")
    done = dict.fromkeys(NAMES, "done") | {"broken.ply": "failed"}
    for expected in (done, {name: done[name].replace("done", "kept") for name in done}):
        process = batch("meshes", *arguments, cwd=folder)
        assert process.returncode == 3, process.stderr
        assert "Traceback" not in process.stderr
        assert statuses(folder) == expected
        assert files_in(folder / "out") == NAMES


@pytest.mark.thorough
@pytest.mark.skipif(sys.platform == "win32", reason="signals are not sent there")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGKILL])
def test_files_of_a_batch_that_is_stopped_are_given_up(folder, cluster, number):
    address, worker = cluster
    for name in NAMES:
        (folder / "meshes" / name).write_text(waves(200))
    process = start("meshes", "--scheduler", address, cwd=folder, options=ENDLESS)
    wait_until_they_solve(wait_for_files(worker, 2))
    assert process.poll() is None
    process.send_signal(number)
    _, errors = process.communicate(timeout=PATIENCE)
    if number == signal.SIGINT:
        assert (process.returncode, errors) == (130, "headless_render.py: interrupted\n")
    end = time.monotonic() + PATIENCE
    while files_of(worker):
        assert time.monotonic() < end, "they go on without their batch"
        time.sleep(0.1)
    assert files_in(folder / "out") == []
    for name in NAMES[1:]:
        (folder / "meshes" / name).unlink()
    again = batch("meshes", "--scheduler", address, "--report", "report.json", cwd=folder)
    assert again.returncode == 0, again.stderr
    assert statuses(folder) == {NAMES[0]: "done"}
