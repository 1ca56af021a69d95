# SPDX-License-Identifier: GPL-3.0-or-later
"""Gaps lead across empty space or through a body, never along a surface to its own neighborhood."""

import numpy as np
import shapes
from scipy.sparse.csgraph import shortest_path

from solver.contacts.gaps import NEAR_EDGES, Gaps, graph_of
from solver.mesh.rest_measures import areas_and_normals


def fold(degrees, size=25):
    """Return a flat sheet of edge 0.5 that is folded in its middle to an angle."""
    V, F = shapes.sheet(size)
    x, y = 0.5 * V[:, 0] - 0.25, 0.5 * V[:, 1]
    half = np.radians(degrees / 2)
    return np.stack([np.abs(x) * np.cos(half), y, x * np.sin(half)], axis=1), F


def test_no_link_leads_to_a_vertex_nearby_on_the_surface():
    V, F = fold(30.0)
    i, j = Gaps(V, areas_and_normals(V, F)[1], F).partners(np.arange(len(V)))
    edges = shortest_path(graph_of(F, len(V)), unweighted=True)[i, j]
    assert len(i) > 100 and edges.min() > NEAR_EDGES
    assert (V[i, 2] * V[j, 2] < 0.0).all(), "from one side of the fold to the other"


def test_what_is_asked_again_is_answered_as_before_without_a_search(monkeypatch):
    V, F = fold(30.0)
    gaps = Gaps(V, areas_and_normals(V, F)[1], F)
    some = np.arange(0, len(V), 3)
    gaps.partners(some)
    i, j = gaps.partners(np.arange(len(V)))
    anew = Gaps(V, areas_and_normals(V, F)[1], F).partners(np.arange(len(V)))
    np.testing.assert_array_equal((i, j), anew)
    searches = []
    monkeypatch.setattr(gaps, "_across", lambda *asked: searches.append(asked))
    np.testing.assert_array_equal(gaps.partners(some), (i[np.isin(i, some)], j[np.isin(i, some)]))
    assert not searches
