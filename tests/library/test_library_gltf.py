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
    assert np.allclose(after.values(0), result.positions, atol=1e-6)
    assert np.array_equal(after.values(1), before.values(1))
    for number in (2, 3):
        turned = np.einsum("nij,nj->ni", result.rotations, before.values(number)[:, :3])
        assert np.allclose(after.values(number)[:, :3], turned, atol=1e-5)
        assert np.array_equal(after.values(number)[:, 3:], before.values(number)[:, 3:])


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
    assert np.allclose(GltfData.read(tmp_path / "cubic.glb").values(2), normals, atol=1e-5)


def test_other_programs_read_it_and_are_read(tmp_path):
    mesh = trimesh.Trimesh(V, F, process=False)
    (tmp_path / "blob.glb").write_bytes(mesh.export(file_type="glb"))
    cubic_craft("blob.glb", "cubic.glb", *QUICK, folder=tmp_path)
    made = trimesh.load(tmp_path / "cubic.glb", force="mesh", process=False)
    assert np.allclose(made.vertices, quick(V, F).positions, atol=1e-5)
    assert np.array_equal(made.faces, F)


def solved(tmp_path, change):
    """Return the data of a changed file before and after, and the lines of the command."""
    name = save(tmp_path / "a.glb", change)
    lines = cubic_craft(name, "b.glb", *QUICK, folder=tmp_path)
    return GltfData.read(tmp_path / name), GltfData.read(tmp_path / "b.glb"), lines


def shown(path):
    file = GltfFile(path)
    return file.points, file.triangles


def shell(data, scale=(1, 1, 1)):
    """Add a node with a larger copy of the ball, which the scale of its node mirrors, too."""
    points = (1.1 * V * scale).astype(np.float32)
    position = data.add(points, componentType=5126, type="VEC3")
    faces = F if np.prod(scale) > 0 else F[:, ::-1]
    corners = data.add(faces.astype(np.uint32).ravel(), componentType=5125, type="SCALAR")
    primitive = {"attributes": {"POSITION": position}, "indices": corners}
    data.tree["meshes"].append({"primitives": [primitive]})
    data.tree["nodes"].append({"mesh": 1, "scale": list(scale)})


def test_a_mirrored_node_is_as_if_its_vertices_were_mirrored(tmp_path):
    both = {}
    for sign in (1, -1):

        def change(data, sign=sign):
            shell(data, (sign, 1, 1))
            data.tree["scenes"][0]["nodes"] = [0, 1]

        solved(tmp_path, change)
        both[sign] = shown(tmp_path / "b.glb")[0]
    assert np.allclose(both[1], both[-1], atol=1e-5)


def test_what_is_not_shown_is_neither_solved_nor_changed(tmp_path):
    before, after, lines = solved(tmp_path, shell)  # in no scene
    assert np.allclose(shown(tmp_path / "b.glb")[0], quick(V, F).positions, atol=1e-5)
    assert np.array_equal(after.values(4), before.values(4)) and len(lines) == 1

    def change(data):
        shell(data)
        data.tree["scenes"].append({"nodes": [1]})

    before, after, lines = solved(tmp_path, change)
    assert np.array_equal(after.values(4), before.values(4))
    assert lines[1] == "cubic-craft: note: only the scene that is shown first is changed"


def boned(turn):
    """Put the ball, in centimeters, on a bone that turns it."""

    def change(data):
        data.stored(data.tree["accessors"][0], len(V), 5126, 3)[:] = 100.0 * V
        at_rest = np.diag([0.01, 0.01, 0.01, 1.0]).astype(np.float32)
        attributes = data.tree["meshes"][0]["primitives"][0]["attributes"]
        joints, weights = np.zeros((len(V), 4), np.uint8), np.zeros((len(V), 4), np.uint8)
        weights[:, 0] = 255
        attributes["JOINTS_0"] = data.add(joints, componentType=5121, type="VEC4")
        whole = {"componentType": 5121, "normalized": True}
        attributes["WEIGHTS_0"] = data.add(weights, type="VEC4", **whole)
        inverse = data.add(at_rest.reshape(1, 16), componentType=5126, type="MAT4")
        data.tree["skins"] = [{"joints": [1], "inverseBindMatrices": inverse}]
        data.tree["nodes"] = [
            {"mesh": 0, "skin": 0, "translation": [50, 0, 0]},
            {"rotation": turn.as_quat().tolist(), "translation": [0, 0, 3]},
        ]
        data.tree["scenes"][0]["nodes"] = [0, 1]

    return change


def test_bones_place_their_vertices_and_stay(tmp_path):
    before, after, _ = solved(tmp_path, boned(TURN))
    placed = TURN.apply(V) + [0, 0, 3]
    assert np.allclose(shown(tmp_path / "a.glb")[0], placed, atol=1e-5)
    result = quick(placed, F)
    assert np.allclose(shown(tmp_path / "b.glb")[0], result.positions, atol=1e-4)
    assert after.tree["skins"] == before.tree["skins"]
    assert after.tree["nodes"] == before.tree["nodes"]
    normals = np.einsum("nij,nj->ni", result.rotations, TURN.apply(NORMALS.astype(float)))
    assert np.allclose(after.values(2), TURN.inv().apply(normals), atol=1e-4)


@pytest.mark.parametrize(("kind", "dtype"), [(5120, np.int8), (5122, np.int16)])
def test_normals_that_are_stored_as_integers_stay_normals(kind, dtype, tmp_path):
    def change(data):
        stored = np.zeros((len(V), 4), dtype)
        stored[:, :3] = np.round(NORMALS * np.iinfo(dtype).max)
        normals = data.add(stored, componentType=kind, type="VEC3", normalized=True)
        view = data.tree["accessors"][normals]["bufferView"]
        data.tree["bufferViews"][view]["byteStride"] = 4 * stored.itemsize
        data.tree["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = normals

    _, after, _ = solved(tmp_path, change)
    (primitive,) = after.tree["meshes"][0]["primitives"]
    turned = np.einsum("nij,nj->ni", quick(V, F).rotations, NORMALS)
    found = after.values(primitive["attributes"]["NORMAL"])
    assert np.allclose(found, turned, atol=0.02)


def test_sparse_positions_are_read_whole(tmp_path):
    def change(data):
        values = data.add(np.full((2, 3), 0.25, np.float32), componentType=5126, type="VEC3")
        rows = data.add(np.array([3, 7], np.uint16), componentType=5123, type="SCALAR")
        views = [data.tree["accessors"][each]["bufferView"] for each in (rows, values)]
        data.tree["accessors"][0]["sparse"] = {
            "count": 2,
            "indices": {"bufferView": views[0], "componentType": 5123},
            "values": {"bufferView": views[1]},
        }

    points = V.copy()
    points[[3, 7]] = 0.25
    save(tmp_path / "a.glb", change)
    assert np.allclose(shown(tmp_path / "a.glb")[0], points)
    cubic_craft("a.glb", "b.glb", *QUICK, folder=tmp_path)
    assert np.allclose(shown(tmp_path / "b.glb")[0], quick(points, F).positions, atol=1e-4)


def of_primitive(**values):
    def change(data):
        data.tree["meshes"][0]["primitives"][0].update(values)

    return change


def of_tree(**values):
    return lambda data: data.tree.update(values)


def nowhere(data):
    del data.tree["accessors"][0]["bufferView"]


def too_long(data):
    data.tree["accessors"][0]["count"] = 10**9


MESHOPT = "EXT_meshopt_compression"
INSTANCES = {"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {}}}
REFUSED = {
    "strip": (of_primitive(mode=5), "strips or fans"),
    "lines": (of_primitive(mode=1), "no faces"),
    "flat": (of_tree(nodes=[{"mesh": 0, "scale": [1, 1, 0]}]), "a scale of zero"),
    "nowhere": (nowhere, "stored nowhere"),
    "compressed": (of_tree(extensionsUsed=[MESHOPT]), f"compressed ({MESHOPT}); export it without"),
    "instances": (of_tree(nodes=[INSTANCES]), "instances of a node; make them nodes"),
    "too long": (too_long, "its data is cut off"),
    "no mesh": (of_tree(nodes=[{"mesh": 5}]), "IndexError"),
    "loop": (of_tree(nodes=[{"mesh": 0, "children": [0]}]), "KeyError"),
    "no scene": (of_tree(scene=3), "IndexError"),
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
