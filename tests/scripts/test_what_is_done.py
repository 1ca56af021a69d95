# SPDX-License-Identifier: GPL-3.0-or-later
"""What the code never does: go online, run data as code, or ask for rights that it does not use.

All files of the extension and the scripts are read as syntax trees, whatever they are called.
"""

import ast
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
EXTENSION = [ROOT / "__init__.py"] + [
    path
    for room in ("solver", "cubic_craft_addon", "operators")
    for path in (ROOT / room).rglob("*.py")
]
SCRIPTS = list((ROOT / "scripts").rglob("*.py"))

NETWORK = {"socket", "ssl", "urllib", "http", "ftplib", "smtplib", "requests", "httpx", "aiohttp"}
NETWORK |= {"xmlrpc", "socketserver", "telnetlib", "webbrowser", "urllib3", "asyncio"}
UNPACKING = {"pickle", "marshal", "shelve", "dill", "code", "codeop", "runpy", "ctypes"}
CODE = {"eval", "exec", "compile", "__import__"}
DYNAMIC = {"import_module", "spec_from_file_location", "exec_module"}
SHELL = {"system", "popen", "execv", "execve", "spawnl", "spawnv"}

# Where something of this kind is done with names of our own, never with the artist's data.
COMMAND_LINE = "cubic_craft_addon/command_line"
ALLOWED = {
    ("solver/__init__.py", "import_module"),  # its own modules, at their first use
    ("operators/__init__.py", "import_module"),  # its own files
    ("solver/optional_packages.py", "import_module"),  # packages named in our code
    ("solver/backends/taichi_runtime.py", "subprocess"),  # a probe without input
    ("solver/backends/engine_lock.py", "ctypes"),  # keeps Taichi's program for ever
    ("solver/surface/memory.py", "ctypes"),  # asks Windows how much memory is free
    ("scripts/build_extension.py", "subprocess"),  # Blender's own tool
    (f"{COMMAND_LINE}/reading/trial.py", "subprocess"),  # a Blender that may crash
    ("scripts/package/fetch.py", "subprocess"),  # pip
}
WRITERS = {"write_text", "write_bytes", "open", "unlink", "rename"}


def found_in(path):
    """Return what a file does of all that (set of str)."""
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name.partition(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            found.add(node.module.partition(".")[0])
        elif isinstance(node, ast.Call):
            function = node.func
            if isinstance(function, ast.Name) and function.id in CODE | DYNAMIC:
                found.add(function.id)
            elif isinstance(function, ast.Attribute) and function.attr in DYNAMIC | SHELL:
                found.add(function.attr)
            if any(k.arg == "shell" and not _is_false(k.value) for k in node.keywords):
                found.add("shell")
    watched = NETWORK | UNPACKING | CODE | DYNAMIC | SHELL | {"subprocess", "shell"}
    return found & watched


def _is_false(node):
    return isinstance(node, ast.Constant) and node.value is False


def test_nothing_of_that_kind():
    found = {(name_of(path), what) for path in EXTENSION + SCRIPTS for what in found_in(path)}
    others = {name for name, _ in found if name.startswith("scripts/benchmark/")}  # of developers
    assert {each for each in found if each[0] not in others} == ALLOWED


def name_of(path):
    return path.relative_to(ROOT).as_posix()


def test_the_manifest_asks_for_files_only():
    """The extension writes Blender's data, Taichi's cache, presets, and what it bakes or sends.

    A lock is an empty file beside such a file, while that is written.

    Of the rights that a manifest can ask for, "files" means the artist's files, which baked
    animations, normal maps and what is sent are, and "network" the internet, which the tests above
    look for. Presets go to Blender's own folder of presets, and only when the artist asks for one
    to be saved or deleted.
    """
    manifest = tomllib.loads((ROOT / "blender_manifest.toml").read_text(encoding="utf-8"))
    assert list(manifest["permissions"]) == ["files"]
    writers = {name_of(p) for p in EXTENSION if _called(p) & WRITERS}
    names = ("environment/lock", "presets/files", "send/normal_map")
    animation = ("animation/playback", "animation/point_cache", "animation/recording")
    writers = {name for name in writers if not name.startswith((COMMAND_LINE, "solver/console"))}
    assert writers == {f"cubic_craft_addon/{name}.py" for name in (*names, *animation)}


def _called(path):
    """Return the names of all functions that a file calls, but those of Blender's lists."""
    calls = [
        n.func
        for n in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(n, ast.Call)
    ]
    of_lists = [f for f in calls if isinstance(f, ast.Attribute) and _is_list(f.value)]
    return {getattr(f, "attr", getattr(f, "id", "")) for f in calls if f not in of_lists}


def _is_list(value):
    """Return whether this is what objects are linked to, and unlinked from."""
    return isinstance(value, ast.Attribute) and value.attr == "objects"
