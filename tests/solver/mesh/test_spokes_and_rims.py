# SPDX-License-Identifier: GPL-3.0-or-later
"""The sparse matrices against the definition of the energy, in loops."""

import numpy as np
import pytest
import shapes

from solver.mesh import edge_vectors
from solver.mesh.rest_measures import cotangents
from solver.mesh.spokes_and_rims import spokes_and_rims


def matrices(V, F):
    m = spokes_and_rims(V, F, cotangents(V, F))
    gather = [m.matrix(m.gather[:, c]) for c in range(3)]
    scatter = [m.matrix(m.scatter[:, c]) for c in range(3)]
    return m.matrix(m.laplacian), gather, scatter


def test_laplacian_is_symmetric_and_semidefinite_with_constants_as_kernel():
    for name in ("blob", "skewed_blob", "sheet"):
        L, _, _ = matrices(*shapes.ALL[name]())
        dense = L.toarray()
        np.testing.assert_allclose(dense, dense.T, atol=1e-12)
        np.testing.assert_allclose(dense.sum(axis=1), 0.0, atol=1e-11)
        values = np.linalg.eigvalsh(dense)
        assert values[0] > -1e-10
        assert values[1] > 1e-6


def test_covariances_match_the_definition():
    V, F = shapes.skewed_blob()
    U = V + 0.1 * np.sin(3 * V[:, [1, 2, 0]])
    _, gather, _ = matrices(V, F)
    S = np.stack([H @ U for H in gather], axis=1)
    C = cotangents(V, F)
    expected = np.zeros_like(S)
    for f, cot in zip(F, C, strict=True):
        for k in range(3):
            i, j = f[(k + 1) % 3], f[(k + 2) % 3]
            expected[f] += cot[k] * np.outer(V[j] - V[i], U[j] - U[i])
    np.testing.assert_allclose(S, expected, atol=1e-12)


def test_scatter_is_the_transpose_of_gather():
    _, gather, scatter = matrices(*shapes.skewed_blob())
    for H, T in zip(gather, scatter, strict=True):
        assert abs(H.T - T).max() == 0.0


def test_right_hand_side_of_the_identity_is_the_rest_shape():
    V, F = shapes.skewed_blob()
    L, _, scatter = matrices(V, F)
    identity = np.tile(np.eye(3), (len(V), 1, 1))
    rhs = sum(H @ identity[:, :, c] for c, H in enumerate(scatter)) / 3
    np.testing.assert_allclose(rhs, L @ V, atol=1e-12)


def test_covariances_at_rest_are_semidefinite_on_obtuse_triangles_too():
    V, F = shapes.skewed_blob()
    assert (cotangents(V, F) < 0).any()
    _, gather, _ = matrices(V, F)
    S = np.stack([H @ V for H in gather], axis=1)
    np.testing.assert_allclose(S, S.swapaxes(1, 2), atol=1e-12)
    assert np.linalg.eigvalsh(S).min() > -1e-12


def soup():
    """Return random triangles: edges of many triangles, repeated triangles and vertices."""
    random = np.random.default_rng(3)
    F = random.integers(0, 30, (200, 3))
    F[:30] = F[30:60]
    F[60:80, 1] = F[60:80, 0]
    F[80:85] = F[80:85, :1]
    return random.normal(size=(30, 3)), F


MESHES = {**shapes.ALL, "soup": soup}


@pytest.mark.parametrize("name", MESHES)
def test_entries_are_those_of_sums_over_triangles(name):
    V, F = MESHES[name]()
    C = cotangents(V, F)
    n = len(V)
    L, gather = np.zeros((n, n)), np.zeros((3, n, n))
    pairs = {(i, i) for i in range(n)}
    for f, cot in zip(F, C, strict=True):
        L_f = -np.array([[0, cot[2], cot[1]], [cot[2], 0, cot[0]], [cot[1], cot[0], 0]])
        L_f -= np.diag(L_f.sum(axis=1))
        g = L_f @ (V[f] - V[f].mean(axis=0))
        for k in range(3):
            for j in range(3):
                pairs.add((f[k], f[j]))
                L[f[k], f[j]] += L_f[k, j]
                gather[:, f[k], f[j]] += g[j]
    m = spokes_and_rims(V, F, C)
    rows = np.repeat(np.arange(n), np.diff(m.indptr))
    assert list(zip(rows, m.indices, strict=True)) == sorted(pairs)
    precise = {"rtol": 0.0, "atol": 1e-14 * np.abs(C).max()}
    np.testing.assert_allclose(m.matrix(m.laplacian).toarray(), L, **precise)
    for c in range(3):
        np.testing.assert_allclose(m.matrix(m.gather[:, c]).toarray(), gather[c], **precise)
        np.testing.assert_allclose(m.matrix(m.scatter[:, c]).toarray(), gather[c].T, **precise)


def test_blocks_change_no_bit(monkeypatch):
    V, F = shapes.broken()
    whole = spokes_and_rims(V, F, cotangents(V, F))
    monkeypatch.setattr(edge_vectors, "BLOCK", 7)
    parts = spokes_and_rims(V, F, cotangents(V, F))
    for name, values in vars(whole).items():
        np.testing.assert_array_equal(getattr(parts, name), values)
