# SPDX-License-Identifier: GPL-3.0-or-later
"""A folder with sound and broken files: what is written, said and returned."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from batch_kit import CUBE, QUICK, batch, files_in, statuses

CORPUS = Path(__file__).resolve().parents[1] / "corpus" / "files"
SOUND = ("doubled_corners.ply", "loose.obj", "moebius.obj")
BROKEN = ("cut.stl", "cut_faces.ply", "too_huge.obj")


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    """Folder and process of a batch, two at a time, with a report."""
    folder = tmp_path_factory.mktemp("batch")
    (folder / "meshes" / "sub").mkdir(parents=True)
    for name in (*SOUND, *BROKEN):
        shutil.copy(CORPUS / name, folder / "meshes" / name)
    (folder / "meshes" / "notes.txt").write_text("no mesh")
    (folder / "meshes" / "._loose.obj").write_text("what macOS puts beside a file")
    (folder / "meshes" / "sub" / "below.obj").write_text(CUBE)
    process = batch("meshes", "--jobs", 2, "--report", "report.json", cwd=folder)
    return folder, process


def test_sound_files_are_done_whatever_the_others_are(done):
    folder, process = done
    assert process.returncode == 3, process.stderr
    assert files_in(folder / "out") == ["doubled_corners.obj", "loose.obj", "moebius.obj"]
    text = (folder / "out" / "moebius.obj").read_text()
    V = np.array([line.split()[1:4] for line in text.splitlines() if line[:2] == "v "], float)
    assert V.shape == (24, 3) and np.isfinite(V).all()


def test_the_report_has_all_files(done):
    folder, _ = done
    assert statuses(folder) == dict.fromkeys(SOUND, "done") | dict.fromkeys(BROKEN, "failed")
    report = json.loads((folder / "report.json").read_text())
    assert report["counts"] == {"done": 3, "kept": 0, "failed": 3} and report["unfinished"] == 0
    assert report["kinds_left_out"] == {".txt": 1}
    for each in report["files"]:
        if each["status"] == "failed":
            assert each["error"] and "\n" not in each["error"]
        else:
            (run,) = each["report"]["objects"][0]["runs"]
            assert np.isfinite(run["energy"]["total"])
            assert 0.01 < each["peak_gb"] == each["report"]["peak_gb"] < 100
            assert each["outputs"] == [Path(each["input"]).stem + ".obj"]


def test_a_report_of_lines_has_one_for_each_file_as_soon_as_it_is_done(tmp_path):
    (tmp_path / "a.obj").write_text(CUBE)
    (tmp_path / "b.obj").write_text("v 0 0 0\n")
    (tmp_path / "lines.jsonl").write_text("of an earlier run\n")
    process = batch("a.obj", "b.obj", "--report", "lines.jsonl", cwd=tmp_path)
    assert process.returncode == 3, process.stderr
    rows = [json.loads(row) for row in (tmp_path / "lines.jsonl").read_text().splitlines()]
    assert [Path(row["input"]).name for row in rows] == ["a.obj", "b.obj"]
    assert (rows[0]["outputs"], rows[1]["status"]) == (["a.obj"], "failed")


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


def test_every_file_gets_the_handles_and_options_and_says_what_is_left_out(tmp_path):
    for name in ("one.obj", "two.obj"):
        (tmp_path / name).write_text(CUBE + "o dust\nv 5 5 5\nv 6 6 6\nl 9 10\n")
    handles = [{"vertices": [0, 1, 2, 3]}, {"vertices": [4, 5], "translate": [0, 0.5, 0]}]
    (tmp_path / "h.json").write_text(json.dumps(handles))
    options = ("--handles", "h.json", "--cubeness", 0, "--orientation", "-0.00001", "-90.5", "0")
    process = batch("one.obj", "two.obj", *options, cwd=tmp_path)
    assert process.returncode == 0, process.stderr
    for name in ("one", "two"):
        lines = (tmp_path / "out" / f"{name}.obj").read_text().splitlines()
        V = np.array([line.split()[1:4] for line in lines if line[:2] == "v "], float)
        original = [line.split()[1:4] for line in CUBE.splitlines() if line[:2] == "v "]
        moved = V[:8] - np.array(original, float)
        np.testing.assert_allclose(moved[:4], 0.0, atol=1e-6)
        np.testing.assert_allclose(moved[4:6], [[0, 0.5, 0]] * 2, atol=1e-6)
        assert f'{name}.obj: "dust" is left out' in process.stderr
