# SPDX-License-Identifier: GPL-3.0-or-later
"""What is in the wheel: the files of the solver, under another name."""

import ast
import pydoc
import re
import subprocess
import sys
from importlib.metadata import distribution, files, requires, version
from pathlib import Path

import pytest
from documents import examples, run_example

import cubic_craft
from cubic_craft import optional_packages

ROOT = Path(__file__).parents[2]
INSTALLED = Path(cubic_craft.__file__).parent
SOURCES = [
    *((ROOT / "solver", path) for path in (ROOT / "solver").rglob("*.py")),
    *((ROOT / "library", path) for path in (ROOT / "library" / "command_line").rglob("*.py")),
    (ROOT / "library", ROOT / "library" / "__main__.py"),
]
BACKENDS = "cubic_craft.backends"


def copy_of(room, path):
    return INSTALLED / path.relative_to(room)


def test_it_is_not_the_source_tree():
    assert ROOT not in INSTALLED.parents or INSTALLED.is_relative_to(sys.prefix)


@pytest.mark.parametrize(("room", "path"), SOURCES, ids=lambda value: value.name)
def test_a_file_differs_only_where_it_imports_the_solver(room, path):
    source = path.read_text(encoding="utf-8").splitlines()
    copy = copy_of(room, path).read_text(encoding="utf-8").splitlines()
    assert len(copy) == len(source)
    for line, original in zip(copy, source, strict=True):
        if line != original:
            assert re.match(r"\s*(>>> )?from cubic_craft[. ]", line)
            assert line == original.replace("from solver", "from cubic_craft", 1)


def test_there_is_nothing_else():
    found = {path for path in INSTALLED.rglob("*") if path.is_file() and path.suffix != ".pyc"}
    assert found == {copy_of(*each) for each in SOURCES} | {INSTALLED / "py.typed"}
    top_level = {path.parts[0] for path in files("cubic-craft") if path.parts[0] != ".."}
    assert top_level == {"cubic_craft", f"cubic_craft-{version('cubic-craft')}.dist-info"}


def test_no_file_imports_a_package_called_solver():
    for path in INSTALLED.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                assert all(alias.name.partition(".")[0] != "solver" for alias in node.names), path
            elif isinstance(node, ast.ImportFrom) and not node.level:
                assert (node.module or "").partition(".")[0] != "solver", path


def test_the_version_is_that_of_the_extension():
    manifest = (ROOT / "blender_manifest.toml").read_text(encoding="utf-8")
    assert f'\nversion = "{version("cubic-craft")}"' in manifest


def test_it_shows_its_names_and_its_version():
    assert cubic_craft.__version__ == version("cubic-craft")
    assert {*cubic_craft.__all__, "__version__"} <= set(dir(cubic_craft))
    listed = pydoc.render_doc(cubic_craft, renderer=pydoc.plaintext)
    assert [name for name in cubic_craft.__all__ if name not in listed] == []


def test_it_can_be_run_as_a_module():
    words = [sys.executable, "-m", "cubic_craft", "--version"]
    done = subprocess.run(words, capture_output=True, text=True, check=True)
    assert done.stdout == f"cubic-craft {cubic_craft.__version__}\n"


def test_it_says_what_it_needs_and_its_licence():
    needed = {re.match(r"[\w-]+", line)[0] for line in requires("cubic-craft") if ";" not in line}
    assert needed == {"numpy", "scipy", "trimesh", "mapbox-earcut", "threadpoolctl"}
    metadata = distribution("cubic-craft").metadata
    assert metadata["License-Expression"] == "GPL-3.0-or-later"
    licence = INSTALLED.parent / f"cubic_craft-{version('cubic-craft')}.dist-info"
    assert (licence / "licenses" / "LICENSE").read_text() == (ROOT / "LICENSE").read_text()
    assert metadata.get_payload().strip() == (ROOT / "docs/library.md").read_text("utf-8").strip()


def test_what_the_fast_extra_lists_is_all_that_is_optional():
    lacking = ("fast", "earcut", "threadpoolctl")  # the extension may be without the last two
    may_lack = [line for line in requires("cubic-craft") if any(word in line for word in lacking)]
    listed = {re.match(r"[\w-]+", line)[0] for line in may_lack}
    asked = set()
    for path in INSTALLED.rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        asked |= set(re.findall(r'optional_package\("(\w+)"\)', text))
        asked |= set(re.findall(r'Engine\("\w+", "(\w+)"', text))
    assert {name.replace("-", "_") for name in listed} == asked


def test_it_works_with_and_without_what_is_optional():
    V = [[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    F = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
    result = cubic_craft.stylize(V, F, 0.4, proxy=cubic_craft.PAPER)
    engine = cubic_craft.engine_name().lower()
    has_engine = optional_packages.optional_package(engine) is not None
    assert result.device == (f"{engine}-cpu" if has_engine else "numpy")
    assert result.converged


def test_importing_it_is_quick_and_loads_neither_blender_nor_what_is_optional():
    script = "import sys, cubic_craft; print(*sys.modules)"
    text = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True).stdout
    assert {"bpy", "taichi", "quadrants", "scipy", "trimesh", "solver"}.isdisjoint(text.split())


def test_the_page_lists_the_options_of_the_command():
    command = Path(sys.executable).with_name("cubic-craft")
    text = subprocess.run([command, "--help"], capture_output=True, text=True).stdout
    section = (ROOT / "docs" / "library.md").read_text("utf-8").split("\n## The command\n")[1]
    rows = [line for line in section.splitlines() if line.startswith("| `--")]
    listed = set(re.findall(r"--[a-z-]+", " ".join(row.split("|")[1] for row in rows)))
    assert listed == set(re.findall(r"^  (--[a-z-]+)", text, re.MULTILINE)) - {"--version"}
    forms = re.search(r"--form \{([a-z,]+)\}", text)[1].split(",")
    row = next(row for row in rows if row.startswith("| `--form NAME`"))
    assert [f"`{name}`" in row for name in forms] == [True] * len(forms)


@pytest.mark.parametrize(("page", "title"), examples("cubic_craft"), ids=str)
def test_the_example_of_a_page_runs(page, title, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert run_example(page, title)
