# SPDX-License-Identifier: GPL-3.0-or-later
"""The job type for Flamenco, compiled by Node with a stand-in for Flamenco Manager.

There is no farm here: that Flamenco takes the script as it is has not been tried.
"""

import json
import shutil
import subprocess
from pathlib import Path
from types import SimpleNamespace

import pytest
from batch_kit import CUBE
from headless import SCRIPT, headless, headless_ok
from scripts.cubic_craft.cubic_craft_addon.command_line.options.arguments import parse
from scripts.cubic_craft.cubic_craft_addon.command_line.options.formats import (
    KEEP_VERTICES,
    READABLE,
)

NODE = shutil.which("node")
JOB_TYPE = SCRIPT.parent / "flamenco" / "cubic_craft.js"
NAMES = ["a.obj", "a.ply", "Größe 立方体.obj", "it's $HOME.obj", "-lead.obj", "two.dots.obj"]

pytestmark = pytest.mark.skipif(NODE is None, reason="Node.js (node) is not installed")


def flamenco(settings=None):
    """Return what the stand-in makes of a job with these settings."""
    assert NODE is not None
    process = subprocess.run(
        [NODE, Path(__file__).with_name("flamenco_stand_in.js"), JOB_TYPE],
        input=json.dumps({"name": "job", "settings": settings}),
        capture_output=True,
        text=True,
        check=False,
    )
    assert process.returncode == 0, process.stderr
    return json.loads(process.stdout)


@pytest.fixture
def settings(tmp_path):
    """Return the settings as an artist leaves them, for a folder with meshes."""
    (tmp_path / "in").mkdir()
    (tmp_path / "out").mkdir()
    for name in (*NAMES, ".hidden.obj", "notes.txt"):
        (tmp_path / "in" / name).write_text(CUBE)
    given = {
        "script": str(SCRIPT),
        "input_folder": str(tmp_path / "in"),
        "output_folder": str(tmp_path / "out"),
    }
    for setting in flamenco()["type"]["settings"]:
        if "default" in setting:
            given[setting["key"]] = setting["default"]
    return given | {"files": listed(given)}


def listed(given):
    """Evaluate the expression for the list of files in the way of Flamenco's add-on."""
    (setting,) = [s for s in flamenco()["type"]["settings"] if s["key"] == "files"]
    names = {"settings": SimpleNamespace(**given), "Path": Path, "abspath": Path}
    return eval(setting["eval"], {}, names)


def command_lines(settings):
    """Return {task: arguments of headless_render.py}."""
    compiled = flamenco(settings)
    assert compiled["error"] is None
    lines = {}
    for task in compiled["tasks"]:
        make, render = task["commands"]
        assert make == {"name": "make-directory", "parameters": {"path": settings["output_folder"]}}
        assert render["name"] == "blender-render"
        parameters = render["parameters"]
        assert parameters["exe"] == "{blender}" and parameters["exeArgs"] == "{blenderArgs}"
        assert parameters["blendfile"] == ""
        assert parameters["args"][:3] == ["--python", settings["script"], "--"]
        assert all(isinstance(each, str) for each in parameters["argsBefore"] + parameters["args"])
        lines[task["name"]] = parameters["args"][3:]
    return lines


def test_the_settings_are_of_the_kinds_that_flamenco_knows():
    settings = flamenco()["type"]["settings"]
    keys = [setting["key"] for setting in settings]
    assert len(set(keys)) == len(keys)
    for setting in settings:
        assert setting["type"] in {"string", "int32", "float", "bool"}
        assert setting.get("subtype") in {None, "file_path", "dir_path"}
        assert setting.get("visible", "visible") in {"visible", "submission", "web", "hidden"}
        assert setting["description"]


def test_the_files_of_the_folder_are_listed(settings):
    assert json.loads(settings["files"]) == sorted(NAMES)
    (setting,) = [s for s in flamenco()["type"]["settings"] if s["key"] == "files"]
    assert all(f"'{suffix}'" in setting["eval"] for suffix in READABLE)
    (formats,) = [s["choices"] for s in flamenco()["type"]["settings"] if s["key"] == "mesh_format"]
    assert set(formats) <= {"none", *KEEP_VERTICES}


def test_each_file_is_a_task_whose_command_line_the_script_accepts(settings, tmp_path):
    lines = command_lines(settings)
    assert sorted(lines) == sorted(NAMES)
    written = []
    for name, arguments in lines.items():
        options = parse(arguments)
        assert options.input == tmp_path / "in" / name
        assert options.cubeness == [0.4]
        written += [options.output, options.save_mesh, options.report, options.error_file]
        assert {path.parent for path in written} == {tmp_path / "out"}
    assert len({str(path).casefold() for path in written}) == 4 * len(NAMES)
    assert parse(lines["a.ply"]).output.name == "a_ply.png"
    assert parse(lines["two.dots.obj"]).save_mesh.name == "two.dots.obj"


def test_settings_reach_the_script(settings):
    settings |= {"cubeness": "0.2  1", "pictures": False, "mesh_format": ".ply"}
    settings |= {"options": '--rotation keep --pin "left ear" chin --map="so much"'}
    options = parse(command_lines(settings)["a.obj"])
    assert options.cubeness == [0.2, 1.0] and options.no_render
    assert options.save_mesh.suffix == ".ply"
    assert (options.rotation, options.pin) == ("keep", ["left ear", "chin"])
    assert options.map == "so much"
    pictures_only = settings | {"pictures": True, "mesh_format": "none", "options": ""}
    assert parse(command_lines(pictures_only)["a.obj"]).save_mesh is None


def test_what_the_tasks_write(settings, tmp_path):
    settings |= {"pictures": False, "options": "--device numpy --max-iterations 2 --refine off"}
    settings |= {"files": json.dumps(["it's $HOME.obj", "-lead.obj", "a.ply"])}
    for arguments in command_lines(settings).values():
        headless_ok(*arguments, cwd=tmp_path, run=headless)
    done = {"it's $HOME.json", "it's $HOME.obj", "-lead.json", "-lead.obj"}
    assert {path.name for path in (tmp_path / "out").iterdir()} == {*done, "a.error.txt"}
    assert "a.ply: cannot be read" in (tmp_path / "out" / "a.error.txt").read_text()


@pytest.mark.parametrize(
    ("change", "word"),
    [
        ({"files": "[]"}, "no meshes"),
        ({"pictures": False, "mesh_format": "none"}, "nothing to write"),
        ({"files": '["a.obj", "A.obj"]'}, "rename"),
    ],
)
def test_a_job_that_makes_no_sense_is_refused_when_it_is_submitted(settings, change, word):
    assert word in flamenco(settings | change)["error"]
