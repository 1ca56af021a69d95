# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of batches, without Blender."""

import io
import os
import sys
from pathlib import Path

import pytest
from batch_kit import CUBE
from scripts.cubic_craft.cubic_craft_addon.command_line.batch.plan import (
    OF_THE_BATCH,
    Job,
    decisive,
    plan,
    settings_of,
)
from scripts.cubic_craft.cubic_craft_addon.command_line.batch.sources import find_sources
from scripts.cubic_craft.cubic_craft_addon.command_line.batch.task import Batch, do, key_of
from scripts.cubic_craft.cubic_craft_addon.command_line.options.arguments import parse
from scripts.cubic_craft.cubic_craft_addon.command_line.process.watched_process import Limits
from scripts.cubic_craft.solver.console.report import in_words

ALL_OPTIONS = """--cubeness 0.1 1e-05 --orientation -0.00001 2.5 -90 --pin=-a --map=-m
    --form directions --form-sides 5 --form-weights 1 2 0 --form-object other/A.obj
    --region top:prism5:0.3
    --capture other/b.ply --capture-strength 0.7
    --form-directions 0,0,1
    --space object --crispness 0.2 --solidity 0 --keep-pose off --detail 0.2 --detail-strength 2
    --detail-map g --keep-apart off
    --together parts --refine off --rotation free --symmetry zx --floor on --hold-rest off
    --with-modifiers
    --max-iterations 7 --tolerance 1e-12 --device numpy --handles h.json
    --engine workbench --samples 3 --resolution 32 33 --turn -90 0 -0.0000001 --turntable 4
    --object=-o --verbose --save-mesh .glb --low-poly 900 90 --view 9"""


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


def in_a_worker(options, monkeypatch):
    """Return the options that a worker has for the first file of a batch."""
    found = find_sources(options.inputs, False, options.output_folder)
    (job, *_) = plan(options, found.sources)
    job.record.parent.mkdir(parents=True, exist_ok=True)
    monkeypatch.setattr("sys.stdin", io.StringIO(settings_of(options) + "\n"))
    return parse([*job.arguments, "--worker=key"])


def test_every_option_reaches_the_workers_as_it_was_given(folder, monkeypatch):
    options, defaults = batch_options(*ALL_OPTIONS.split()), batch_options()
    there = in_a_worker(options, monkeypatch)
    for name in set(vars(options)) - OF_THE_BATCH - {"no_render", "frames"}:
        assert getattr(options, name) != getattr(defaults, name), f"{name} is not tried here"
        assert getattr(there, name) == getattr(options, name)
    assert there.handles[0].vertices == options.handles[0].vertices == (0,)
    assert there.form_object == folder / "other" / "A.obj"
    baked = in_a_worker(batch_options("--bake", "_c.abc", "--frames", "2", "5"), monkeypatch)
    assert baked.frames == [2, 5] and baked.bake == folder / "out" / "a_c.abc"
    assert there.capture == folder / "other" / "b.ply"
    assert there.input == folder / "a.obj" and there.save_mesh == folder / "out" / "a.glb"
    assert there.output == folder / "out" / "a.png"
    without = in_a_worker(batch_options("--no-render", "--report", "r.json"), monkeypatch)
    assert without.no_render and without.output is None


IN_FULL = (
    "--crispness 0 --solidity 0 --keep-pose off --detail 0 --keep-apart off"
    " --together off --refine off --rotation free --symmetry off --hold-rest off"
)
BY_DEFAULT = (
    "--crispness 0.9 --solidity 0.3 --keep-pose on --detail 0.05 --keep-apart on"
    " --together selection --refine auto --rotation keep --symmetry auto --hold-rest on"
)


def test_the_paper_is_its_options_in_full(folder, monkeypatch):
    def key(*words):
        return key_of(folder / "a.obj", decisive(batch_options(*words), "1"))

    in_full = IN_FULL.split()
    assert settings_of(batch_options("--paper")) == settings_of(batch_options(*in_full))
    assert key("--paper") == key(*in_full) != key() == key(*BY_DEFAULT.split())
    there = in_a_worker(batch_options("--paper"), monkeypatch)
    assert (there.solidity, there.together, there.refine) == (0.0, "off", "off")
    assert (there.rotation, there.hold_rest) == ("free", "off")
    assert (there.keep_pose, there.detail, there.keep_apart) == ("off", 0.0, "off")
    beside = batch_options("--paper", "--rotation", "keep", "--solidity", "0.1")
    assert (beside.rotation, beside.solidity, beside.together) == ("keep", 0.1, "off")
    keys = {key(*in_full[:k], *in_full[k + 2 :]) for k in range(0, len(in_full), 2)}
    assert len(keys | {key("--paper")}) == 11, "each of them decides about the result"


def names(*inputs, is_recursive=False):
    found = find_sources([Path(name) for name in inputs], is_recursive, Path("out"))
    return {source.path.relative_to(Path.cwd()).as_posix(): source.name for source in found.sources}


def test_names_of_results(folder):
    assert names("a.obj", "other") == {
        "a.obj": f"{folder.name}/a_obj",
        "other/A.obj": "other/A_obj",
        "other/b.ply": "b",
    }, "a and A are the same where case does not count"
    assert names("sub", "a.obj", "./a.obj") == {
        "sub/a.obj": "sub/a_obj",
        "a.obj": f"{folder.name}/a_obj",
    }
    assert names(".", is_recursive=True) == {
        "a.obj": "a",
        "other/A.obj": "other/A",
        "other/b.ply": "other/b",
        "sub/a.obj": "sub/a",
    }
    assert names("sub/a.obj") == {"sub/a.obj": "a"}
    (folder / "sub" / "a.ply").write_text(CUBE)
    assert names("sub") == {"sub/a.obj": "a_obj", "sub/a.ply": "a_ply"}


def test_the_key_changes_with_all_that_decides_about_the_result(folder):
    def key(*words, version="1"):
        return key_of(folder / "a.obj", decisive(batch_options(*words), version))

    keys = [key(), key(version="2"), key("--cubeness", "0.5"), key("--save-mesh", ".obj")]
    keys += [key("--save-mesh", ".ply"), key("--handles", "h.json")]
    (folder / "h.json").write_text('[{"vertices": [1]}]')
    keys.append(key("--handles", "h.json"))
    same = [key("--verbose"), key("--jobs", "3"), key("--threads", "1"), key("--force")]
    assert same == [keys[0]] * 4
    (folder / "a.obj").write_text(CUBE + "# another\n")
    keys.append(key())
    assert len(set(keys)) == len(keys)


def batch_of(folder, code):
    """Return a job, and a batch that does it by this code in a Python instead of the script."""
    job = Job(folder / "a.obj", "a.obj", (folder / "a.png",), folder / "record.json", ())
    return job, Batch([sys.executable, "-c", code], 3, "{}", "options", False)


WRITES = """
import json, os, pathlib, sys
pathlib.Path("a.png").write_bytes(b"picture")
made = {"for": sys.argv[-1].removeprefix("--worker="), "sizes": {"a.png": 7}}
limits = ("OMP_NUM_THREADS", "TI_CPU_MAX_NUM_THREADS", "QD_CPU_MAX_NUM_THREADS")
threads = "/".join({os.environ[name] for name in limits})
about = {"threads": threads, "seconds": {"total": 1.5}, "peak_gb": 2, "made": made}
pathlib.Path("record.json").write_text(json.dumps(about))
print("a warning", file=sys.stderr)
"""


def test_what_is_done_counts_with_its_key_and_outputs_only(folder):
    job, batch = batch_of(folder, WRITES)
    job.record.write_text("[]")  # of something else
    report = {"threads": "3", "seconds": {"total": 1.5}, "peak_gb": 2}
    as_before = {"seconds": 1.5, "peak_gb": 2, "report": report}
    done = {"status": "done", **as_before, "words": "a warning\n"}
    kept = {"status": "kept", **as_before}
    assert do(job, batch) == done
    assert do(job, batch) == kept
    assert do(job, batch._replace(is_forced=True)) == done
    assert do(job, batch) == kept
    assert do(job, batch._replace(decides="others")) == done
    assert do(job, batch) == done
    (folder / "a.png").write_bytes(b"pict")
    assert do(job, batch) == done
    (folder / "a.png").unlink()
    assert do(job, batch) == done
    assert do(job, batch) == kept


@pytest.mark.parametrize(
    ("code", "error"),
    [
        ("print('x\\nheadless_render.py: error: of it', file=sys.stderr); 1/0", "of it"),
        ("1/0", "ended with exit code 1: ZeroDivisionError: division by zero"),
        ("sys.exit(7)", "ended with exit code 7: without a word"),
        ("pass", "its results are not those that its process has written"),
    ],
)
def test_why_a_file_failed(folder, code, error):
    job, batch = batch_of(folder, f"import sys; {code}")
    result = do(job, batch)
    assert (result["status"], result["error"]) == ("failed", error)


@pytest.mark.parametrize(
    ("limits", "code", "words"),
    [
        ((0.5, None), "sys.stdin.read()", "longer than 0.5 seconds (--timeout)"),
        ((None, 0.2), "x = b'1' * 300_000_000; sys.stdin.read()", "more than 0.2 GB (--memory)"),
    ],
)
def test_a_file_that_takes_more_than_it_may_is_given_up(folder, limits, code, words):
    job, batch = batch_of(folder, f"import sys; sys.stdin.readline(); {code}")
    result = do(job, batch._replace(limits=Limits(*limits)))
    assert (result["status"], result["refused"]) == ("failed", True)
    assert words in result["error"]
    if sys.platform == "linux":
        assert result["peak_gb"] > (limits[1] or 0)
    assert do(*batch_of(folder, WRITES))["status"] == "done"


@pytest.mark.skipif(sys.platform == "win32", reason="it has neither")
def test_what_is_left_out_is_named_and_not_read(folder):
    os.mkfifo(folder / "sub" / "pipe.obj")
    (folder / "sub" / "zero.ply").symlink_to("/dev/zero")
    (folder / "sub" / "nothing.ply").symlink_to("nowhere")
    (folder / "sub" / "link.obj").symlink_to(folder / "other" / "b.ply")
    (folder / "sub" / ".hidden.obj").write_text(CUBE)
    for name in ("b.max", "c.max", "README", ".DS_Store"):
        (folder / "sub" / name).write_text("no mesh")
    sources, left_out, kinds = find_sources([folder / "sub"], False, folder / "out")
    assert [source.path.name for source in sources] == ["a.obj", "link.obj"]
    assert in_words(kinds) == "2 .max, 1 without a suffix"
    names = [".hidden.obj", "nothing.ply", "pipe.obj", "zero.ply"]
    assert [path.name for path in left_out] == names
    job, batch = batch_of(folder, WRITES)
    refused = do(job._replace(path=folder / "sub" / "pipe.obj"), batch)
    assert "is a device or a pipe" in refused["error"]


def test_a_record_that_is_nested_too_deeply_counts_as_none(folder):
    job, batch = batch_of(folder, WRITES)
    job.record.write_text("[" * 100_000)
    assert do(job, batch)["status"] == "done"


def test_a_file_that_is_gone_has_failed(folder):
    job, batch = batch_of(folder, WRITES)
    (folder / "a.obj").unlink()
    assert "No such file" in do(job, batch)["error"]
