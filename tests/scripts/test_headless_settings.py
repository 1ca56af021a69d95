# SPDX-License-Identifier: GPL-3.0-or-later
"""The options of what holds together reach the solver, each under its name."""

import json
import subprocess
import sys
from dataclasses import asdict, fields, replace
from pathlib import Path

import pytest
from headless import PATIENCE

from solver import PAPER, ProxyOptions

GIVEN = {
    "": ProxyOptions(),
    "--paper": PAPER,
    "--paper --keep-pose on --detail 0.1 --keep-apart on": replace(
        PAPER, keep_pose=True, detail=0.1, keep_apart=True
    ),
}
for option in fields(ProxyOptions):
    word, value = ("off", False) if option.default is True else ("0.2", 0.2)
    given = f"--{option.name.replace('_', '-')} {word}"
    GIVEN[given] = replace(ProxyOptions(), **{option.name: value})
READ = """
import json, os, sys
from dataclasses import asdict
from pathlib import Path

import bpy
from cubic_craft import registered
from cubic_craft.cubic_craft_addon.command_line.options.arguments import parse
from cubic_craft.cubic_craft_addon.command_line.reading.load_meshes import Loaded
from cubic_craft.cubic_craft_addon.command_line.solving.cubify_all import settings_of_object

with registered():
    bpy.ops.mesh.primitive_cube_add()
    obj = bpy.context.object
    loaded = Loaded([obj])
    for given in sys.argv[1:]:
        options = parse(["--no-render", "--report", "r.json", *given.split()])
        print(json.dumps(asdict(settings_of_object(obj, (), options, loaded).proxy)))
sys.stdout.flush()
os._exit(0)  # Blender 4.2 crashes while it is freed
"""


@pytest.fixture(scope="module")
def proxies(tmp_path_factory):
    """Return what the script asks the solver for, by what it was given."""
    process = subprocess.run(
        [sys.executable, "-c", READ, *GIVEN],
        cwd=tmp_path_factory.mktemp("settings"),
        env={"PYTHONPATH": str(Path(__file__).parents[2] / "scripts")},
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        check=False,
    )
    assert process.returncode == 0, process.stderr
    return dict(zip(GIVEN, map(json.loads, process.stdout.splitlines()), strict=True))


@pytest.mark.parametrize("given", GIVEN)
def test_each_option_of_the_proxy_reaches_the_solver(proxies, given):
    assert proxies[given] == pytest.approx(asdict(GIVEN[given]))
