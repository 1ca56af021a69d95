# SPDX-License-Identifier: GPL-3.0-or-later
"""Bad input: one line on standard error, exit code 2, and nothing written."""

import struct
from pathlib import Path

import pytest
from headless import headless, headless_ok, headless_refused, headless_shared, make_blend

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
STL = """solid triangle
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 NaN 0
endloop
endfacet
endsolid
"""
PLY_HEADER = b"""ply
format binary_little_endian 1.0
element vertex 3
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
"""

RUNS = """
import sys
import bpy
from pathlib import Path
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.mesh.primitive_cube_add()
bpy.context.preferences.filepaths.save_version = 0
def touch(name):
    return f"__import__('pathlib').Path({str(Path(sys.argv[1]).with_name(name))!r}).touch()"
driver = bpy.context.object.driver_add("location", 0).driver
driver.type, driver.expression = "SCRIPTED", touch("driver") + " or 0"
text = bpy.data.texts.new("start.py")
text.write(touch("text"))
text.use_module = True
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[1])
"""

# arguments, and what the one line must name. Refused before Blender starts.
OPTIONS = {
    "negative cubeness": (["ok.obj", "--cubeness", "-0.1"], ["--cubeness", "-0.1", "0 and 10"]),
    "input last": (["--cubeness", "0.4", "ok.obj"], ["ok.obj", "not a number", "first"]),
    "device": (["ok.obj", "--device", "tpu"], ["--device", "tpu", "numpy"]),
    "faces of none": (["ok.obj", "--form", "faces"], ["--form faces", "--form-directions"]),
    "unknown option": (["ok.obj", "--cubenes", "1"], ["--cubenes"]),
    "missing file": (["none.obj"], ["none.obj", "no such file"]),
    "a folder": (["folder.obj"], ["folder.obj", "--output-folder"]),
    "unknown format": (["ok.xyz"], ["ok.xyz", ".xyz", ".obj"]),
    "no suffix": (["ok"], ["ok", "suffix"]),
    "empty file": (["empty.obj"], ["empty.obj", "empty"]),
    "output folder": (["ok.obj", "--output", "none/a.png"], ["--output", "none", "create it"]),
    "output is a folder": (["ok.obj", "--output", "folder.png"], ["--output", "folder"]),
    "output format": (["ok.obj", "--output", "a.jpg"], ["--output", "a.jpg", ".png"]),
    "report format": (["ok.obj", "--report", "a.txt"], ["--report", "a.txt", ".json"]),
    "read-only": (["ok.obj", "--report", "/proc/a.json"], ["--report", "/proc"]),
    "gltf": (["ok.obj", "--save-mesh", "a.gltf"], ["--save-mesh", ".glb, .fbx", ".obj"]),
    "levels": (["ok.obj", "--save-mesh", "a.obj", "--low-poly", "9"], ["--low-poly", "12"]),
    "over the input": (["ok.obj", "--save-mesh", "ok.obj"], ["--save-mesh", "input"]),
    "nothing to do": (["ok.obj", "--no-render"], ["--no-render", "--save-mesh"]),
    "contradiction": (["ok.obj", "--no-render", "--output", "a.png"], ["--no-render", "--output"]),
}

# These need Blender.
CONTENT = {
    "text as .obj": (["prose.obj"], ["prose.obj", "no mesh"]),
    "noise as .stl": (["noise.stl"], ["noise.stl"]),
    "noise as .blend": (["noise.blend"], ["noise.blend", "cannot be read"]),
    "noise as .glb": (["noise.glb"], ["noise.glb", "cannot be read"]),
    "noise as .usdc": (["noise.usdc"], ["noise.usdc", "cannot be read"]),
    "Alembic cut off": (["cut.abc"], ["cut.abc", "crashes Blender"]),
    "no faces": (["points.obj"], ["points.obj", "without faces"]),
    "not a number": (["nan.obj"], ["nan.obj", "vertex 3", "finite"]),
    "infinite binary .ply": (["inf.ply"], ["inf.ply", "vertex 2", "finite"]),
    "infinite text .ply": (["text.ply"], ["text.ply", "vertex 2", "finite"]),
    "infinite binary .stl": (["inf.stl"], ["inf.stl", "vertex 2", "finite"]),
    "infinite text .stl": (["text.stl"], ["text.stl", "vertex 2", "finite"]),
    "no such object": (["ok.obj", "--object", "Cube"], ["--object", "Cube", '"ok"']),
    "no such pin group": (["ok.obj", "--pin", "hand"], ["--pin", "hand", "vertex group"]),
    "no such region group": (
        ["ok.obj", "--region", "hand:cone:1"],
        ["--region", "hand", "vertex group"],
    ),
    "no region": (["ok.obj", "--region", "hand:cone"], ["GROUP:FORM:CUBENESS", "hand:cone"]),
    "no form of a region": (["ok.obj", "--region", "hand:cow:1"], ["'cow' is none of cube"]),
    "no sides of a form": (["ok.obj", "--region", "hand:cube5:1"], ["GROUP:FORM:CUBENESS"]),
    "no directions": (
        ["ok.obj", "--form", "faces", "--form-directions", "up"],
        ['"up" is not a list of directions'],
    ),
    "no such map group": (["ok.obj", "--map", "hand"], ["--map", "hand", "vertex group"]),
}


ALONE = ("input last", "noise as .blend", "noise as .usdc", "Alembic cut off")
"""cases for a process of its own, which might crash or speak at its end; `test_corpus` has more"""


@pytest.fixture
def folder(tmp_path, inputs):
    (tmp_path / "ok.obj").write_text(TRIANGLE)
    (tmp_path / "ok.xyz").write_text("0 0 0\n")
    (tmp_path / "ok").write_text(TRIANGLE)
    (tmp_path / "empty.obj").write_text("")
    (tmp_path / "prose.obj").write_text("It was a dark and stormy night.\n")
    (tmp_path / "points.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\n")
    (tmp_path / "nan.obj").write_text(TRIANGLE.replace("0 1 0", "0 nan 0"))
    infinite = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, float("inf"), 0)
    (tmp_path / "inf.ply").write_bytes(PLY_HEADER + infinite + struct.pack("<B3i", 3, 0, 1, 2))
    header = PLY_HEADER.replace(b"binary_little_endian", b"ascii")
    (tmp_path / "text.ply").write_bytes(header + b"0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n")
    count = struct.pack("<80xI", 1)
    (tmp_path / "inf.stl").write_bytes(count + struct.pack("<3f", 0, 0, 1) + infinite + bytes(2))
    (tmp_path / "text.stl").write_text(STL)
    for name in ("noise.stl", "noise.blend", "noise.glb", "noise.usdc"):
        (tmp_path / name).write_bytes(bytes(range(7, 207)) * 5)
    whole = (inputs / "awkward.abc").read_bytes()
    (tmp_path / "cut.abc").write_bytes(whole[: len(whole) // 2])
    (tmp_path / "folder.obj").mkdir()
    (tmp_path / "folder.png").mkdir()
    return tmp_path


@pytest.mark.thorough(14)
@pytest.mark.parametrize("case", [*OPTIONS, *CONTENT])
def test_refusal(folder, case):
    arguments, words = (OPTIONS | CONTENT)[case]
    run = headless if case in ALONE else headless_shared
    headless_refused(*arguments, words=words, cwd=folder, run=run)


def test_refusal_keeps_the_old_file(folder):
    """A file of an earlier run is as it was when a later run is refused."""
    old = Path(folder, "result.obj")
    old.write_text(TRIANGLE)
    process = headless_shared(
        *("ok.obj", "--no-render", "--save-mesh", "result.obj", "--pin", "hand"), cwd=folder
    )
    assert process.returncode == 2
    assert old.read_text() == TRIANGLE


def test_nothing_in_a_blend_runs(tmp_path):
    make_blend(RUNS, tmp_path / "file.blend")
    before = sorted(tmp_path.iterdir())
    headless_ok("file.blend", "--no-render", "--report", "r.json", cwd=tmp_path)
    assert sorted(tmp_path.iterdir()) == [*before, tmp_path / "r.json"]
