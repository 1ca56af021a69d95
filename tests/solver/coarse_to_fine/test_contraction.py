# SPDX-License-Identifier: GPL-3.0-or-later
"""Coarser meshes, and where the vertices have gone."""

import numpy as np
import pytest
import shapes
from optional_marks import needs

from solver import PAPER, rest_mesh
from solver.coarse_to_fine import contraction
from solver.coarse_to_fine.contraction import FEWEST, contract
from solver.mesh.edges import Edges

pytestmark = needs("pyamg")


def contracted(V, F):
    """Return the result, and the RestMesh that it comes from."""
    rest = rest_mesh(V, F, PAPER)
    neighbours = rest.skin.matrix(rest.skin.laplacian)
    return contract(rest.V, rest.F, neighbours, rest.topology.part), rest


SHAPES = {**shapes.ALL, "sheet": lambda: shapes.sheet(30)}
TETRAHEDRON = (
    np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]),
    np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]),
)


@pytest.mark.parametrize("name", sorted(SHAPES))
def test_every_vertex_has_gone_into_one_of_a_triangle(name):
    (coarse_V, coarse_F, cluster), rest = contracted(*SHAPES[name]())
    assert cluster.shape == (len(rest.V),)
    assert np.isin(cluster, coarse_F).all()
    assert len(coarse_V) < 0.3 * len(rest.V)
    np.testing.assert_array_equal(np.unique(coarse_F), np.arange(len(coarse_V)))
    np.testing.assert_array_equal(np.unique(cluster), np.arange(len(coarse_V)))


def test_vertices_go_into_near_ones():
    (coarse_V, _, cluster), rest = contracted(*shapes.blob(4))
    V, F = rest.V, rest.F
    distance = np.linalg.norm(V - coarse_V[cluster], axis=1)
    edges = np.linalg.norm(V[F[:, 0]] - V[F[:, 1]], axis=1)
    assert distance.max() < 4 * np.median(edges)


def test_a_closed_surface_stays_one_with_round_triangles():
    (coarse_V, coarse_F, _), rest = contracted(*shapes.blob(5))
    edges = Edges(coarse_F, len(coarse_V))
    np.testing.assert_array_equal(np.bincount(edges.number.ravel()), 2)
    assert len(coarse_V) - len(edges.lower) + len(coarse_F) == 2
    sides = np.linalg.norm(coarse_V[edges.lower] - coarse_V[edges.upper], axis=1)[edges.number]
    s = sides.sum(axis=0) / 2
    areas = np.sqrt(s * np.prod(s - sides, axis=0))
    roundness = 4 * np.sqrt(3) * areas / (sides**2).sum(axis=0)  # 1 if equilateral
    assert roundness.mean() > 0.85
    assert len(rest.F) / 20 < len(coarse_F) < len(rest.F) / 6


def test_what_cannot_get_coarser_has_no_coarser_mesh():
    """Each level would have as many vertices as the one before."""
    corners, faces = TETRAHEDRON
    many = np.arange(300)
    V = (corners[None] + 3.0 * many[:, None, None] * [1, 0, 0]).reshape(-1, 3)
    F = (faces[None] + 4 * many[:, None, None]).reshape(-1, 3)
    assert contracted(V, F)[0] is None


def test_parts_stay_apart():
    rest = rest_mesh(*shapes.two_blobs(), proxy=PAPER)
    coarse = rest.coarse
    assert coarse.rest.topology.component_count == 2
    labels = coarse.rest.topology.component[coarse.cluster]
    assert len(np.unique(np.stack([labels, rest.topology.component]), axis=1).T) == 2


def test_small_parts_stay_as_they_are():
    V, F = shapes.blob()
    corners, faces = TETRAHEDRON
    assert len(faces) < FEWEST
    V = np.concatenate([V, 0.1 * corners + [3.0, 0.0, 0.0]])
    F = np.concatenate([F, len(V) - 4 + faces])
    (coarse_V, coarse_F, cluster), rest = contracted(V, F)
    at = rest.place[1][-4:]
    np.testing.assert_allclose(coarse_V[cluster[at]], rest.V[at])
    assert np.isin(coarse_F, cluster[at]).all(axis=1).sum() == 4


def test_the_tip_of_a_spike_goes_to_its_root():
    """A spike so thin that no triangle of it is left: one vertex after the other, in a line."""
    V, F = shapes.blob()
    length = 40
    a, b, _ = F[0]
    tip = V[a] * (1.0 + 0.05 * np.arange(1, length + 1))[:, None]
    spike = len(V) + np.arange(length)
    chain = np.stack([np.append(a, spike[:-1]), np.append(b, spike[:-1]), spike], axis=1)
    chain[1:, 1] = np.append(a, spike)[: length - 1]
    V, F = np.concatenate([V, tip]), np.concatenate([F, chain])
    (coarse_V, coarse_F, cluster), rest = contracted(V, F)
    assert np.isin(cluster, coarse_F).all()
    root = coarse_V[cluster[rest.place[1][spike]]]
    assert (np.linalg.norm(root - rest.V[rest.place[1][a]], axis=1) < 0.75).all()


def test_without_the_package_there_is_no_coarser_mesh(monkeypatch):
    monkeypatch.setattr(contraction, "optional_package", lambda name: None)
    assert rest_mesh(*shapes.blob(), proxy=PAPER).coarse is None
