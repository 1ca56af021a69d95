# SPDX-License-Identifier: GPL-3.0-or-later
"""Many files, of which some are broken and one crashes, on a cluster whose workers are killed.

``CUBIC_CRAFT_BATCH=200`` takes so many files, with four workers, ten broken files and two kills.
"""

import json
import os
import random
import signal
import sys
import time

import numpy as np
import psutil
import pytest
from batch_kit import CUBE, cluster_of, files_in, files_of, start, statuses, wait_until_gone

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals are not sent there")

COUNT = int(os.environ.get("CUBIC_CRAFT_BATCH", "12"))
WORKERS, BROKEN, KILLS = (4, 10, 2) if COUNT >= 200 else (2, 1, 1)
CRASHES = "crashes.obj"


@pytest.fixture
def folder(tmp_path):
    """Return a folder with good files, broken ones, and one that is going to crash."""
    (tmp_path / "meshes").mkdir()
    for number in range(COUNT - BROKEN - 1):
        content = CUBE.replace("v 1 1 1", f"v 1 1 {1 + number / COUNT}")
        (tmp_path / "meshes" / f"good_{number:03}.obj").write_text(content)
    for number in range(BROKEN):
        (tmp_path / "meshes" / f"broken_{number:02}.ply").write_text("ply\nno header\n")
    (tmp_path / "meshes" / CRASHES).write_text(CUBE)
    return tmp_path


def workers_of(cluster):
    """Return the workers."""
    children = psutil.Process(cluster.pid).children()
    return [each for each in children if "spawn_main" in " ".join(each.cmdline())]


def crash(cluster):
    """Crash what does the file that is to crash, if it is being done."""
    for number in files_of(cluster):
        try:
            if any(word.endswith(CRASHES) for word in psutil.Process(number).cmdline()):
                os.kill(number, signal.SIGSEGV)
        except (psutil.NoSuchProcess, ProcessLookupError):
            pass


def watch(process, cluster, out):
    """Crash and kill until the batch ends; return what was killed, and when outputs were written.

    Returns
    -------
    killed : list of the numbers of files that a killed worker was doing
    written : {name: time when it was written first}
    """
    killed, written, files = [], {}, set()
    moments = sorted(random.sample(range(2, COUNT // 2), KILLS))  # in written files
    while process.poll() is None:
        try:
            files.update(files_of(cluster))
            crash(cluster)
            if len(killed) < KILLS and len(written) >= moments[len(killed)]:
                time.sleep(random.random() * (3 if COUNT >= 200 else 1))
                worker = random.choice(workers_of(cluster))
                killed.append([child.pid for child in worker.children()])
                worker.kill()
        except (psutil.NoSuchProcess, IndexError):
            pass  # it has just ended
        for path in out.glob("good_*.obj"):
            written.setdefault(path.name, path.stat().st_mtime_ns)
        time.sleep(0.05)
    wait_until_gone(files, 20)  # the last ones may be on their way out
    return killed, written


@pytest.mark.thorough
def test_lost_workers_cost_no_file(folder):
    begin = time.monotonic()
    with cluster_of(WORKERS, folder) as (address, cluster):
        arguments = ("--scheduler", address, "--report", "report.json")
        process = start("meshes", *arguments, cwd=folder)
        try:
            killed, written = watch(process, cluster, folder / "out")
            _, errors = process.communicate()
        finally:
            process.kill()
    seconds = time.monotonic() - begin
    assert process.returncode == 3, errors
    assert "Traceback" not in errors
    assert len(killed) == KILLS, "the batch was over before"
    good = {f"good_{number:03}.obj" for number in range(COUNT - BROKEN - 1)}
    broken = {f"broken_{number:02}.ply" for number in range(BROKEN)}
    failed = {*broken, CRASHES}
    assert statuses(folder) == dict.fromkeys(good, "done") | dict.fromkeys(failed, "failed")
    assert files_in(folder / "out") == sorted(good), "something half-written is left"
    for name, when in written.items():
        path = folder / "out" / name
        assert path.stat().st_mtime_ns == when, f"{name} is written twice"
        lines = path.read_text().splitlines()
        V = np.array([line.split()[1:4] for line in lines if line[:2] == "v "], float)
        assert V.shape == (8, 3) and np.isfinite(V).all()
        assert sum(line[:2] == "f " for line in lines) == 6
    assert len(list((folder / "out" / ".cubic_craft").iterdir())) == len(good)
    lines = errors.splitlines()
    assert sum(line.split(",")[0].endswith(f" of {COUNT}") for line in lines) == COUNT
    report = json.loads((folder / "report.json").read_text())
    errors = {each["input"]: each["error"] for each in report["files"] if "error" in each}
    assert all("cannot be read" in why or "crashed" in why for why in errors.values()), errors
    print(
        f"\n{COUNT} files, {WORKERS} workers, {seconds:.0f} s: {report['counts']};"
        f" killed workers had begun {killed}"
    )
