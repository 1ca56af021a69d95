# SPDX-License-Identifier: GPL-3.0-or-later
"""A glTF file keeps nodes, materials, textures and UVs, and is solved as its nodes stand."""

import json

import numpy as np
import pytest
import trimesh
from command import QUICK, cubic_craft, quick, refused
from scipy.spatial.transform import Rotation

from cubic_craft.command_line.scene_file import read
from tests.icospheres import blob

V, F = blob(2)
V = V.astype(np.float32).astype(float)
NORMALS = V / np.linalg.norm(V, axis=1, keepdims=True)
TURN = np.eye(4)
TURN[:3, :3] = 2.0 * Rotation.from_euler("xyz", [20, 30, 40], degrees=True).as_matrix()
TURN[:3, 3] = 4.0, 0.0, 1.0


def save(path, *places, mesh=None):
    """Write a scene with a ball, or another mesh, in each of the places."""
    if mesh is None:
        mesh = trimesh.Trimesh(V, F, vertex_normals=NORMALS, process=False)
    scene = trimesh.Scene()
    for number, place in enumerate(places or [np.eye(4)]):
        scene.add_geometry(mesh, node_name=f"ball {number}", geom_name="ball", transform=place)
    scene.export(path, include_normals=True)
    return path.name


def loaded(path):
    """Return the first mesh of a file, as trimesh reads it."""
    scene = trimesh.load_scene(path, process=False)
    return next(iter(scene.geometry.values()))


@pytest.mark.parametrize("to", [".glb", ".gltf"])
def test_materials_and_uvs_stay_and_normals_turn(to, tmp_path):
    material = trimesh.visual.material.PBRMaterial(name="clay", roughnessFactor=0.25)
    visual = trimesh.visual.TextureVisuals(uv=V[:, :2], material=material)
    mesh = trimesh.Trimesh(V, F, vertex_normals=NORMALS, visual=visual, process=False)
    name = save(tmp_path / "blob.glb", mesh=mesh)
    (line,) = cubic_craft(name, f"cubic{to}", *QUICK, folder=tmp_path)
    assert "162 vertices, 320 faces" in line
    assert sorted(path.name for path in tmp_path.iterdir()) == ["blob.glb", f"cubic{to}"]
    made, result = loaded(tmp_path / f"cubic{to}"), quick(V, F)
    assert np.allclose(made.vertices, result.positions, atol=1e-5)
    assert np.array_equal(made.faces, F)
    turned = np.einsum("nij,nj->ni", result.rotations, NORMALS)
    assert np.allclose(made.vertex_normals, turned, atol=1e-5)
    assert (made.visual.material.name, made.visual.material.roughnessFactor) == ("clay", 0.25)
    assert np.allclose(made.visual.uv, V[:, :2])


def test_nodes_place_their_meshes(tmp_path):
    name = save(tmp_path / "blob.glb", TURN)
    placed = trimesh.transform_points(V, TURN)
    assert np.allclose(read(tmp_path / name).points, placed, atol=1e-5)
    cubic_craft(name, "cubic.glb", *QUICK, folder=tmp_path)
    result = quick(placed, F)
    assert np.allclose(read(tmp_path / "cubic.glb").points, result.positions, atol=1e-4)
    R = TURN[:3, :3] / 2.0
    turned = np.einsum("nij,nj->ni", result.rotations, NORMALS @ R.T) @ R
    assert np.allclose(loaded(tmp_path / "cubic.glb").vertex_normals, turned, atol=1e-4)


def test_a_mirrored_node_is_as_if_its_vertices_were_mirrored(tmp_path):
    mirror = np.diag([-1.0, 1.0, 1.0, 1.0])
    file = read(tmp_path / save(tmp_path / "blob.glb", mirror))
    assert np.allclose(file.points, V * [-1, 1, 1])
    assert np.array_equal(file.triangles, F[:, ::-1])


def test_a_mesh_in_several_places_becomes_one_for_each(tmp_path):
    places = np.eye(4), trimesh.transformations.translation_matrix([1.5, 0, 0])
    lines = cubic_craft(save(tmp_path / "a.glb", *places), "b.glb", *QUICK, folder=tmp_path)
    points = np.concatenate([V, V + [1.5, 0, 0]])
    result = quick(points, np.concatenate([F, F + len(V)]))
    assert "324 vertices" in lines[0]
    made = trimesh.load_scene(tmp_path / "b.glb", process=False)
    assert len(made.geometry) == 2
    assert np.allclose(made.bounds, [result.positions.min(0), result.positions.max(0)], atol=1e-5)


def test_other_formats_become_gltf_and_back(tmp_path):
    trimesh.Trimesh(V, F, process=False).export(tmp_path / "blob.ply")
    cubic_craft("blob.ply", "a.glb", *QUICK, folder=tmp_path)
    cubic_craft("a.glb", "b.obj", "--cubeness", "0", *QUICK, folder=tmp_path)
    for name in ("a.glb", "b.obj"):
        surface = read(tmp_path / name)
        assert np.allclose(surface.points, quick(V, F).positions, atol=1e-5)
        assert np.array_equal(surface.triangles, F)


def test_what_would_be_lost_is_refused(tmp_path):
    tree = {"asset": {"version": "2.0"}, "skins": [{"joints": [0]}], "animations": []}
    (tmp_path / "a.gltf").write_text(json.dumps(tree, indent=2))
    line = refused("a.gltf", "b.glb", folder=tmp_path)
    assert "has bones and animations, which would be lost; the command of Blender" in line


def test_broken_files_are_refused(tmp_path):
    whole = (tmp_path / save(tmp_path / "whole.glb")).read_bytes()
    for content in (whole[:5], whole[:200], b"hello", b"[]", b'{"buffers":[3]}'):
        (tmp_path / "cut.gltf").write_bytes(content)
        assert "error: cut.gltf: " in refused("cut.gltf", "out.glb", folder=tmp_path)
    flat = np.diag([1.0, 1.0, 0.0, 1.0])
    assert "scale of zero" in refused(save(tmp_path / "flat.glb", flat), "b.glb", folder=tmp_path)
