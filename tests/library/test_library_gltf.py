# SPDX-License-Identifier: GPL-3.0-or-later
"""A glTF file keeps all but positions, normals and tangents, and is solved as its nodes stand."""

import json

import numpy as np
import pytest
import trimesh
from command import QUICK, cubic_craft, quick
from scipy.spatial.transform import Rotation

from cubic_craft.command_line.gltf_data import GltfData
from cubic_craft.command_line.gltf_file import GltfFile, write_surface
from cubic_craft.command_line.mesh_files import read
from cubic_craft.command_line.program import run
from scripts.benchmark.shapes import blob

V, F = blob(2)
V = V.astype(np.float32).astype(float)
NORMALS = (V / np.linalg.norm(V, axis=1, keepdims=True)).astype(np.float32)
TURN = Rotation.from_euler("xyz", [20, 30, 40], degrees=True)
NODE = {"translation": [3.0, 0, 1], "rotation": TURN.as_quat().tolist(), "scale": [2.0] * 3}


def save(path, change=lambda data: None):
    write_surface(path, V, F)
    data = GltfData.read(path)
    data.tree["materials"] = [{"name": "clay", "extras": {"number": 7}}]
    normals = data.add(NORMALS, componentType=5126, type="VEC3")
    tangents = np.append(NORMALS[:, [1, 2, 0]], np.ones((len(V), 1), np.float32), axis=1)
    primitive = data.tree["meshes"][0]["primitives"][0]
    primitive["material"] = 0
    primitive["attributes"] |= {
        "NORMAL": normals,
        "TANGENT": data.add(tangents, componentType=5126, type="VEC4"),
    }
    change(data)
    data.write(path)
    return path.name


@pytest.mark.parametrize("ending", [".glb", ".gltf"])
@pytest.mark.parametrize("to", [".glb", ".gltf"])
def test_all_but_the_shape_stays(ending, to, tmp_path):
    name = save(tmp_path / f"blob{ending}")
    (line,) = cubic_craft(name, f"cubic{to}", *QUICK, folder=tmp_path)
    assert "162 vertices, 320 faces" in line
    before, after = (GltfData.read(tmp_path / each) for each in (name, f"cubic{to}"))
    result = quick(V, F)
    low = after.tree["accessors"][0].pop("min")
    assert np.allclose(low, result.positions.min(axis=0), atol=1e-6)
    for tree in (before.tree, after.tree):
        for key in ("min", "max"):
            tree["accessors"][0].pop(key, None)
    assert after.tree == before.tree
    assert np.allclose(after.accessor(0), result.positions, atol=1e-6)
    assert np.array_equal(after.accessor(1), before.accessor(1))
    for number in (2, 3):
        turned = np.einsum("nij,nj->ni", result.rotations, before.accessor(number)[:, :3])
        assert np.allclose(after.accessor(number)[:, :3], turned, atol=1e-5)
        assert np.array_equal(after.accessor(number)[:, 3:], before.accessor(number)[:, 3:])


def test_nodes_place_their_meshes(tmp_path):
    def place(data):
        data.tree["nodes"] = [{"children": [1], "translation": [1, 0, 0]}, {"mesh": 0, **NODE}]

    name = save(tmp_path / "blob.glb", place)
    placed = 2.0 * TURN.apply(V) + [4.0, 0.0, 1.0]
    assert np.allclose(read(tmp_path / name).surface.points, placed)
    cubic_craft(name, "cubic.glb", *QUICK, folder=tmp_path)
    result = quick(placed, F)
    assert np.allclose(GltfFile(tmp_path / "cubic.glb").points, result.positions, atol=1e-5)
    normals = TURN.inv().apply(
        np.einsum("nij,nj->ni", result.rotations, TURN.apply(NORMALS.astype(float)))
    )
    assert np.allclose(GltfData.read(tmp_path / "cubic.glb").accessor(2), normals, atol=1e-5)


def test_other_programs_read_it_and_are_read(tmp_path):
    mesh = trimesh.Trimesh(V, F, process=False)
    (tmp_path / "blob.glb").write_bytes(mesh.export(file_type="glb"))
    cubic_craft("blob.glb", "cubic.glb", *QUICK, folder=tmp_path)
    made = trimesh.load(tmp_path / "cubic.glb", force="mesh", process=False)
    assert np.allclose(made.vertices, quick(V, F).positions, atol=1e-5)
    assert np.array_equal(made.faces, F)


def test_other_formats_become_gltf_and_back(tmp_path):
    mesh = trimesh.Trimesh(V, F, process=False)
    mesh.export(tmp_path / "blob.ply")
    cubic_craft("blob.ply", "a.glb", *QUICK, folder=tmp_path)
    cubic_craft("a.glb", "b.obj", "--cubeness", "0", *QUICK, folder=tmp_path)
    for name in ("a.glb", "b.obj"):
        surface = read(tmp_path / name).surface
        assert np.allclose(surface.points, quick(V, F).positions, atol=1e-5)
        assert np.array_equal(surface.triangles, F)


def of_primitive(**values):
    def change(data):
        data.tree["meshes"][0]["primitives"][0].update(values)

    return change


def of_tree(**values):
    return lambda data: data.tree.update(values)


def compressed(data):
    del data.tree["accessors"][0]["bufferView"]


def too_long(data):
    data.tree["accessors"][0]["count"] = 10**9


def shorts(data):
    data.tree["accessors"][0]["componentType"] = 5122


TWICE = [{"mesh": 0}, {"mesh": 0, "translation": [9, 0, 0]}]
REFUSED = {
    "strip": (of_primitive(mode=5), "strips or fans"),
    "lines": (of_primitive(mode=1), "no faces"),
    "twice": (of_tree(nodes=TWICE), "used in several places"),
    "flat": (of_tree(nodes=[{"mesh": 0, "scale": [1, 1, 0]}]), "a scale of zero"),
    "compressed": (compressed, "sparse or compressed"),
    "quantized": (shorts, "positions are compressed"),
    "too long": (too_long, "its data is cut off"),
    "no mesh": (of_tree(nodes=[{"mesh": 5}]), "IndexError"),
    "loop": (of_tree(nodes=[{"mesh": 0, "children": [0]}]), "no faces"),
}


def refused(path, capsys):
    """Run the command in this process, which must refuse with one line, and return the line."""
    assert run([str(path), str(path.with_name("out.glb")), *QUICK]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"cubic-craft: error: {path}: ")
    assert not path.with_name("out.glb").exists()
    return line


@pytest.mark.parametrize("name", REFUSED)
def test_what_cannot_be_replaced_is_refused(name, tmp_path, capsys):
    change, words = REFUSED[name]
    save(tmp_path / "a.glb", change)
    assert words in refused(tmp_path / "a.glb", capsys)


def test_broken_files_and_references_are_refused(tmp_path, capsys):
    save(tmp_path / "whole.glb")
    whole = (tmp_path / "whole.glb").read_bytes()
    texts = b"hello", b"[]", b'{"buffers":[3]}', b'{"a":' + b"[" * 100_000
    for content in (whole[:5], whole[:200], whole[:-9], *texts):
        (tmp_path / "cut.gltf").write_bytes(content)
        refused(tmp_path / "cut.gltf", capsys)
    tree = {"asset": {"version": "2.0"}, "buffers": [{"uri": "secret.bin", "byteLength": 4}]}
    (tmp_path / "refers.gltf").write_text(json.dumps(tree))
    (tmp_path / "secret.bin").write_bytes(b"1234")
    assert "lies in 'secret.bin'" in refused(tmp_path / "refers.gltf", capsys)
