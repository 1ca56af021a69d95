# SPDX-License-Identifier: GPL-3.0-or-later
"""Results for game engines and printers: what is in the files, and what happens to the vertices."""

import struct
import zlib

import numpy as np
import pytest
from batch_kit import QUICK, batch, files_in, statuses
from glb import Glb
from headless import headless_ok, read_files

BOX = """mtllib first.mtl
mtllib box.mtl
o box
v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 0 0 1\nv 1 0 1\nv 1 2 1\nv 0 2 1
vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1
usemtl skin
f 1/1 4/2 3/3 2/4\nf 5/1 6/2 7/3 8/4\nf 1/1 2/2 6/3 5/4
f 2/1 3/2 7/3 6/4\nf 3/1 4/2 8/3 7/4\nf 4/1 1/2 5/3 8/4
"""
PNG = b"\x89PNG\r\n\x1a\n"


def png():
    """Return a red picture of 2 x 2 pixels."""

    def chunk(name, data):
        return (
            struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
        )

    head = chunk(b"IHDR", struct.pack(">IIBBBBB", 2, 2, 8, 2, 0, 0, 0))
    rows = zlib.compress((b"\0" + b"\xff\0\0" * 2) * 2)
    return PNG + head + chunk(b"IDAT", rows) + chunk(b"IEND", b"")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Folder with a textured box, and its results in all these formats."""
    folder = tmp_path_factory.mktemp("engines")
    (folder / "in").mkdir()
    (folder / "in" / "box.obj").write_text(BOX)
    (folder / "in" / "first.mtl").write_text("newmtl other\nKd 0 0 1\n")
    (folder / "in" / "box.mtl").write_text("newmtl skin\nKd 1 1 1\nmap_Kd red.png\n")
    (folder / "in" / "red.png").write_bytes(png())
    for suffix in (".obj", ".glb", ".fbx", ".stl"):
        arguments = ("--no-render", "--save-mesh", f"box{suffix}")
        headless_ok("in/box.obj", *QUICK, *arguments, cwd=folder)
    return folder


@pytest.fixture(scope="module")
def points(folder):
    """Return the vertices of the result as it is in the .obj, numbered as in the input."""
    lines = (folder / "box.obj").read_text().splitlines()
    return np.array([line.split()[1:] for line in lines if line[:2] == "v "], float)


def test_a_glb_has_the_texture_and_the_number_of_each_vertex(folder, points):
    glb = Glb(folder / "box.glb")
    found, (primitive,) = glb.json, glb.json["meshes"][0]["primitives"]
    numbers = glb.array(primitive["attributes"]["_VERTEX"]).astype(int)
    assert len(numbers) > len(points), "corners are split at the seams"
    moved = glb.array(primitive["attributes"]["POSITION"])
    half = 0.5**0.5  # a quarter turn about X, as Blender reads an .obj
    np.testing.assert_allclose(found["nodes"][0]["rotation"], [half, 0, 0, half], atol=1e-6)
    np.testing.assert_allclose(moved[:, [0, 2, 1]] * [1, -1, 1], points[numbers], atol=1e-6)
    assert "TEXCOORD_0" in primitive["attributes"]
    (image,) = found["images"]
    assert image["mimeType"] == "image/png" and PNG in (folder / "box.glb").read_bytes()


def test_an_fbx_has_the_texture_and_the_order_of_vertices(folder, points):
    (found,) = read_files(folder / "box.fbx", folder=folder)
    ((own, faces, place, _),) = found.values()
    world = own.astype(float) @ place[:3, :3].T + place[:3, 3]
    np.testing.assert_allclose(world[:, [0, 2, 1]] * [1, 1, -1], points, atol=1e-5)
    assert len(faces) == 6
    assert PNG in (folder / "box.fbx").read_bytes()


def test_an_stl_has_the_size_of_the_file(folder, points):
    data = (folder / "box.stl").read_bytes()
    count = struct.unpack_from("<I", data, 80)[0]
    rows = np.frombuffer(data, np.uint8, offset=84).reshape(count, 50)[:, 12:48]
    corners = np.unique(rows.copy().view(np.float32).reshape(-1, 3).round(5), axis=0)
    upright = np.unique((points[:, [0, 2, 1]] * [1, -1, 1]).astype(np.float32).round(5), axis=0)
    assert count == 12
    np.testing.assert_allclose(np.sort(corners, axis=0), np.sort(upright, axis=0), atol=1e-4)


def test_an_obj_has_the_materials_of_its_input(folder):
    """Both of its libraries are read, and their images are named as they lie."""
    assert "mtllib box.mtl" in (folder / "box.obj").read_text().splitlines()
    lines = (folder / "box.mtl").read_text().splitlines()
    assert "newmtl skin" in lines and "map_Kd in/red.png" in lines


def test_an_obj_of_another_format_gets_its_materials_and_textures(folder, tmp_path):
    (tmp_path / "box.glb").write_bytes((folder / "box.glb").read_bytes())
    headless_ok("box.glb", *QUICK, "--no-render", "--save-mesh", "new.obj", cwd=tmp_path)
    assert "mtllib new.mtl" in (tmp_path / "new.obj").read_text().splitlines()
    assert "map_Kd new_red.png" in (tmp_path / "new.mtl").read_text().splitlines()
    assert (tmp_path / "new_red.png").read_bytes() == png()
    assert "newmtl skin" in (tmp_path / "new.mtl").read_text()


def test_levels_of_detail_have_normal_maps_and_are_done_once(folder, tmp_path):
    monkey = tmp_path / "monkey.ply"
    headless_ok("--no-render", "--save-mesh", monkey, "--cubeness", 0, *QUICK, cwd=tmp_path)
    options = ("--save-mesh", ".glb", "--low-poly", 900, 90, "--no-render", *QUICK)
    for status in ("done", "kept"):
        process = batch(monkey, "--report", "report.json", cwd=tmp_path, options=options)
        assert process.returncode == 0, process.stderr
        assert statuses(tmp_path) == {"monkey.ply": status}
    names = ["monkey.glb", "monkey_lod1.glb", "monkey_lod2.glb"]
    assert files_in(tmp_path / "out") == names
    triangles = []
    for name in names:
        found = Glb(tmp_path / "out" / name).json
        (primitive,) = found["meshes"][0]["primitives"]
        triangles.append(found["accessors"][primitive["indices"]]["count"] // 3)
        if name != names[0]:
            assert "normalTexture" in found["materials"][0] and len(found["images"]) == 1
    assert triangles[0] > 10_000 and 450 < triangles[1] <= 900 and 45 < triangles[2] <= 90


def test_objects_that_share_a_mesh_share_its_levels(inputs, tmp_path):
    """One of the two has a modifier, which its low-poly mesh has in it."""
    arguments = ("--no-render", "--save-mesh", "two.glb", "--low-poly", 50)
    headless_ok(inputs / "awkward.blend", *QUICK, *arguments, cwd=tmp_path)
    found = Glb(tmp_path / "two_lod1.glb").json
    places = {node["name"]: (node["mesh"], "translation" in node) for node in found["nodes"]}
    assert places == {"awkward Low": (0, True), "twin Low": (0, False)}
    (mesh,) = found["meshes"]
    assert found["accessors"][mesh["primitives"][0]["indices"]]["count"] <= 3 * 50


def test_view_turns_the_objects_of_a_picture(tmp_path):
    (tmp_path / "box.obj").write_text("".join(f"{x}\n" for x in BOX.splitlines() if "mtl" not in x))
    small = ("--samples", 1, "--resolution", 120, 40, *QUICK)
    views = {"own.png": (), "same.png": ("--view", 32), "other.png": ("--view", 122)}
    for name, view in views.items():
        headless_ok("box.obj", *small, *view, "--output", name, cwd=tmp_path)
    own, same, other = read_files(*(tmp_path / name for name in views), folder=tmp_path)
    near, far = (float(np.abs(own - each).mean()) for each in (same, other))
    assert 4 * near < far
