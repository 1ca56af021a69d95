# SPDX-License-Identifier: GPL-3.0-or-later
"""Coarser meshes, and where the vertices have gone."""

from types import SimpleNamespace

import numpy as np
import pytest
import shapes
from optional_marks import needs

from solver import decimation, rest_mesh
from solver.decimation import decimate

pytestmark = needs("fast_simplification")


def in_unit_box(V, F):
    rest = rest_mesh(V, F)
    return rest.V, rest.F


@pytest.mark.parametrize("name", sorted(shapes.ALL))
def test_every_vertex_has_gone_into_one_of_a_triangle(name):
    V, F = in_unit_box(*shapes.ALL[name]())
    coarse_V, coarse_F, cluster = decimate(V, F, 4)
    assert cluster.shape == (len(V),)
    assert np.isin(cluster, coarse_F).all()
    assert len(coarse_V) < 0.6 * len(V)
    assert len(np.unique(coarse_F)) == len(coarse_V)


def test_vertices_go_into_near_ones():
    V, F = in_unit_box(*shapes.blob(4))
    coarse_V, _, cluster = decimate(V, F, 4)
    distance = np.linalg.norm(V - coarse_V[cluster], axis=1)
    edges = np.linalg.norm(V[F[:, 0]] - V[F[:, 1]], axis=1)
    assert distance.max() < 6 * np.median(edges)
    np.testing.assert_array_equal(np.unique(cluster), np.arange(len(coarse_V)))


def test_what_cannot_get_coarser_has_no_coarser_mesh(monkeypatch):
    """As a lamp of long flat slivers: each level would have as many vertices as the one before."""
    V, F = in_unit_box(*shapes.blob(2))

    def simplify(V, F, **_):
        return V, F, np.empty((0, 2), np.int64)

    monkeypatch.setattr(
        decimation, "optional_package", lambda _: SimpleNamespace(simplify=simplify)
    )
    assert decimate(V, F, 16) is None


def test_parts_stay_apart():
    V, F = in_unit_box(*shapes.two_blobs())
    coarse = rest_mesh(V, F).coarse
    assert coarse.rest.topology.component_count == 2
    labels = coarse.rest.topology.component[coarse.cluster]
    assert len(np.unique(np.stack([labels, rest_mesh(V, F).topology.component]), axis=1).T) == 2


def test_a_part_that_collapses_does_no_harm():
    V, F = shapes.blob()
    speck = V[F[0]] * 1e-4 + [3.0, 0.0, 0.0]
    V, F = np.concatenate([V, speck]), np.concatenate([F, [[len(V), len(V) + 1, len(V) + 2]]])
    _, coarse_F, cluster = decimate(*in_unit_box(V, F), 4)
    assert np.isin(cluster, coarse_F).all()


def test_without_the_package_there_is_no_coarser_mesh(monkeypatch):
    monkeypatch.setattr(decimation, "optional_package", lambda name: None)
    assert rest_mesh(*shapes.blob()).coarse is None
