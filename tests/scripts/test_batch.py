# SPDX-License-Identifier: GPL-3.0-or-later
"""A folder with sound and broken files: what is written, said and returned."""

import json
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest
from batch_kit import CUBE, MESHES, QUICK, batch, files_in, statuses
from headless import headless

CORPUS = Path(__file__).resolve().parents[1] / "corpus" / "files"
SOUND = ("doubled_corners.ply", "moebius.obj")
BROKEN = ("cut.stl", "too_huge.obj")


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    """Folder and process of a batch, two at a time, with a report."""
    folder = tmp_path_factory.mktemp("batch")
    (folder / "meshes" / "sub").mkdir(parents=True)
    for name in (*SOUND, *BROKEN):
        shutil.copy(CORPUS / name, folder / "meshes" / name)
    (folder / "meshes" / "notes.txt").write_text("no mesh")
    (folder / "meshes" / "._moebius.obj").write_text("what macOS puts beside a file")
    (folder / "meshes" / "sub" / "below.obj").write_text(CUBE)
    process = batch("meshes", "--jobs", 2, "--report", "report.json", cwd=folder)
    return folder, process


def test_sound_files_are_done_whatever_the_others_are(done):
    folder, process = done
    assert process.returncode == 3, process.stderr
    assert files_in(folder / "out") == ["doubled_corners.obj", "moebius.obj"]
    text = (folder / "out" / "moebius.obj").read_text()
    V = np.array([line.split()[1:4] for line in text.splitlines() if line[:2] == "v "], float)
    assert V.shape == (24, 3) and np.isfinite(V).all()


def test_the_report_has_all_files(done):
    folder, _ = done
    assert statuses(folder) == dict.fromkeys(SOUND, "done") | dict.fromkeys(BROKEN, "failed")
    report = json.loads((folder / "report.json").read_text())
    assert report["counts"] == {"done": 2, "kept": 0, "failed": 2} and report["unfinished"] == 0
    assert report["kinds_left_out"] == {".txt": 1}
    for each in report["files"]:
        if each["status"] == "failed":
            assert each["error"] and "\n" not in each["error"]
        else:
            (run,) = each["report"]["objects"][0]["runs"]
            assert np.isfinite(run["energy"]["total"])
            assert each["outputs"] == [Path(each["input"]).stem + ".obj"]


def test_each_file_has_a_line(done):
    _, process = done
    assert process.stdout == ""
    assert "Traceback" not in process.stderr
    lines = process.stderr.splitlines()
    assert "left out, of kinds that are not read: 1 .txt" in lines
    rows = dict(line.split(", ", 1)[1].split(": ", 1) for line in lines if line[1:7] == " of 4,")
    assert sorted(rows) == sorted((*SOUND, *BROKEN))
    assert rows["moebius.obj"].startswith("24 vertices, cubeness 0.4: ")
    assert rows["moebius.obj"].endswith(" s")
    assert all(rows[name].startswith("failed: ") for name in BROKEN)
    assert lines[-1] == "headless_render.py: 2 of 4 files failed"


@pytest.mark.thorough
def test_pictures_of_several_files_at_several_cubenesses(tmp_path):
    for name in ("one.obj", "two.obj"):
        (tmp_path / name).write_text(CUBE)
    process = batch(
        *("one.obj", "two.obj", "--cubeness", 0.1, 0.2, "--save-mesh", "_cubic.ply"),
        *("--turntable", 2, "--samples", 1, "--resolution", 32, 32),
        cwd=tmp_path,
        options=QUICK,
    )
    assert process.returncode == 0, process.stderr
    ends = ["_0001.png", "_0002.png", "_cubic_0.1.ply", "_cubic_0.2.ply"]
    assert files_in(tmp_path / "out") == [f"{name}{end}" for name in ("one", "two") for end in ends]


@pytest.mark.skipif(sys.platform == "win32", reason="it forbids such names")
def test_files_of_any_name_get_the_handles_and_options_and_say_what_is_left_out(tmp_path):
    names = ['[red]it\'s "$HOME" `ls`;#', "-lead [b] line\nbreak Größe 立方体 🧊"]
    folder, out = tmp_path / "-odd [red] folder", "-out 立"
    folder.mkdir()
    for name in names:
        (folder / f"{name}.obj").write_text(CUBE + "o dust\nv 5 5 5\nv 6 6 6\nl 9 10\n")
    handles = [{"vertices": [0, 1, 2, 3]}, {"vertices": [4, 5], "translate": [0, 0.5, 0]}]
    (tmp_path / "h.json").write_text(json.dumps(handles))
    options = ("--handles", tmp_path / "h.json", "--cubeness", 0)
    options += ("--orientation", "-0.00001", "-90.5", "0", "--jobs", 2)
    process = headless(".", f"--output-folder={out}", *options, *MESHES, cwd=folder)
    assert process.returncode == 0, process.stderr
    assert files_in(folder / out) == sorted(f"{name}.obj" for name in names)
    rows = [line for line in process.stderr.splitlines() if line[1:7] == " of 2,"]
    assert len(rows) == len(names), "each has one line"
    assert process.stderr.count('"dust" is left out') == 2
    original = [line.split()[1:4] for line in CUBE.splitlines() if line[:2] == "v "]
    for name in names:
        lines = (folder / out / f"{name}.obj").read_text().splitlines()
        V = np.array([line.split()[1:4] for line in lines if line[:2] == "v "], float)
        moved = V[:8] - np.array(original, float)
        np.testing.assert_allclose(moved[:4], 0.0, atol=1e-6)
        np.testing.assert_allclose(moved[4:6], [[0, 0.5, 0]] * 2, atol=1e-6)
