# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays as trimesh and meshio hand them out, and others that are common, just work."""

import meshio
import numpy as np
import pytest
import trimesh

from cubic_craft import PAPER, CubicCraftError, rest_mesh, stylize
from scripts.benchmark.shapes import blob

V, F = blob(2)
EXPECTED = stylize(V, F, 0.4, device="numpy", proxy=PAPER).positions


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
    result = stylize(positions, triangles, 0.4, device="numpy", proxy=PAPER)
    assert np.array_equal(result.positions, EXPECTED)


@pytest.mark.parametrize("proxy", [PAPER, None])
def test_a_trimesh(proxy):
    mesh = trimesh.Trimesh(V, F, process=False)
    assert type(mesh.vertices) is not np.ndarray  # they notice changes
    result = stylize(mesh.vertices, mesh.faces, 0.4, device="numpy", proxy=proxy)
    assert type(result.positions) is np.ndarray
    if proxy is PAPER:
        assert np.array_equal(result.positions, EXPECTED)
    assert np.array_equal(mesh.vertices, V) and np.array_equal(mesh.faces, F)
    mesh.vertices = result.positions
    assert mesh.is_watertight
    assert facing_axes(mesh) > facing_axes(trimesh.Trimesh(V, F, process=False)) + 0.01


def facing_axes(mesh):
    """Return how much of a surface faces an axis, on average."""
    return np.average(np.abs(mesh.face_normals).max(axis=1), weights=mesh.area_faces)


@pytest.mark.parametrize("ending", [".ply", ".vtk", ".vtu", ".off"])
def test_a_meshio_mesh(ending, tmp_path):
    path = tmp_path / f"blob{ending}"
    meshio.Mesh(V, [("triangle", F.astype(np.int32))]).write(path)
    mesh = meshio.read(path)
    result = stylize(mesh.points, mesh.cells_dict["triangle"], 0.4, device="numpy", proxy=PAPER)
    assert np.array_equal(result.positions, EXPECTED)
    mesh.points = result.positions
    mesh.write(tmp_path / f"cubic{ending}")
    assert np.array_equal(meshio.read(tmp_path / f"cubic{ending}").points, EXPECTED)


def test_the_input_is_never_written_to():
    positions, triangles = V.copy(), F.copy()
    rest = rest_mesh(positions, triangles, PAPER)
    stylize(positions, triangles, 0.4, device="numpy")
    assert np.array_equal(positions, V) and np.array_equal(triangles, F)
    positions += 1.0
    again = rest_mesh(V, F, PAPER)
    assert np.array_equal(rest.V, again.V), "a rest mesh shares memory with its input"


@pytest.mark.parametrize(
    ("positions", "triangles", "words"),
    [
        (V, np.concatenate([F, F], axis=1)[:, :4], "has the vertex 0 twice"),
        (V[:, :2], F, "positions must have the shape (n, 3)"),
        (V, F.astype(float), "triangles must be integers"),
        (V, F + len(V), "triangles refer to vertices"),
        (V, np.empty((0, 3), int), "no faces"),
    ],
)
def test_arrays_that_make_no_sense_are_refused(positions, triangles, words):
    with pytest.raises(CubicCraftError) as caught:
        stylize(positions, triangles, proxy=PAPER)
    assert words in str(caught.value) and "\n" not in str(caught.value)
