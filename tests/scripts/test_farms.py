# SPDX-License-Identifier: GPL-3.0-or-later
"""The examples for clusters and engines; there is none here, and a shell stands in for it."""

import json
import os
import subprocess
import sys

import pytest
from batch_kit import CUBE, MESHES, QUICK
from headless import PATIENCE, SCRIPT, headless_ok

FARMS = SCRIPT.parents[1] / "examples" / "farms"
BLENDER = f"""#!/bin/sh
# Runs the command as Blender does, by Python with the module bpy.
while [ "$1" != cubic_craft ]; do shift; done
shift
exec {sys.executable} {SCRIPT} "$@"
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


def test_a_task_of_an_array_job_does_what_the_command_does(folder):
    variables = {"BLENDER": str(folder / "blender"), "SLURM_ARRAY_TASK_ID": "2"}
    arguments = ("in", "jobs", *MESHES)
    code, words = run("sh", FARMS / "array_job.sh", *arguments, cwd=folder, **variables)
    assert code == 0, words
    outputs = ("--no-render", "--save-mesh", "expected.obj")
    headless_ok("in/it's $HOME.obj", *QUICK, *outputs, cwd=folder)
    done, expected = folder / "jobs" / "it's $HOME.obj", folder / "expected.obj"
    assert done.read_bytes() == expected.read_bytes()


def test_the_way_from_a_folder_to_an_engine(folder):
    script = FARMS.parent / "engine" / "folder_to_engine.py"
    arguments = ("in", "assets", "--no-render", *QUICK)
    variables = {"BLENDER": str(folder / "blender")}
    code, words = run(sys.executable, script, *arguments, cwd=folder, **variables)
    assert code == 3, words
    assert "Broken.obj: in/Broken.obj: holds only meshes without faces" in words
    listed = json.loads((folder / "assets" / "assets.json").read_text())
    names = [f"it's $HOME{end}.glb" for end in ("", "_lod1", "_lod2", "_lod3")]
    assert listed == {"it's $HOME.obj": names}
    assert all((folder / "assets" / name).stat().st_size for name in names)
