# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts of batches, without Blender."""

import json
import subprocess
import sys
import threading
from pathlib import Path

import pytest
from batch_kit import CUBE
from headless import PATIENCE

from scripts.headless.arguments import as_arguments, parse
from scripts.headless.batch.plan import FORWARDED, plan
from scripts.headless.batch.records import key_of, read_record, write_record
from scripts.headless.batch.sources import find_sources
from scripts.headless.batch.workers import Workers, why_failed
from scripts.headless.errors import InputError

NOT_FORWARDED = {
    *("inputs", "input", "handles", "output", "save_mesh", "report", "error_file"),
    *("output_folder", "recursive", "jobs", "force", "threads", "worker"),
    "paper",  # what it stands for is forwarded
}
ALL_OPTIONS = """--cubeness 0.1 1e-05 --orientation -0.00001 2.5 -90 --pin=-a --map=-m
    --space object --solidity 0 --together parts --refine off --rotation free
    --symmetry zx --floor --hold-rest off --with-modifiers
    --max-iterations 7 --tolerance 1e-12 --device numpy --handles h.json
    --engine workbench --samples 3 --resolution 32 33 --turn -90 0 -0.0000001 --turntable 4
    --object=-o --verbose"""


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


def test_every_option_reaches_the_workers_as_it_was_given(folder):
    options = batch_options(*ALL_OPTIONS.split())
    assert set(vars(options)) == {*FORWARDED, *NOT_FORWARDED}
    defaults = batch_options()
    for name in set(FORWARDED) - {"no_render"}:
        assert getattr(options, name) != getattr(defaults, name), f"{name} is not tried here"
    (job,) = plan(options, find_sources(options.inputs, False, options.output_folder))
    (folder / "out" / ".cubic_craft").mkdir(parents=True)
    there = parse(job.arguments)
    for name in FORWARDED:
        assert getattr(there, name) == getattr(options, name)
    assert there.worker and there.input == folder / "a.obj"
    assert there.output == folder / "out" / "a.png"
    assert as_arguments(batch_options("--no-render", "--report", "r.json"), ["no_render"]) == [
        "--no-render"
    ]


def test_the_paper_is_its_options_in_full(folder):
    def key(*words):
        return key_of(folder / "a.obj", batch_options(*words), FORWARDED, "1")

    in_full = ["--solidity", "0", "--together", "off", "--refine", "off", "--rotation", "free"]
    in_full += ["--hold-rest", "off"]
    assert key("--paper") == key(*in_full) != key()
    (job,) = plan(batch_options("--paper"), find_sources([Path("a.obj")], False, Path("out")))
    assert {"--solidity=0.0", "--together=off", "--refine=off", "--rotation=free"} <= {
        *job.arguments
    }
    beside = batch_options("--paper", "--rotation", "keep", "--solidity", "0.1")
    assert (beside.rotation, beside.solidity, beside.together) == ("keep", 0.1, "off")
    by_default = [
        "--solidity",
        "0.1",
        "--together",
        "selection",
        "--refine",
        "auto",
        "--rotation",
        "keep",
        "--hold-rest",
        "on",
    ]
    assert key() == key(*by_default)
    keys = {key(*in_full[:k], *in_full[k + 2 :]) for k in range(0, 10, 2)}
    assert len(keys | {key("--paper")}) == 6, "each of them decides about the result"


def test_auto_is_no_rotation_any_more(folder):
    with pytest.raises(InputError, match="--rotation"):
        batch_options("--rotation", "auto")


def names(*inputs, is_recursive=False):
    sources = find_sources([Path(name) for name in inputs], is_recursive, Path("out"))
    return {source.path.relative_to(Path.cwd()).as_posix(): source.name for source in sources}


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


def test_names_that_differ_in_case_only_are_kept_apart(folder):
    (folder / "sub" / "A.obj").write_text(CUBE)
    if len(list((folder / "sub").iterdir())) < 2:
        pytest.skip("they are the same file here")
    first, second = names("sub").values()
    assert first.casefold() != second.casefold()
    assert names("sub") == names("sub")


def test_results_are_not_taken_for_inputs(folder):
    (folder / "out").mkdir()
    (folder / "out" / "a.obj").write_text(CUBE)
    assert "out/a.obj" not in names(".", is_recursive=True)


def test_the_key_changes_with_all_that_decides_about_the_result(folder):
    def key(*words, version="1"):
        return key_of(folder / "a.obj", batch_options(*words), FORWARDED, version)

    keys = [key(), key(version="2"), key("--cubeness", "0.5"), key("--save-mesh", ".obj")]
    keys += [key("--save-mesh", ".ply"), key("--handles", "h.json")]
    (folder / "h.json").write_text('[{"vertices": [1]}]')
    keys.append(key("--handles", "h.json"))
    same = [key("--verbose"), key("--jobs", "3"), key("--threads", "1"), key("--force")]
    assert same == [keys[0]] * 4
    (folder / "a.obj").write_text(CUBE + "# another\n")
    keys.append(key())
    assert len(set(keys)) == len(keys)


def test_a_record_counts_with_its_key_and_outputs_only(folder):
    record, output = folder / "record.json", folder / "a.png"
    assert read_record(record, "key", [output]) is None
    record.write_text(json.dumps({"objects": []}))  # a report, before its run has ended
    assert read_record(record, "key", [output]) is None
    with pytest.raises(OSError, match=r"a\.png"):
        write_record(record, "key", [output], 1.5)
    output.write_bytes(b"picture")
    written = write_record(record, "key", [output], 1.5)
    assert read_record(record, "key", [output]) == written
    assert written["report"] == {"objects": []} and written["seconds"] == 1.5
    assert read_record(record, "other", [output]) is None
    output.write_bytes(b"pict")
    assert read_record(record, "key", [output]) is None


def python_workers(threads=None):
    return Workers([sys.executable, "-c"], threads)


def test_workers_share_the_processor():
    code = "import os, sys; sys.stderr.write(os.environ['OMP_NUM_THREADS'])"
    assert python_workers(3).run([code]) == (0, "3")


def test_a_worker_that_is_just_being_started_ends_with_the_others(monkeypatch):
    is_started, may_go_on = threading.Event(), threading.Event()
    started = []

    class SlowlyStarted(subprocess.Popen):
        def __init__(self, *arguments, **options):
            super().__init__(*arguments, **options)
            started.append(self)
            is_started.set()
            may_go_on.wait(PATIENCE)

    monkeypatch.setattr(subprocess, "Popen", SlowlyStarted)
    workers = python_workers()
    code = "import sys; sys.stdin.read()"  # ends when it is told to
    threading.Thread(target=workers.run, args=([code],), daemon=True).start()
    assert is_started.wait(PATIENCE)
    ending = threading.Thread(target=workers.end, daemon=True)
    ending.start()
    ending.join(0.5)  # as long as it is not known of
    may_go_on.set()
    ending.join(PATIENCE)
    assert not ending.is_alive()
    assert started[0].returncode is not None, "it is left behind"


def test_why_a_worker_failed():
    ending = python_workers().run(
        ["import sys; print('x\\nx.py: error: of it', file=sys.stderr)\n1/0"]
    )
    assert why_failed(*ending, "x.py: error: ") == "of it"
    assert why_failed(*ending, "y") == "ended with exit code 1: ZeroDivisionError: division by zero"
    assert why_failed(7, "", "y") == "ended with exit code 7: without a word"
