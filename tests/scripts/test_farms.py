# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples for render farms: what their tasks run is a batch of one file.

There is no farm here: a shell, the command of Open Job Description, and Node stand in for them.
"""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from batch_kit import CUBE, QUICK, batch
from headless import PATIENCE, SCRIPT
from scripts.cubic_craft.cubic_craft_addon.command_line.options.arguments import parse

FARMS = SCRIPT.parents[1] / "examples" / "farms"
OPENJD = Path(sys.executable).with_name("openjd")
BLENDER = f"""#!/bin/sh
# Runs the command as Blender does, by Python with the module bpy.
while [ "$1" != cubic_craft ]; do shift; done
shift
exec {sys.executable} {SCRIPT} "$@"
"""
OPTIONS = " ".join((*QUICK, "--no-render", "--save-mesh", ".obj"))
COMPILE = """
const job = { settings: %s, tasks: [], addTask(task) { this.tasks.push(task); } };
const path = require("path").posix;
const author = {
    Task: (name, type) => ({ name, type, commands: [], addCommand(c) { this.commands.push(c); } }),
    Command: (name, parameters) => ({ name, parameters }),
};
compileJob(job);
console.log(JSON.stringify(job.tasks));
"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "Broken.obj").write_text("v 0 0 0\n")
    (tmp_path / "in" / "it's $HOME.obj").write_text(CUBE)
    (tmp_path / "blender").write_text(BLENDER)
    (tmp_path / "blender").chmod(0o755)
    return tmp_path


def run(*command, cwd, **variables):
    process = subprocess.run(
        [*map(str, command)],
        cwd=cwd,
        env=os.environ | variables,
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    return process.returncode, process.stdout + process.stderr


def test_a_task_of_an_array_job_does_what_the_batch_does(folder):
    variables = {"BLENDER": str(folder / "blender"), "SLURM_ARRAY_TASK_ID": "2"}
    arguments = ("in", "jobs", *QUICK, "--save-mesh", ".obj")
    code, words = run("sh", FARMS / "array_job.sh", *arguments, cwd=folder, **variables)
    assert code == 0, words
    batch("in", cwd=folder)
    done, expected = (folder / name / "it's $HOME.obj" for name in ("jobs", "out"))
    assert done.read_bytes() == expected.read_bytes()


def test_an_open_job_names_what_cannot_be_used_and_goes_on(folder):
    job = FARMS / "meshes.openjd.yaml"
    given = {"InputFolder": folder / "in", "OutputFolder": folder / "jobs", "Files": "1-2"}
    given |= {"Options": OPTIONS, "Blender": folder / "blender"}
    words = [word for name, value in given.items() for word in ("-p", f"{name}={value}")]
    code, said = run(OPENJD, "run", job, *words, cwd=folder)
    assert code == 0, said
    written = sorted(path.name for path in (folder / "jobs").iterdir() if path.is_file())
    assert written == ["1.error.txt", "it's $HOME.obj"]


@pytest.mark.skipif(shutil.which("node") is None, reason="Node.js (node) is not installed")
def test_flamenco_makes_a_task_for_each_mesh(folder, monkeypatch):
    monkeypatch.chdir(folder)
    settings = {"input_folder": "in", "output_folder": "out", "files": 2, "options": OPTIONS}
    source = (FARMS / "flamenco.js").read_text() + COMPILE % json.dumps(settings)
    code, words = run("node", "-e", source, cwd=folder)
    assert code == 0, words
    for number, task in enumerate(json.loads(words), 1):
        (command,) = task["commands"]
        arguments = command["parameters"]["argsBefore"][3:]
        options = parse(arguments)
        assert (options.only, options.save_mesh, options.no_render) == (number, ".obj", True)
        assert options.error_file == Path(f"out/{number}.error.txt")


def test_the_way_from_a_folder_to_an_engine(folder):
    script = FARMS.parent / "engine" / "folder_to_engine.py"
    arguments = ("in", "assets", "--no-render", *QUICK)
    variables = {"BLENDER": str(folder / "blender")}
    code, words = run(sys.executable, script, *arguments, cwd=folder, **variables)
    assert code == 3, words
    assert "Broken.obj: holds only meshes without faces" in words
    listed = json.loads((folder / "assets" / "assets.json").read_text())
    names = [f"it's $HOME{end}.glb" for end in ("", "_lod1", "_lod2", "_lod3")]
    assert listed == {"it's $HOME.obj": names}
    assert all((folder / "assets" / name).stat().st_size for name in names)
