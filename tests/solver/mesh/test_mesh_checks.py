# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes that cannot be solved are refused with the reason."""

import numpy as np
import pytest

from solver import CubicCraftError
from solver.mesh import polygons
from solver.mesh.mesh_checks import check_mesh

V = np.eye(3)
F = np.array([[0, 1, 2]])


@pytest.mark.parametrize(
    ("V", "F", "message"),
    [
        (V[:, :2], F, r"positions must have the shape \(n, 3\)"),
        (V, F[:, :2], r"triangles must have the shape \(m, 3\)"),
        (V, F[:0], "no faces"),
        (V[:2], F % 2, "only 2 vertices"),
        (V, F.astype(float), "must be integers"),
        (V, F + 1, "only 3"),
        (V, F - 1, "-1 to 1"),
        (V + [0, np.nan, 0], F, "not finite"),
        (V * 1j, F, "positions must be real numbers, not complex128"),
        (V.astype(str), F, "positions must be real numbers, not text"),
        ("bunny.obj", F, "positions must be real numbers, not text"),
        ([[0, 0, 0], [1, 0]], F, "whose rows are of one length"),
        (None, F, "positions must be real numbers, not None"),
        (V, None, r"must have the shape \(m, 3\)"),
        (V, [[0, 1, 2], [0, 1]], r"must have the shape \(m, 3\), not \(1, 2\)"),
        (V, [[0, 1, 2], [0, 1, "2", 0]], "must be integers"),
        (V, [[[0], [1]], [0, 1, 2]], "rows of vertex numbers"),
        (V, np.repeat(F, 5, axis=0).T, "a face with 5 corners has the vertex 0 twice"),
        (V + [[0, 0, 0], [0, np.inf, 0], [0, 0, 0]], F, "the first is vertex 1"),
    ],
)
def test_refusals(V, F, message):
    with pytest.raises(CubicCraftError, match=message) as caught:
        check_mesh(V, F)
    assert "\n" not in str(caught.value)


def test_polygons_become_triangles():
    V = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 2, 0], [0, 0, 1]])
    quads = [[0, 1, 2, 3], [3, 0, 1, 5]]
    assert len(check_mesh(V, quads)[1]) == len(check_mesh(V, np.array(quads))[1]) == 4
    rows = [[0, 1, 5], [0, 1, 2, 4, 3], [3, 0, 5]]
    for faces in (rows, tuple(map(np.array, rows)), np.array(rows, dtype=object)):
        triangles = check_mesh(V, faces)[1]
        assert triangles.dtype == np.int32
        assert triangles[:2].tolist() == [rows[0], rows[2]]
        assert triangles.shape == (5, 3) and set(triangles[2:].ravel()) == {0, 1, 2, 3, 4}


def test_lists_and_32_bit_arrays_are_taken():
    checked_V, checked_F = check_mesh(V.astype(np.float32).tolist(), F.tolist())
    assert checked_V.dtype == np.float64
    assert checked_F.dtype == np.int32


def test_without_earcut_large_concave_faces_are_refused(monkeypatch):
    monkeypatch.setattr(polygons, "optional_package", lambda name: None)
    angles = np.arange(200) * np.pi / 100
    radii = 1.0 + 0.5 * np.cos(5.0 * angles)
    V = np.stack([radii * np.cos(angles), radii * np.sin(angles), 0.0 * angles], axis=1)
    with pytest.raises(CubicCraftError, match="200 corners; for more than 100, install mapbox"):
        check_mesh(V, [range(200)])
    assert check_mesh(V[::4], [range(50)])[1].shape == (48, 3)
