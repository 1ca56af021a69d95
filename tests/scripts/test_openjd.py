# SPDX-License-Identifier: GPL-3.0-or-later
"""The Open Job Descriptions, checked and run by the command of those who define the format."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from batch_kit import CUBE, MESHES, QUICK, batch
from headless import PATIENCE, SCRIPT, headless_ok
from rigged import make_rigged, read_pc2
from scripts.cubic_craft.cubic_craft_addon.command_line.options.arguments import parse

OPENJD = Path(sys.executable).with_name("openjd")
MESH_JOB, ANIMATION_JOB = (
    SCRIPT.parent / "openjd" / name for name in ("meshes.yaml", "animation.yaml")
)
BLENDER = f"""#!/bin/sh
# Runs a script as Blender does, by Python with the module bpy.
while [ "$1" != -- ]; do
    if [ "$1" = --python ]; then script=$2; fi
    shift
done
shift
exec {sys.executable} "$script" "$@"
"""


def openjd(*arguments):
    """Run the command; return its exit code, and all that it prints."""
    process = subprocess.run(
        [OPENJD, *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    return process.returncode, process.stdout


@pytest.fixture
def blender(tmp_path):
    """Return a program that stands in for Blender, of which the tests have the module only."""
    program = tmp_path / "blender"
    program.write_text(BLENDER)
    program.chmod(0o755)
    return program


def run(job, **parameters):
    given = [word for name, value in parameters.items() for word in ("-p", f"{name}={value}")]
    return openjd("run", job, *given)


@pytest.mark.parametrize("job", [MESH_JOB, ANIMATION_JOB], ids=lambda job: job.stem)
def test_the_job_is_valid(job):
    code, words = openjd("check", job)
    assert code == 0, words


@pytest.fixture
def meshes(tmp_path):
    """Return what a job gets for a folder of meshes, of which one is broken."""
    folder = tmp_path / "in"
    folder.mkdir()
    (folder / "Broken.obj").write_text("v 0 0 0\n")
    for name in ("it's $HOME", "-lead Größe 立方体"):
        (folder / f"{name}.obj").write_text(CUBE)
    return {
        "InputFolder": folder,
        "OutputFolder": tmp_path / "jobs",
        "Options": " ".join(("--no-render", *QUICK)),
        "Script": SCRIPT,
    }


def test_each_mesh_is_a_task_that_does_what_the_batch_does(meshes, blender, tmp_path):
    names = sorted(path.name for path in meshes["InputFolder"].iterdir())
    good = [number for number, name in enumerate(names, 1) if name != "Broken.obj"]
    code, words = run(MESH_JOB, **meshes, Blender=blender, Files=",".join(map(str, good)))
    assert code == 0, words
    batch(meshes["InputFolder"], cwd=tmp_path, options=MESHES)
    for name in (names[number - 1] for number in good):
        done, expected = (tmp_path / folder / name for folder in ("jobs", "out"))
        assert done.read_bytes() == expected.read_bytes()
    written = [path.name for path in (tmp_path / "jobs").iterdir() if path.is_file()]
    assert sorted(written) == [names[number - 1] for number in good]


def test_a_mesh_that_cannot_be_used_is_named_and_the_next_one_is_done(meshes, blender):
    code, words = run(MESH_JOB, **meshes, Blender=blender, Files="2-3")
    assert code == 0 and "Broken.obj" in words and "meshes without faces" in words
    errors = [path.name for path in meshes["OutputFolder"].glob("*.error.txt")]
    assert errors == ["2.error.txt"]
    assert "Broken.obj: " in (meshes["OutputFolder"] / "2.error.txt").read_text(encoding="utf-8")
    assert (meshes["OutputFolder"] / "it's $HOME.obj").exists()


def test_a_mesh_that_takes_too_much_is_given_up(meshes, blender):
    code, words = run(MESH_JOB, **meshes, Blender=blender, Files="1", Memory=0.01)
    assert code == 0 and "takes more than 0.01 GB (--memory)" in words


def test_a_task_for_which_there_is_no_file_fails(meshes, blender):
    code, words = run(MESH_JOB, **meshes, Blender=blender, Files="4")
    assert code != 0 and "--only 4: there are 3 files" in words


@pytest.mark.thorough
def test_each_range_of_frames_is_a_task_and_their_file_is_that_of_one_run(blender, tmp_path):
    scene = make_rigged(tmp_path / "rigged.blend")
    frames = ("--frames", "1", "24")
    options = ("--object", "Ball", "--device", "numpy", "--refine", "off")
    code, words = run(
        ANIMATION_JOB,
        Scene=scene,
        Animation=tmp_path / "parts.pc2",
        LastFrame=24,
        Parts=3,
        Options=" ".join(options),
        Script=SCRIPT,
        Blender=blender,
    )
    assert code == 0, words
    report = tmp_path / "whole.json"
    headless_ok(scene, *options, *frames, "--bake", "whole.pc2", "--report", report, cwd=tmp_path)
    parts, whole = (read_pc2(tmp_path / f"{name}.pc2") for name in ("parts", "whole"))
    assert len(parts) == len(whole) == json.loads(report.read_text())["objects"][0]["frames"]
    assert np.abs(parts - whole).max() < 1e-4 * np.ptp(whole[0])
    assert words.count("Solved 8 of 24 frames") == 3
    assert not list(tmp_path.glob("*.unfinished"))


def test_options_in_one_text():
    text = r'--pin "left ear" chin --map="so much" --output C:\pictures\a.png'
    options = parse(["--cubeness", "0.2", "--options", text])
    assert (options.cubeness, options.pin, options.map) == ([0.2], ["left ear", "chin"], "so much")
    assert str(options.output) == r"C:\pictures\a.png"
