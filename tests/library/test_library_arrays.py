# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays and meshes as trimesh hands them out just work, and keep what they have."""

from types import SimpleNamespace

import numpy as np
import pytest
import trimesh

from cubic_craft import PAPER, CubicCraftError, rest_mesh, stylize, stylize_mesh
from tests.icospheres import blob

V, F = blob(2)
QUICK = {"device": "numpy", "proxy": PAPER}
FEW = {"device": "numpy", "max_iterations": 10}
RESULT = stylize(V, F, 0.4, **QUICK)


def read_only(array):
    array = array.copy()
    array.flags.writeable = False
    return array


LAYOUTS = {
    "lists": (V.tolist(), F.tolist()),
    "read-only": (read_only(V), read_only(F)),
    "Fortran order": (np.asfortranarray(V), np.asfortranarray(F)),
    "big-endian": (V.astype(">f8"), F.astype(">i8")),
    "views": (np.repeat(V, 2, axis=0)[::2], np.concatenate([F, F], axis=1)[:, :3]),
    "int32": (V, F.astype(np.int32)),
    "uint32": (V, F.astype(np.uint32)),
    "uint64": (V, F.astype(np.uint64)),
}


@pytest.mark.parametrize("name", LAYOUTS)
def test_layouts_give_the_same(name):
    positions, triangles = LAYOUTS[name]
    result = stylize(positions, triangles, 0.4, **QUICK)
    assert np.array_equal(result.positions, RESULT.positions)


def test_float32_is_computed_in_64_bit():
    result = stylize(V.astype(np.float32), F, 0.4, **QUICK)
    assert result.positions.dtype == np.float64
    assert np.allclose(result.positions, RESULT.positions, atol=1e-4)


@pytest.mark.parametrize("options", [QUICK, FEW], ids=["paper", "default"])
def test_a_trimesh(options):
    mesh = trimesh.Trimesh(V, F, process=False)
    assert type(mesh.vertices) is not np.ndarray  # they notice changes
    result = stylize(mesh.vertices, mesh.faces, 0.4, **options)
    assert type(result.positions) is np.ndarray
    if options is QUICK:
        assert np.array_equal(result.positions, RESULT.positions)
    assert np.array_equal(mesh.vertices, V) and np.array_equal(mesh.faces, F)
    mesh.vertices = result.positions
    assert mesh.is_watertight
    assert facing_axes(mesh) > facing_axes(trimesh.Trimesh(V, F, process=False)) + 0.01


def facing_axes(mesh):
    """Return how much of a surface faces an axis, on average."""
    return np.average(np.abs(mesh.face_normals).max(axis=1), weights=mesh.area_faces)


def test_the_input_is_never_written_to():
    positions, triangles = V.copy(), F.copy()
    rest = rest_mesh(positions, triangles, PAPER)
    stylize(positions, triangles, 0.4, **FEW)
    assert np.array_equal(positions, V) and np.array_equal(triangles, F)
    positions += 1.0
    again = rest_mesh(V, F, PAPER)
    assert np.array_equal(rest.V, again.V), "a rest mesh shares memory with its input"


def test_a_trimesh_keeps_all():
    colors = np.random.default_rng(1).integers(0, 255, (len(V), 4), np.uint8)
    mesh = trimesh.Trimesh(
        *(V, F), process=False, vertex_colors=colors, metadata={"name": "blob", "list": [1]}
    )
    mesh.vertex_attributes["heat"] = np.arange(len(V))
    mesh.face_attributes["material"] = np.arange(len(F))
    normals = mesh.vertex_normals.copy()
    made = stylize_mesh(mesh, 0.4, **QUICK)
    assert type(made) is trimesh.Trimesh and made is not mesh
    assert np.array_equal(made.vertices, RESULT.positions) and np.array_equal(made.faces, F)
    assert np.array_equal(made.visual.vertex_colors, colors)
    assert np.array_equal(made.vertex_attributes["heat"], np.arange(len(V)))
    assert np.array_equal(made.face_attributes["material"], np.arange(len(F)))
    assert made.metadata == mesh.metadata
    assert np.array_equal(mesh.vertices, V), "the mesh that was given has changed"
    anew = trimesh.Trimesh(RESULT.positions, F, process=False).vertex_normals
    assert np.allclose(made.vertex_normals, anew) and not np.allclose(anew, normals, atol=1e-3)


def test_uvs_of_a_trimesh_stay():
    pytest.importorskip("PIL")  # which trimesh needs for textures
    uv = np.random.default_rng(2).random((len(V), 2))
    visual = trimesh.visual.TextureVisuals(uv=uv)
    made = stylize_mesh(trimesh.Trimesh(V, F, visual=visual, process=False), **QUICK)
    assert np.array_equal(made.visual.uv, uv)


def test_seams_of_a_texture_stay_closed():
    V, F = blob(1)
    half = np.arange(len(F)) % 2 == 0
    places = np.concatenate([V, V])  # each vertex once more, as UVs would part them
    faces = np.where(half[:, None], F, F + len(V))
    made = stylize_mesh(trimesh.Trimesh(places, faces, process=False), 0.4, **FEW)
    used = np.isin(np.arange(len(V)), F[half]) & np.isin(np.arange(len(V)), F[~half])
    assert used.any() and np.array_equal(
        made.vertices[: len(V)][used], made.vertices[len(V) :][used]
    )


def test_a_scene_is_solved_as_it_stands():
    scene = trimesh.Scene()
    mirrored = np.diag([-1.0, 1.0, 2.0, 1.0])
    mirrored[:3, 3] = 0.0, 1.5, 0.0
    mesh = trimesh.Trimesh(V, F, process=False)
    scene.add_geometry(mesh, node_name="one", geom_name="blob")
    scene.graph.update("two", matrix=mirrored, geometry="blob")
    scene.add_geometry(trimesh.load_path([[0.0, 0, 0], [1, 0, 0]]), node_name="path")
    points = np.concatenate([V, trimesh.transform_points(V, mirrored)])
    result = stylize(points, np.concatenate([F, F[:, ::-1] + len(V)]), 0.4, **QUICK)
    made = stylize_mesh(scene, 0.4, **QUICK)
    for node, expected in zip(("one", "two"), result.positions.reshape(2, -1, 3), strict=True):
        place, name = made.graph[node]
        assert np.array_equal(place, scene.graph[node][0])
        found = trimesh.transform_points(made.geometry[name].vertices, place)
        assert np.allclose(found, expected, atol=1e-9)
    assert len(made.geometry) == 3 and len(scene.geometry) == 2
    assert np.array_equal(scene.geometry["blob"].vertices, V)
    scene.graph.update("two", matrix=np.diag([1.0, 1, 0, 1]), geometry="blob")
    with pytest.raises(CubicCraftError, match="the node 'two' has a scale of zero"):
        stylize_mesh(scene, 0.4)


@pytest.mark.parametrize(
    ("mesh", "words"),
    [
        ("bunny.obj", "which a str does not"),
        (SimpleNamespace(vertices=V, faces=F + 1), "triangles refer to vertices"),
        (trimesh.Scene(), "no faces"),
    ],
)
def test_what_is_no_surface_is_refused(mesh, words):
    with pytest.raises(CubicCraftError, match=words) as caught:
        stylize_mesh(mesh, device="numpy")
    assert "\n" not in str(caught.value)
