# SPDX-License-Identifier: GPL-3.0-or-later
"""A user's script passes the strictest checks of types, and each mistake in it is found.

The package is checked as it is installed: of one that says that it is typed, checkers infer nothing
that its annotations do not say.
"""

import importlib.util
import inspect
import json
import shutil
import subprocess
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

import solver

ROOT = Path(__file__).parents[2]
SCRIPT = Path(__file__).with_name("typed_script.py")
WRONG = {
    number
    for number, line in enumerate(SCRIPT.read_text(encoding="utf-8").splitlines(), 1)
    if line.endswith("  # wrong")
}


@pytest.fixture
def environment(tmp_path, monkeypatch):
    """Give a folder with the script, and an environment that has the package and ours."""
    name = "hatchling.builders.hooks.plugin.interface"
    monkeypatch.setitem(sys.modules, name, SimpleNamespace(BuildHookInterface=object))
    spec = importlib.util.spec_from_file_location("hook", ROOT / "library" / "build_hook.py")
    hook = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(hook)
    python = f"python{sys.version_info.major}.{sys.version_info.minor}"
    packages = tmp_path / "env" / "lib" / python / "site-packages"
    (packages / "cubic_craft").mkdir(parents=True)
    hook.stage(ROOT, packages / "cubic_craft")
    (packages / "ours.pth").write_text(str(Path(pytest.__file__).parents[1]))
    (tmp_path / "checked").mkdir()
    shutil.copy(SCRIPT, tmp_path / "checked")
    return tmp_path


def test_pyright_finds_the_mistakes_and_nothing_else(environment):
    pytest.importorskip("pyright")
    strict = {"include": ["checked"], "venvPath": ".", "venv": "env", "typeCheckingMode": "strict"}
    (environment / "pyrightconfig.json").write_text(json.dumps(strict))
    words = [sys.executable, "-m", "pyright", "--outputjson", "-p", environment]
    said = subprocess.run(words, capture_output=True, text=True, check=False).stdout
    found = json.loads(said[said.index("{") :])["generalDiagnostics"]
    lines = {each["range"]["start"]["line"] + 1 for each in found}
    assert lines == WRONG, [each["message"] for each in found]


def members(value):
    """Give the public functions of a class with their names, or a function itself."""
    if not inspect.isclass(value):
        return [(value.__name__, value)] if inspect.isfunction(value) else []
    found = []
    for name, member in inspect.getmembers_static(value):
        function = getattr(member, "fget", None) or getattr(member, "func", member)
        is_ours = inspect.isfunction(function) and function.__module__.startswith("solver")
        if is_ours and (name == "__init__" or not name.startswith("_")):
            found.append((name, function))
    return found


def test_all_public_functions_are_typed():
    missing = []
    for public in solver.__all__:
        for name, function in members(getattr(solver, public)):
            wanted = {*inspect.signature(function).parameters, "return"} - {"self"}
            wanted -= {"return"} if name == "__init__" else set()
            missing += [(public, name, each) for each in wanted - set(function.__annotations__)]
    assert missing == []
