# SPDX-License-Identifier: GPL-3.0-or-later
"""Welding, splitting, and the way from the input and back."""

import itertools

import numpy as np
import proxy_shapes
import pytest
import shapes

from solver import CubicCraftError, ProxyOptions, rest_mesh, stylize
from solver.proxy.refinement import BUDGET, refine
from solver.proxy.weld import weld

RUN = {"device": "numpy", "max_iterations": 30, "tolerance": 1e-12, "keep_rotation": True}
RUN |= {"crispness": 0.0}


def edges_of(V, F):
    return np.linalg.norm(V[F] - V[np.roll(F, 1, axis=1)], axis=2)


def area(V, F):
    return np.linalg.norm(np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]]), axis=1).sum()


def is_closed(F):
    edges = np.sort(np.concatenate([F[:, [0, 1]], F[:, [1, 2]], F[:, [2, 0]]]), axis=1)
    return (np.unique(edges, axis=0, return_counts=True)[1] == 2).all()


@pytest.mark.parametrize("make", [proxy_shapes.split, proxy_shapes.cut])
def test_a_seam_is_closed(make):
    V, F = shapes.blob(2)
    W, G = make(V, F)
    group, first, welded = weld((W - W.min(0)) / np.ptp(W, axis=0).max(), G)
    assert len(first) == len(V)
    assert is_closed(welded)
    np.testing.assert_array_equal(W[first[group]], W)


@pytest.mark.thorough(1)
@pytest.mark.parametrize("make", [proxy_shapes.split, proxy_shapes.cut])
def test_a_seam_changes_nothing(make):
    V, F = shapes.blob(2)
    W, G = make(V, F)
    whole = stylize(V, F, 0.4, proxy=ProxyOptions(solidity=0.1), **RUN)
    parts = stylize(W, G, 0.4, proxy=ProxyOptions(solidity=0.1), **RUN)
    place = np.array([np.flatnonzero((w == V).all(axis=1))[0] for w in W[G.ravel()]])
    assert np.abs(parts.positions[G.ravel()] - whole.positions[place]).max() < 2e-3


def test_parts_that_share_a_place_but_no_edge_are_not_welded():
    V, F = shapes.sphere(1)
    both = proxy_shapes.joined((V, F), (V + V[0] - V[4], F))
    at = (both[0] - both[0].min(0)) / np.ptp(both[0], axis=0).max()
    assert len(weld(at, both[1])[1]) == 2 * len(V)


def test_coincident_sheets_become_one():
    V, F = shapes.sheet(5)
    W, G = proxy_shapes.joined((V, F), (V, F[:, ::-1]))
    _, first, welded = weld(W, G)
    assert len(first) == len(V) and len(welded) == len(F)


def test_faces_are_known_where_triangles_collapse():
    V, F = shapes.blob(3)
    W, G = proxy_shapes.joined(
        (V, F), (np.array([[2.0, 0, 0], [2, 0, 0], [2, 1, 0], [3, 0, 0]]), [[0, 1, 2], [0, 2, 3]])
    )
    faces = np.arange(len(G)) // 2
    rest = rest_mesh(W, G, ProxyOptions(), faces=faces)
    assert rest.whole is not None
    middles = rest.box.from_unit(rest.V[rest.F].mean(axis=1))
    given = W[G].mean(axis=1)
    nearest = np.array([np.linalg.norm(given - m, axis=1).argmin() for m in middles[::97]])
    assert (faces[nearest] == rest.whole[::97]).mean() > 0.7
    with pytest.raises(CubicCraftError, match="faces must have the shape"):
        rest_mesh(W, G, ProxyOptions(), faces=faces[1:])


@pytest.mark.parametrize("turn", [0, 21, 63])
def test_a_box_is_split_into_short_edges_and_keeps_its_shape(turn):
    V, F = proxy_shapes.box((1, 0.5, 0.2), turn)
    W, G, parents, rounds, whole = refine(V, F, np.full(8, 0.05))
    assert edges_of(W, G).max() <= 0.05
    assert area(W, G) == pytest.approx(area(V, F))
    for k, face in enumerate(F):
        assert area(W, G[whole == k]) == pytest.approx(area(V, face[None]))
    assert is_closed(G)
    np.testing.assert_array_equal(W[:8], V)
    np.testing.assert_allclose(W[8:], W[parents].mean(axis=1))
    for begin, end in itertools.pairwise(rounds):
        assert parents[begin:end].max(initial=0) < 8 + begin


def test_the_budget_is_spent_evenly():
    V, F = proxy_shapes.box((1, 1, 1))
    W, G, *_ = refine(V, F, np.full(8, 1e-3))
    assert BUDGET / 4 < len(W) <= 1.3 * BUDGET
    longest = edges_of(W, G).max(axis=1)
    assert longest.max() < 2.1 * np.median(longest)


def test_a_narrow_side_gets_a_vertex_that_knows_its_normal():
    V, F = proxy_shapes.box((1, 1, 0.01))
    rest = rest_mesh(V, F, ProxyOptions())
    sideways = np.abs(rest.normals[:, :2]).max(axis=1) > 0.99
    assert (rest.cubic_shares[sideways] > 0).any()


def test_values_go_to_midpoints_and_back():
    V, F = proxy_shapes.split(*proxy_shapes.uv_sphere())
    V = np.concatenate([V, [[9.0, 9, 9]]])  # a loose one
    rest = rest_mesh(V, F, ProxyOptions())
    used, place = rest.place
    assert len(rest.V) > 500 and len(used) == len(V) - 1
    np.testing.assert_allclose(rest.V[place], rest.box.to_unit(V[used]), atol=1e-12)
    np.testing.assert_allclose(rest.input_map.spread(V), rest.box.from_unit(rest.V), atol=1e-12)
    np.testing.assert_allclose(rest.input_map.spread(V[:, 0])[place], V[used, 0], atol=1e-12)


def test_a_mask_holds_at_welded_vertices_if_at_one_and_at_midpoints_if_at_both_ends():
    V, F = proxy_shapes.split(*proxy_shapes.box())
    rest = rest_mesh(V, F, ProxyOptions())
    mask = np.zeros(len(V), dtype=bool)
    corner = np.flatnonzero((V[0] == V).all(axis=1))
    mask[corner[0]] = True
    assert np.count_nonzero(rest.input_map.spread_mask(mask)) == 1
    bottom = V[:, 2] == 0
    at = rest.box.from_unit(rest.V)[rest.input_map.spread_mask(bottom)]
    assert (at[:, 2] == 0).all() and len(at) > 100


@pytest.mark.parametrize("solidity", [-0.1, np.nan, np.inf])
def test_a_solidity_that_is_none_is_refused(solidity):
    with pytest.raises(CubicCraftError, match="solidity must be finite and not negative"):
        ProxyOptions(solidity=solidity)


def smallest_angle(V, F):
    """Return the smallest angle of triangles, in degrees."""
    along, back = (np.roll(F, -step, axis=1) for step in (1, 2))
    a, b = V[along] - V[F], V[back] - V[F]
    cosine = (a * b).sum(axis=2) / np.linalg.norm(a, axis=2) / np.linalg.norm(b, axis=2)
    return np.degrees(np.arccos(cosine.max()))


@pytest.mark.parametrize("corner", [(0.5, 0.9), (0.95, 0.3), (0.1, 0.25)])
def test_no_triangle_becomes_a_needle(corner):
    """Rivara: no angle becomes smaller than half of the smallest."""
    V, F = np.array([[0.0, 0, 0], [1, 0, 0], [*corner, 0]]), np.array([[0, 1, 2]])
    W, G, *_ = refine(V, F, np.full(3, 0.1))
    assert len(G) > 30 and smallest_angle(W, G) > 0.5 * smallest_angle(V, F)
