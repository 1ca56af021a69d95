# SPDX-License-Identifier: GPL-3.0-or-later
"""The example for clusters; there is none here, and a shell stands in for it."""

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
