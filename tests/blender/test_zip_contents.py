# SPDX-License-Identifier: GPL-3.0-or-later
"""The zip of the extension has the rooms that Blender needs, and nothing else of the repository."""

import zipfile
from pathlib import PurePosixPath

ROOMS = {"cubic_craft_addon", "operators", "solver"}
FILES = {"__init__.py", "blender_manifest.toml", "LICENSE", "README.md"}


def test_it_has_these_rooms_and_files(archive):
    names = [PurePosixPath(name) for name in zipfile.ZipFile(archive).namelist()]
    top = {name.parts[0] for name in names}
    assert top == ROOMS | FILES
    suffixes = {name.suffix for name in names if name.parts[0] in ROOMS and name.suffix}
    assert suffixes <= {".py", ".png"}
