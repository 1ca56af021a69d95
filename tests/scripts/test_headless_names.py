# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of files that programs trip over: quotes, newlines, spaces, all alphabets."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from headless import headless, headless_ok, headless_shared

NAMES = [
    "two words",
    'it\'s "quoted" `twice` $HOME;#',
    "line\nbreak",
    "Größe 立方体 🧊",
    "-leading",
    "percent%20 {brace} %d",
    "a" * 180,
]
ALONE = {("line\nbreak", "obj"), ("Größe 立方体 🧊", "blend")}
"""what goes to a process of its own, through the operating system's command line"""
TRIANGLE = "o part\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
QUICK = ("--device", "numpy", "--max-iterations", "2", "--samples", "1", "--resolution", "32", "32")

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="it forbids such names")


@pytest.mark.thorough(3)
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("suffix", ["obj", "blend"])
def test_every_file_may_have_any_name(tmp_path, name, suffix):
    folder = tmp_path / name
    folder.mkdir()
    (folder / f"{name}.obj").write_text(TRIANGLE)
    outputs = [f"{name} cubic.{suffix}", f"{name}.png", f"{name}.json"]
    before, after = ("--save-mesh", "--output", "--report"), outputs
    pairs = [f"{option}={value}" for option, value in zip(before, after, strict=True)]
    run = headless if (name, suffix) in ALONE else headless_shared
    headless_ok(f"./{name}.obj", *QUICK, *pairs, cwd=folder, run=run)
    assert sorted(p.name for p in folder.iterdir()) == sorted([f"{name}.obj", *outputs])
    assert list(tmp_path.iterdir()) == [folder], "something was written elsewhere"


def test_the_build_takes_any_name(tmp_path):
    build = Path(__file__).resolve().parents[2] / "scripts" / "build_extension.py"
    folder = tmp_path / NAMES[1]
    subprocess.run([sys.executable, build, folder / "-a 立.zip"], check=True, capture_output=True)
    assert [path.name for path in folder.iterdir()] == ["-a 立.zip"]
    shutil.rmtree(folder)
