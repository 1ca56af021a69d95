# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that go from one Blender to another: without the extension and back, and to a newer one.

``CUBIC_CRAFT_OLDER_PYTHON=path`` names a Python with an older bpy, as ``make test-reliability`` has
it; without it the file stays in this one. The other way is closed by Blender itself: 4.2 refuses
files of Blender 5.
"""

import os
import subprocess
import sys
from pathlib import Path

import bpy
import pytest

VISIT = Path(__file__).with_name("visit.py")
OLDER = os.environ.get("CUBIC_CRAFT_OLDER_PYTHON")


def visit(python, what, file, *archive):
    done = subprocess.run(
        [python, VISIT, what, file, *archive],
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert "done in" in done.stdout, done.stderr
    return done.stdout.split("done in ")[1].strip()


@pytest.mark.thorough
def test_without_the_extension_and_back(tmp_path, archive):
    file = tmp_path / "file.blend"
    visit(sys.executable, "make", file, archive)
    visit(sys.executable, "save", file)
    visit(sys.executable, "restore", file, archive)


@pytest.mark.skipif(not OLDER, reason="no older bpy is named")
@pytest.mark.parametrize("without", [False, True], ids=["with", "without"])
def test_a_file_of_an_older_blender(tmp_path, archive, without):
    """Made there and restored here, perhaps saved here without the extension in between."""
    file = tmp_path / "file.blend"
    made = visit(OLDER, "make", file, archive)
    if without:
        visit(sys.executable, "save", file)
    restored = visit(sys.executable, "restore", file, archive)
    assert made != restored and bpy.app.version_string == restored
