# SPDX-License-Identifier: GPL-3.0-or-later
"""Each example for Blender runs as it is written, warns of nothing, and makes its picture.

``CUBIC_CRAFT_PICTURES=folder`` keeps the pictures there, as large as `make example-pictures` has
them.
"""

import os
import runpy
import sys
from pathlib import Path

import bpy
import pytest

EXAMPLES = Path(__file__).parents[2] / "examples"
SHARED = "studio"
NAMES = sorted(path.stem for path in EXAMPLES.glob("*.py") if path.stem != SHARED)
KEPT = os.environ.get("CUBIC_CRAFT_PICTURES")
QUICK = {"WIDTH": 160, "HEIGHT": 80, "SAMPLES": 1, "LEVELS": 1, "VOXEL": 0.09}


@pytest.mark.thorough(1)  # not the forms, whose kernels take long to compile
@pytest.mark.parametrize("name", NAMES)
def test_example_makes_its_picture(name, tmp_path, monkeypatch):
    monkeypatch.syspath_prepend(str(EXAMPLES))
    import studio

    picture = tmp_path / f"example_{name}.png"
    if not KEPT:
        for setting, value in QUICK.items():
            monkeypatch.setattr(studio, setting, value)
    monkeypatch.setattr(sys, "argv", ["blender", "--", str(picture)])
    runpy.run_path(str(EXAMPLES / f"{name}.py"), run_name="__main__")
    assert picture.stat().st_size > 1000
    assert any("cubic_craft_original" in mesh.attributes for mesh in bpy.data.meshes)
    if KEPT:
        picture.replace(Path(KEPT) / picture.name)
