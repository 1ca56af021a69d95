# SPDX-License-Identifier: GPL-3.0-or-later
"""The command that the installed extension gives to Blender, called as Blender calls it.

A real Blender runs it in `tests/gui/test_command.py`; what it does with files and options is tested
with ``scripts/headless_render.py``, which calls the same, in `tests/scripts`.
"""

import json
import subprocess
import sys

import pytest

OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
QUICK = ("--device", "numpy", "--max-iterations", "2")
# Signals, and where standard output goes, change for the whole process.
CALL = """
import os, sys, tempfile
folder = tempfile.TemporaryDirectory(prefix="cubic_craft_tests_")
os.environ["BLENDER_USER_RESOURCES"] = folder.name
import bpy

commands = {}
register = bpy.utils.register_cli_command
bpy.utils.register_cli_command = lambda name, function: (
    commands.setdefault(name, function) and register(name, function)
)
bpy.ops.extensions.package_install_files(
    filepath=sys.argv[1], repo="user_default", enable_on_install=True
)
bpy.context.preferences.filepaths.use_scripts_auto_execute = True  # as some artists have it
sys.stdout.flush()
code = commands["cubic_craft"](sys.argv[2:])
assert "bl_ext.user_default.cubic_craft" in bpy.context.preferences.addons
bpy.ops.preferences.addon_disable(module="bl_ext.user_default.cubic_craft")
folder.cleanup()
sys.stdout.flush()
sys.stderr.flush()
os._exit(code)  # Blender 4.2 crashes while it is freed
"""


WITH_DRIVER = """
import os
import bpy

bpy.ops.mesh.primitive_cube_add()
driver = bpy.context.object.driver_add("location", 0).driver
driver.type, driver.expression = "SCRIPTED", "__import__('pathlib').Path('ran').touch() or 0"
path = os.path.abspath("driver.blend")  # Blender 4.2 asks the shell where it is
bpy.ops.wm.save_as_mainfile(filepath=path)
bpy.ops.wm.open_mainfile(filepath=path, use_scripts=True)
os._exit(0)
"""


@pytest.fixture
def call(archive, tmp_path):
    """Return a function that calls the command in a Blender of its own, in a folder with a mesh."""
    (tmp_path / "a.obj").write_text(OBJ)

    def run(*arguments):
        return subprocess.run(
            [sys.executable, "-c", CALL, str(archive), *map(str, arguments)],
            cwd=tmp_path,
            capture_output=True,
            text=True,
            timeout=900,
            check=False,
        )

    return run


def test_it_cubifies_a_file(call, tmp_path):
    outputs = ("--no-render", "--save-mesh", "b.obj", "--report", "r.json")
    done = call("a.obj", "--cubeness", "1", *QUICK, *outputs)
    assert done.returncode == 0, done.stderr
    before, after = (
        [line for line in (tmp_path / name).read_text().splitlines() if line[:2] == "v "]
        for name in ("a.obj", "b.obj")
    )
    assert len(before) == len(after) and before != after
    (found,) = json.loads((tmp_path / "r.json").read_text())["objects"]
    assert found["runs"][0]["cubeness"] == 1.0


def test_what_is_wrong_is_one_line_and_a_code(call, tmp_path):
    (tmp_path / "broken.obj").write_text("v 1 2 nan\n")
    refused = call("broken.obj", *QUICK)
    assert refused.returncode == 2
    assert refused.stderr.startswith("cubic_craft: error: broken.obj: vertex 1")


def test_nothing_in_a_file_runs_whatever_the_preferences_allow(call, tmp_path):
    subprocess.run([sys.executable, "-c", WITH_DRIVER], cwd=tmp_path, check=True)
    (tmp_path / "ran").unlink()  # as Blender itself would run it
    done = call("driver.blend", *QUICK, "--no-render", "--save-mesh", "b.obj")
    assert done.returncode == 0, done.stderr
    assert not (tmp_path / "ran").exists()
