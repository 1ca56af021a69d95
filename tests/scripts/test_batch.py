# SPDX-License-Identifier: GPL-3.0-or-later
"""Many files: what is written, said and returned, what is kept, and what is refused at once."""

import json
import os
import shutil
import signal
import sys
from pathlib import Path

import numpy as np
import pytest
from batch_kit import CUBE, QUICK, batch, files_in, statuses
from headless import PATIENCE, headless_ok, headless_refused, start_headless
from scripts.cubic_craft.cubic_craft_addon.command_line.batch import jobs_of
from scripts.cubic_craft.cubic_craft_addon.command_line.options.arguments import parse
from scripts.cubic_craft.solver.console.many import one_by_one
from scripts.cubic_craft.solver.console.output import InputError

CORPUS = Path(__file__).resolve().parents[1] / "corpus" / "files"
SOUND = ("doubled_corners.ply", "moebius.obj")
BROKEN = ("cut.stl", "too_huge.obj")
NAMES = ["a.obj", "b.obj"]
on_posix = pytest.mark.skipif(sys.platform == "win32", reason="it has no such files and signals")


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    """Folder and process of a batch with a report."""
    folder = tmp_path_factory.mktemp("batch")
    (folder / "meshes" / "sub").mkdir(parents=True)
    for name in (*SOUND, *BROKEN):
        shutil.copy(CORPUS / name, folder / "meshes" / name)
    (folder / "meshes" / "notes.txt").write_text("no mesh")
    (folder / "meshes" / "._moebius.obj").write_text("what macOS puts beside a file")
    (folder / "meshes" / "sub" / "below.obj").write_text(CUBE)
    return folder, batch("meshes", "--report", "report.json", cwd=folder)


def test_sound_files_are_done_whatever_the_others_are(done):
    folder, process = done
    assert process.returncode == 3, process.stderr
    assert files_in(folder / "out") == ["doubled_corners.obj", "moebius.obj"]
    for name in ("doubled_corners.ply", "moebius.obj"):  # what was before leaves nothing behind
        alone = ("--no-render", "--save-mesh", "alone.obj")
        headless_ok(folder / "meshes" / name, *QUICK, *alone, cwd=folder)
        expected = (folder / "alone.obj").read_bytes()
        assert (folder / "out" / name).with_suffix(".obj").read_bytes() == expected


def test_the_report_has_all_files(done):
    folder, _ = done
    assert statuses(folder) == dict.fromkeys(SOUND, "done") | dict.fromkeys(BROKEN, "failed")
    report = json.loads((folder / "report.json").read_text())
    assert report["counts"] == {"done": 2, "kept": 0, "failed": 2} and report["unfinished"] == 0
    for each in report["files"]:
        if each["status"] == "failed":
            assert each["error"] and "\n" not in each["error"]
        else:
            (run,) = each["report"]["objects"][0]["runs"]
            assert np.isfinite(run["energy"]["total"])
            assert each["outputs"] == [str(folder / "out" / f"{Path(each['input']).stem}.obj")]


def test_each_file_has_a_line(done):
    _, process = done
    assert process.stdout == "" and "Traceback" not in process.stderr
    lines = process.stderr.splitlines()
    assert lines[0] == "left out, of kinds that are not read: 1 .txt"
    heads = [line for line in lines if line[1:7] == " of 4,"]
    assert heads == [f"{n} of 4, {name}" for n, name in enumerate(sorted((*SOUND, *BROKEN)), 1)]
    begin = "headless_render.py: error: meshes/"
    failed = [line for line in lines if line.startswith(begin)]
    assert [line.removeprefix(begin).partition(":")[0] for line in failed] == list(BROKEN)
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


def test_what_is_there_and_newer_is_kept(tmp_path):
    (tmp_path / "meshes").mkdir()
    paths = [tmp_path / "meshes" / name for name in NAMES]
    for path in paths:
        path.write_text(CUBE)
        os.utime(path, (0, 0))

    def run(*words):
        process = batch("meshes", "--report", "report.json", *words, cwd=tmp_path)
        assert process.returncode == 0, process.stderr
        return list(statuses(tmp_path).values())

    assert run() == ["done", "done"]
    written = (tmp_path / "out" / "a.obj").stat().st_mtime_ns
    os.utime(paths[1])
    os.utime(tmp_path / "out" / "b.obj", (1, 1))
    assert run() == ["kept", "done"]
    (tmp_path / "out" / "b.obj").unlink()
    assert run() == ["kept", "done"]
    assert (tmp_path / "out" / "a.obj").stat().st_mtime_ns == written
    assert run("--force") == ["done", "done"]


@on_posix
def test_interrupted_it_goes_on_where_it_was(tmp_path):
    for name in NAMES:
        (tmp_path / name).write_text(CUBE)
    endless = ("--tolerance", "1e-12", "--max-iterations", "1000000", "--device", "numpy")
    outputs = ("--output-folder", "out", "--no-render", "--save-mesh", ".obj")
    report = ("--report", "report.json")
    batch("a.obj", cwd=tmp_path)
    process = start_headless(*NAMES, *outputs, *endless, *report, cwd=tmp_path)
    while not process.stderr.readline().startswith("2 of 2, b.obj"):
        assert process.poll() is None
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=PATIENCE)
    assert (process.returncode, errors) == (130, "headless_render.py: interrupted\n")
    assert statuses(tmp_path) == {"a.obj": "kept"} and files_in(tmp_path / "out") == ["a.obj"]
    assert json.loads((tmp_path / "report.json").read_text())["unfinished"] == 1


def test_whatever_is_wrong_with_a_job_the_next_is_done(tmp_path, capsys):
    def work(number):
        if number < 2:
            raise (InputError, KeyError)[number]("why")
        return {"made": number}

    said, report = [], tmp_path / "r.json"
    jobs = [(f"{number}.obj", number) for number in range(3)]
    assert one_by_one(jobs, work, said.append, report) == 3
    assert said == ["error: why", "error: 1.obj: KeyError: 'why'", "2 of 3 files failed"]
    assert capsys.readouterr().err.startswith("Traceback")
    files = json.loads(report.read_text())["files"]
    assert files[2] == {"input": "2.obj", "status": "done", "made": 2}
    assert one_by_one(jobs[:1], work, said.append, None) == 2
    assert one_by_one(jobs[2:], work, said.append, None) == 0
    assert one_by_one(jobs[2:], work, said.append, tmp_path / "none" / "r.json") == 3
    assert "r.json" in said[-1]


# What is decided without Blender -----------------------------------------------------------------


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("a.obj", "sub/a.obj", "other/A.obj", "other/b.ply", "above/below/d.obj"):
        Path(name).parent.mkdir(exist_ok=True, parents=True)
        Path(name).write_text(CUBE)
    Path("h.json").write_text('[{"vertices": [0]}]')
    Path("notes.txt").write_text("no mesh")
    Path("empty").mkdir()
    Path("empty/scene.max").write_text("no mesh")
    os.mkfifo("pipe.obj")
    return tmp_path


def jobs(*words):
    return jobs_of(parse([*words, "--output-folder", "out"]))


def test_each_file_has_the_options_as_if_it_were_alone(folder):
    words = ("--handles", "h.json", "--save-mesh", "_c.glb", "--low-poly", "90", "--cubeness", "2")
    (job,) = jobs("a.obj", *words)
    out = folder / "out"
    assert job.options.handles[0].vertices == (0,) and job.options.cubeness == [2.0]
    assert (job.options.input, job.options.output) == (Path("a.obj"), out / "a.png")
    assert job.outputs == [out / "a.png", out / "a_c.glb", out / "a_c_lod1.glb"]
    (job,) = jobs("a.obj", "--bake", "_c.abc", "--frames", "2", "5")
    assert job.options.frames == [2, 5] and job.outputs == [out / "a_c.abc"]
    (job,) = jobs("a.obj", "--no-render", "--report", "r.json")
    assert job.outputs == [] and job.options.report is None


IN_FULL = (
    "--crispness 0 --solidity 0 --keep-pose off --detail 0 --keep-apart off"
    " --together off --refine off --rotation free --symmetry off --hold-rest off"
)


def test_the_paper_is_its_options_in_full(folder):
    in_full = IN_FULL.split()

    def read(*words):
        return vars(parse(["a.obj", *words])) | {"paper": None}

    assert read("--paper") == read(*in_full) != read()
    beside = read("--paper", "--rotation", "keep", "--solidity", "0.1")
    assert (beside["rotation"], beside["solidity"], beside["together"]) == ("keep", 0.1, "off")
    without_one = [read(*in_full[:k], *in_full[k + 2 :]) for k in range(0, len(in_full), 2)]
    assert all(each != read("--paper") for each in without_one)


def test_names_of_results(folder):
    def names(*words):
        found = jobs(*words, "--no-render", "--save-mesh", ".ply")
        return {str(j.path): j.outputs[0].relative_to(folder / "out").as_posix() for j in found}

    assert names("a.obj", "./a.obj", "other/b.ply") == {"a.obj": "a.ply", "other/b.ply": "b.ply"}
    for taken in ("out/a.obj", "sub/A.ply"):
        (folder / taken).write_text(CUBE)
    (folder / "pipe.obj").unlink()
    assert names(".", "--recursive") == {
        "a.obj": "a.ply",
        "above/below/d.obj": "above/below/d.ply",
        "other/A.obj": "other/A.ply",
        "other/b.ply": "other/b.ply",
        "sub/A.ply": "sub/A_ply.ply",
        "sub/a.obj": "sub/a_obj.ply",
    }
    with pytest.raises(InputError, match="would have the names of"):
        names("a.obj", "other")  # a and A are the same where case does not count


@on_posix
def test_what_is_no_file_is_not_read(folder, capsys):
    os.mkfifo(folder / "sub" / "pipe.obj")
    (folder / "sub" / "zero.ply").symlink_to("/dev/zero")
    (folder / "sub" / "link.obj").symlink_to(folder / "other" / "b.ply")
    for name in ("b.max", "c.max", "README", ".DS_Store", ".hidden.obj"):
        (folder / "sub" / name).write_text("no mesh")
    assert [str(job.path) for job in jobs("sub")] == ["sub/a.obj", "sub/link.obj"]
    assert capsys.readouterr().err.endswith("not read: 2 .max, 1 without a suffix\n")


TO = ("--output-folder", "out")
# arguments, and what the one line must name
REFUSALS = {
    "folder of nothing": (["empty", *TO], ["empty", "no meshes", "only 1 .max", ".obj"]),
    "folder of folders": (["above", *TO], ["above", "no meshes", "--recursive"]),
    "empty all the way": (["empty", *TO, "--recursive"], ["empty", "no meshes"]),
    "no output folder": (["sub"], ["sub", "folder", "--output-folder"]),
    "files, no folder": (["a.obj", "other/b.ply"], ["several", "--output-folder"]),
    "no input": ([*TO], ["--output-folder", "give the files"]),
    "missing file": (["a.obj", "none.obj", *TO], ["none.obj", "no such file"]),
    "a pipe": (["a.obj", "pipe.obj", *TO], ["pipe.obj", "a device or a pipe"]),
    "a pipe alone": (["pipe.obj"], ["pipe.obj", "a device or a pipe"]),
    "unknown format": (["a.obj", "notes.txt", *TO], ["notes.txt", ".txt", ".obj"]),
    "the folder is a file": (["a.obj", "--output-folder", "h.json"], ["--output-folder", "h.json"]),
    "below a file": (["a.obj", "--output-folder", "h.json/x"], ["--output-folder", "h.json"]),
    "not writable": (["a.obj", "--output-folder", "/proc/x"], ["--output-folder", "/proc"]),
    "nothing to do": (["sub", *TO, "--no-render"], ["--no-render", "--save-mesh"]),
    "one picture": (["sub", *TO, "--output", "a.png"], ["--output", "one file"]),
    "one name twice": (["a.obj", "sub/a.obj", *TO], ["sub/a.obj", "rename"]),
    "a name, no ending": (["sub", *TO, "--save-mesh", "a.obj"], ["--save-mesh", "_cubic.obj"]),
    "a path, no ending": (["sub", *TO, "--save-mesh", "./_a.obj"], ["--save-mesh", "_cubic"]),
    "no format": (["sub", *TO, "--save-mesh", "_cubic"], ["--save-mesh", ".ply"]),
    "gltf": (["sub", *TO, "--save-mesh", ".gltf"], ["--save-mesh", ".gltf", ".glb"]),
    "levels without files": (["sub", *TO, "--low-poly", "100"], ["--low-poly", "--save-mesh"]),
    "levels of nothing": (
        ["sub", *TO, "--low-poly", "100", "--save-mesh", ".obj"],
        ["--low-poly", ".glb or .fbx"],
    ),
    "into the inputs": (
        ["sub", "--output-folder", "sub", "--save-mesh", "_c.obj"],
        ["--output-folder", "sub", "inputs"],
    ),
    "over an input": (
        ["a.obj", "--output-folder", ".", "--save-mesh", ".obj"],
        ["a.obj", "input", "--output-folder"],
    ),
    "report format": (["sub", *TO, "--report", "a.txt"], ["--report", "a.txt", ".json"]),
    "report nowhere": (["sub", *TO, "--report", "no/a.json"], ["--report", "no", "create"]),
    "force for one": (["a.obj", "--force"], ["--force", "--output-folder"]),
    "recursive for one": (["a.obj", "--recursive"], ["--recursive", "--output-folder"]),
    "no handles": (["sub", *TO, "--handles", "none.json"], ["--handles", "none.json"]),
}


@pytest.mark.parametrize("case", REFUSALS)
def test_refusal(folder, case):
    arguments, words = REFUSALS[case]
    headless_refused(*arguments, words=words, cwd=folder)
