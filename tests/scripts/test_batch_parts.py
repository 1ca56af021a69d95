# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of batches, without Blender."""

import json
import os
import sys
from pathlib import Path

import pytest
from batch_kit import CUBE
from scripts.cubic_craft.cubic_craft_addon.command_line.batch.sources import find_sources
from scripts.cubic_craft.cubic_craft_addon.command_line.batch.task import (
    Job,
    do,
    job_of,
    key_of,
)
from scripts.cubic_craft.cubic_craft_addon.command_line.options.arguments import Worker, parse
from scripts.cubic_craft.solver.console.output import InputError
from scripts.cubic_craft.solver.console.report import in_words


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("a.obj", "sub/a.obj", "other/A.obj", "other/b.ply"):
        Path(name).parent.mkdir(exist_ok=True)
        Path(name).write_text(CUBE)
    Path("h.json").write_text('[{"vertices": [0]}]')
    return tmp_path


def batch_options(*words):
    return parse(["a.obj", "--output-folder", "out", *words])


def in_a_worker(options, *words):
    """Return the options that a process has for the first file of a batch."""
    sources, _ = find_sources(options.inputs, False, options.output_folder)
    job = job_of(options, *next(iter(sources.items())))
    for path in (*job.outputs, job.record):
        path.parent.mkdir(parents=True, exist_ok=True)
    worker = json.dumps(Worker(str(job.path), job.name, "key"))
    return parse([f"--worker={worker}", "a.obj", "--output-folder", "out", *words]), job


def test_a_process_has_the_options_for_its_file(folder):
    words = ("--handles", "h.json", "--save-mesh", "_c.glb", "--low-poly", "90", "--cubeness", "2")
    there, job = in_a_worker(batch_options(*words), *words)
    out = folder / "out"
    assert there.handles[0].vertices == (0,) and there.cubeness == [2.0]
    assert there.input == folder / "a.obj" and there.output_folder is None
    assert job.outputs == (out / "a.png", out / "a_c.glb", out / "a_c_lod1.glb")
    assert there.report == job.record == out / ".cubic_craft" / "a.json"
    words = ("--bake", "_c.abc", "--frames", "2", "5")
    baked, job = in_a_worker(batch_options(*words), *words)
    assert baked.frames == [2, 5] and job.outputs == (out / "a_c.abc",)
    words = ("--no-render", "--report", "r.json")
    without, _ = in_a_worker(batch_options(*words), *words)
    assert without.no_render and without.output is None


IN_FULL = (
    "--crispness 0 --solidity 0 --keep-pose off --detail 0 --keep-apart off"
    " --together off --refine off --rotation free --symmetry off --hold-rest off"
)
BY_DEFAULT = (
    "--crispness 0.9 --solidity 0.3 --keep-pose on --detail 0.05 --keep-apart on"
    " --together selection --refine auto --rotation keep --symmetry auto --hold-rest on"
)


def test_the_paper_is_its_options_in_full(folder):
    def key(*words):
        return key_of(folder / "a.obj", batch_options(*words), "1")

    in_full = IN_FULL.split()
    assert key("--paper") == key(*in_full) != key() == key(*BY_DEFAULT.split())
    beside = batch_options("--paper", "--rotation", "keep", "--solidity", "0.1")
    assert (beside.rotation, beside.solidity, beside.together) == ("keep", 0.1, "off")
    keys = {key(*in_full[:k], *in_full[k + 2 :]) for k in range(0, len(in_full), 2)}
    assert len(keys | {key("--paper")}) == 11, "each of them decides about the result"


def names(*inputs, is_recursive=False):
    sources, _ = find_sources([Path(name) for name in inputs], is_recursive, Path("out"))
    return {path.relative_to(Path.cwd()).as_posix(): name for name, path in sources.items()}


def test_names_of_results(folder):
    assert names("a.obj", "./a.obj", "other/b.ply") == {"a.obj": "a", "other/b.ply": "b"}
    assert names(".", is_recursive=True) == {
        "a.obj": "a",
        "other/A.obj": "other/A",
        "other/b.ply": "other/b",
        "sub/a.obj": "sub/a",
    }
    (folder / "sub" / "A.ply").write_text(CUBE)
    assert names("sub") == {"sub/a.obj": "a_obj", "sub/A.ply": "A_ply"}
    with pytest.raises(InputError, match="would have the names of"):
        names("a.obj", "other")  # a and A are the same where case does not count


def test_results_are_not_taken_for_inputs(folder):
    (folder / "out").mkdir()
    (folder / "out" / "a.obj").write_text(CUBE)
    assert "out/a.obj" not in names(".", is_recursive=True)


@pytest.mark.skipif(sys.platform == "win32", reason="it has no pipes")
def test_what_is_no_file_is_not_read(folder):
    os.mkfifo(folder / "sub" / "pipe.obj")
    (folder / "sub" / "zero.ply").symlink_to("/dev/zero")
    (folder / "sub" / "link.obj").symlink_to(folder / "other" / "b.ply")
    for name in ("b.max", "c.max", "README", ".DS_Store", ".hidden.obj"):
        (folder / "sub" / name).write_text("no mesh")
    sources, kinds = find_sources([folder / "sub"], False, folder / "out")
    assert list(sources) == ["a", "link"]
    assert in_words(kinds) == "2 .max, 1 without a suffix"


def test_the_key_changes_with_all_that_decides_about_the_result(folder):
    def key(*words, version="1"):
        return key_of(folder / "a.obj", batch_options(*words), version)

    keys = [key(), key(version="2"), key("--cubeness", "0.5"), key("--save-mesh", ".obj")]
    keys += [key("--save-mesh", ".ply"), key("--handles", "h.json")]
    (folder / "h.json").write_text('[{"vertices": [1]}]')
    keys.append(key("--handles", "h.json"))
    same = [key("--verbose"), key("--jobs", "3"), key("--threads", "1"), key("--force")]
    assert same == [keys[0]] * 4
    (folder / "a.obj").write_text(CUBE + "# another\n")
    keys.append(key())
    assert len(set(keys)) == len(keys)


WRITES = """
import json, os, pathlib, sys
pathlib.Path("a.png").write_bytes(b"picture")
made = {"for": sys.argv[-1], "sizes": {"a.png": 7}}
limits = ("OMP_NUM_THREADS", "TI_CPU_MAX_NUM_THREADS", "QD_CPU_MAX_NUM_THREADS")
threads = "/".join({os.environ[name] for name in limits})
about = {"threads": threads, "seconds": {"total": 1.5}, "made": made}
pathlib.Path("record.json").write_text(json.dumps(about))
print("a warning", file=sys.stderr)
"""


def done(folder, code, *words, key="key"):
    """Return what `do` does, with this code in a Python in place of the script."""
    job = Job(folder / "a.obj", "a", (folder / "a.png",), folder / "record.json")
    options = batch_options("--threads", "3", *words)
    return do(job, options, [sys.executable, "-c", code, key], key)


def test_what_is_done_counts_with_its_key_and_outputs_only(folder):
    (folder / "record.json").write_text("[" * 100_000)  # of something else
    about = {"seconds": 1.5, "report": {"threads": "3", "seconds": {"total": 1.5}}}
    is_done = {"status": "done", **about, "words": "a warning\n"}
    is_kept = {"status": "kept", **about}
    assert done(folder, WRITES) == is_done
    assert done(folder, WRITES) == is_kept
    assert done(folder, WRITES, "--force") == is_done
    assert done(folder, WRITES, key="another") == is_done
    assert done(folder, WRITES) == is_done
    (folder / "a.png").write_bytes(b"pict")
    assert done(folder, WRITES) == is_done
    (folder / "a.png").unlink()
    assert done(folder, WRITES) == is_done
    assert done(folder, WRITES) == is_kept


@pytest.mark.parametrize(
    ("code", "error"),
    [
        ("print('x\\nheadless_render.py: error: of it', file=sys.stderr); 1/0", "of it"),
        ("1/0", "ended with exit code 1: ZeroDivisionError: division by zero"),
        ("sys.exit(7)", "ended with exit code 7: without a word"),
        ("pass", "its results are not those that its process has written"),
        ("sys.stdin.read()", "takes longer than 1 seconds (--timeout)"),
    ],
)
def test_why_a_file_failed(folder, code, error):
    result = done(folder, f"import sys; {code}", "--timeout", "1")
    assert (result["status"], result["error"]) == ("failed", error)
