# SPDX-License-Identifier: GPL-3.0-or-later
"""What meshio gets wrong in .obj and .ply files, as other programs write them, is right here."""

import struct

import meshio
import numpy as np
import pytest
from command import QUICK, cubic_craft

from scripts.benchmark.shapes import blob

V, F = blob(1)

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
    quads = meshio.read(tmp_path / "cubic.ply").cells_dict["quad"]
    assert quads.tolist() == [
        *([3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7])
    ]


def binary_ply(color="uchar", corners="vertex_indices", newline="\n", order="<"):
    """Return a .ply file as scanners write it, with colors above 127."""
    kind = "little" if order == "<" else "big"
    header = [
        *("ply", f"format binary_{kind}_endian 1.0", "comment by hand"),
        *(f"element vertex {len(V)}", *(f"property float {axis}" for axis in "xyz")),
        *(f"property {color} {channel}" for channel in ("red", "green", "blue")),
        *(f"element face {len(F)}", f"property list uchar int {corners}", "end_header", ""),
    ]
    vertices = [
        struct.pack(f"{order}3f3B", *v, 200, 130, number % 256) for number, v in enumerate(V)
    ]
    faces = [struct.pack(f"{order}B3i", 3, *face) for face in F]
    return newline.join(header).encode() + b"".join(vertices + faces)


@pytest.mark.parametrize(
    "how",
    [{}, {"color": "uint8"}, {"corners": "vertex_index"}, {"newline": "\r\n"}, {"order": ">"}],
    ids=str,
)
def test_colors_and_faces_of_binary_ply(how, tmp_path):
    (tmp_path / "blob.ply").write_bytes(binary_ply(**how))
    assert len(cubic_craft("blob.ply", "cubic.ply", *QUICK, folder=tmp_path)) == 1
    header = (tmp_path / "cubic.ply").read_bytes().partition(b"end_header")[0]
    assert b"property uint8 red" in header and b"property float x" in header
    mesh = meshio.read(tmp_path / "cubic.ply")
    assert np.array_equal(mesh.cells_dict["triangle"], F)
    assert (mesh.point_data["red"] == 200).all() and (mesh.point_data["green"] == 130).all()
    assert np.array_equal(mesh.point_data["blue"], np.arange(len(V)) % 256)


def test_ascii_ply(tmp_path):
    lines = [
        *("ply", "format ascii 1.0", "element vertex 4", "property float x", "property float y"),
        *("property float z", "property uchar red", "element face 4"),
        *("property list uchar uint vertex_index", "end_header"),
        *("0 0 0 255", "1 0 0 1", "0 1 0 2", "0 0 1 3", "3 0 2 1", "3 0 1 3", "3 1 2 3", "3 2 0 3"),
    ]
    (tmp_path / "a.ply").write_text("\n".join(lines) + "\n")
    cubic_craft("a.ply", "cubic.ply", *QUICK, folder=tmp_path)
    mesh = meshio.read(tmp_path / "cubic.ply")
    assert mesh.point_data["red"].tolist() == [255, 1, 2, 3]
    assert mesh.cells_dict["triangle"].tolist() == [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]
