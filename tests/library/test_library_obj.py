# SPDX-License-Identifier: GPL-3.0-or-later
"""Of .obj files, as other programs write them, only the positions are replaced."""

import numpy as np
import pytest
import trimesh
from command import QUICK, cubic_craft

OBJ = r"""# a cube with seams, groups and relative indices
mtllib cube.mtl
o Cube
v -1 -1 -1 # a comment
v 1 -1 -1 0.1 0.2 0.3
v 1 1 -1
v -1 1 -1
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vt 0.5 0.5
vn 0 0 -1
usemtl Red
s off
g bottom
f 4/1/1 3/2/1 2/3/1 1/4/1
v -1 -1 1
v 1 -1 \
  1
v 1 1 1
v -1 1 1
f -4/1 -3/2 -2/3 -1/5
g sides
f 1//1 2//1 6//1 5//1
f 2 3 7 6
usemtl Blue
f 3 4 8 7
f 4 1 5 8
l 1 2
"""


def rows(text, keyword):
    return [line.split()[1:] for line in text.splitlines() if line.split()[:1] == [keyword]]


def test_obj_to_obj_replaces_positions_only(tmp_path):
    (tmp_path / "cube.obj").write_text(OBJ, encoding="utf-8")
    angles = ("--orientation", "30", "40", "0")
    soft = ("--crispness", "0")
    cubic_craft("cube.obj", "cubic.obj", "--cubeness", "1", *soft, *angles, *QUICK, folder=tmp_path)
    before = OBJ.replace("\\\n", " ")
    after = (tmp_path / "cubic.obj").read_text(encoding="utf-8")
    for keyword in ("mtllib", "o", "vt", "usemtl", "s", "g", "l", "#"):
        assert rows(after, keyword) == rows(before, keyword)
    assert rows(after, "vn") == []  # they were those of the old shape
    faces = [[word.split("/") for word in row] for row in rows(before, "f")]
    without = [["/".join(word[:2]).rstrip("/") for word in face] for face in faces]
    assert rows(after, "f") == without
    vertices = rows(after, "v")
    assert vertices[0][3:] == ["#", "a", "comment"] and vertices[1][3:] == ["0.1", "0.2", "0.3"]
    moved = np.array([row[:3] for row in vertices], float) - np.array(
        [row[:3] for row in rows(before, "v")], float
    )
    assert (np.abs(moved).max(axis=1) > 0.004).all()
    others = [line.split()[0] for line in after.splitlines()]
    assert others == [x.split()[0] for x in before.splitlines() if x.split()[0] != "vn"]


@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_obj_without_cubeness_is_the_same_file(newline, tmp_path):
    content = OBJ.replace("\\\n  ", "").replace("\n", newline).encode()
    (tmp_path / "cube.obj").write_bytes(content)
    cubic_craft("cube.obj", "same.obj", "--cubeness", "0", *QUICK, folder=tmp_path)
    assert (tmp_path / "same.obj").read_bytes() == content


def test_obj_in_other_encodings_keeps_its_bytes(tmp_path):
    content = b"\xef\xbb\xbfo Ger\xe4t\n" + OBJ.replace("\\\n  ", "").encode()
    (tmp_path / "cube.obj").write_bytes(content)
    cubic_craft("cube.obj", "cubic.obj", *QUICK, folder=tmp_path)
    assert (tmp_path / "cubic.obj").read_bytes().startswith(b"o Ger\xe4t\n# a cube")


@pytest.mark.parametrize("name", ["表".encode("shift_jis"), "身体".encode("gbk"), b"mats\\"])
def test_names_that_end_in_the_byte_of_a_backslash_join_no_lines(name, tmp_path):
    lines = [b"o " + name, b"# C:\\models\\", *OBJ.replace("\\\n  ", "").encode().split(b"\n")]
    content = b"\n".join([b"usemtl " + name if x == b"usemtl Red" else x for x in lines])
    (tmp_path / "cube.obj").write_bytes(content)
    cubic_craft("cube.obj", "same.obj", "--cubeness", "0", *QUICK, folder=tmp_path)
    assert (tmp_path / "same.obj").read_bytes() == content


def test_obj_to_ply_has_the_right_faces(tmp_path):
    (tmp_path / "cube.obj").write_text(OBJ, encoding="utf-8")
    cubic_craft("cube.obj", "cubic.ply", *QUICK, folder=tmp_path)
    made = trimesh.load_mesh(tmp_path / "cubic.ply", process=False)
    assert made.is_watertight and made.volume > 4.0 and len(made.faces) == 12


def test_an_obj_names_the_materials_of_its_input_from_another_folder(tmp_path):
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "skin.mtl").write_text("newmtl skin\n")
    text = "mtllib skin.mtl\nmtllib none.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl skin\nf 1 2 3\n"
    (tmp_path / "in" / "a.obj").write_text(text)
    cubic_craft("in", "out", *QUICK, folder=tmp_path)
    lines = (tmp_path / "out" / "a.obj").read_text().splitlines()
    assert lines[:2] == ["mtllib ../in/skin.mtl", "mtllib none.mtl"]
    cubic_craft("in/a.obj", "in/b.obj", *QUICK, folder=tmp_path)
    assert (tmp_path / "in" / "b.obj").read_text().startswith("mtllib skin.mtl\n")
