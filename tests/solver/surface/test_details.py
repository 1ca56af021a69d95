# SPDX-License-Identifier: GPL-3.0-or-later
"""Details ride along: the normals that the cubic term sees, and what becomes of bumps."""

from dataclasses import replace

import numpy as np
import proxy_shapes
import pytest
import shapes
from scipy.sparse import coo_matrix, diags
from scipy.sparse.linalg import spsolve

from solver import PAPER, ProxyOptions, rest_mesh, stylize
from solver.mesh.face_graph import FaceGraph
from solver.surface.details import LARGE, radii, smoothed

DETAIL = replace(PAPER, detail=0.05)
KEPT = {"keep_rotation": True, "crispness": 0.0}


def bumpy_ball(height=0.02):
    """Return a ball with bumps 0.12 wide, and the share (n,) of a bump at each vertex."""
    V, F = shapes.sphere(5)
    ways = shapes.sphere(1)[0]
    near = np.linalg.norm(V[:, None] - ways[None], axis=2).min(axis=1)
    bump = np.exp(-((near / 0.06) ** 2))
    return V * (1.0 + height * bump)[:, None], F, bump


def test_without_edges_they_solve_the_diffusion_equation():
    V, F = shapes.blob(3)
    graph = FaceGraph(V, F)
    radius = np.full(len(F), 0.1)
    found = smoothed(graph, radius, np.ones(len(graph.one)), rounds=0)
    flow = 0.1**2 / 4 * graph.length / graph.distance
    i, j = np.concatenate([graph.one, graph.other]), np.concatenate([graph.other, graph.one])
    L = coo_matrix((-np.concatenate([flow, flow]), (i, j)), shape=(len(F), len(F))).tocsr()
    L = L - diags(np.asarray(L.sum(axis=1)).ravel())
    M = diags(graph.areas)
    exact = spsolve((M + L).tocsc(), M @ graph.normals)
    np.testing.assert_allclose(found, exact, atol=0.02)
    assert np.linalg.norm(found, axis=1).max() <= 1.0 + 1e-9


def test_those_of_a_large_part_are_nearly_as_exact():
    V, F = shapes.blob(4)
    graph = FaceGraph(V, F)
    exact, found = (
        smoothed(graph, np.full(len(F), 0.1), np.ones(len(graph.one)), largest_part=count)
        for count in (LARGE, LARGE + 1)
    )
    assert 0.0 < np.abs(found - exact).max() < 0.01


def test_an_edge_of_the_whole_stays_sharp_and_a_fold_does_not():
    """A bar with an L as its section: five edges bend outward, one inward."""
    outline = np.array([[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2.0]])
    steps = [
        np.linspace(a, b, 21)[:-1] for a, b in zip(outline, np.roll(outline, -1, 0), strict=True)
    ]
    ring = np.concatenate(steps)
    n, rows = len(ring), np.linspace(0, 4, 41)
    V = np.concatenate([np.column_stack([ring, np.full(n, z)]) for z in rows])
    i = np.arange(n)
    j = (i + 1) % n
    bands = [np.stack([[i, j, n + j], [i, n + j, n + i]], 0) + k * n for k in range(len(rows) - 1)]
    F = np.concatenate([band.transpose(0, 2, 1).reshape(-1, 3) for band in bands])
    graph = FaceGraph(V, F)
    found = smoothed(graph, np.full(len(F), 0.2), np.ones(len(graph.one)))
    found /= np.linalg.norm(found, axis=1, keepdims=True)
    off = np.degrees(np.arccos(np.clip((found * graph.normals).sum(axis=1), -1, 1)))
    middle = V[F].mean(axis=1)
    is_inner = (np.abs(middle[:, 2] - 2) < 1) & (graph.areas > 0)
    at_fold = is_inner & (np.linalg.norm(middle[:, :2] - [1, 1], axis=1) < 0.06)
    at_edge = is_inner & (np.linalg.norm(middle[:, :2] - [2, 1], axis=1) < 0.06)
    assert off[at_edge].max() < 6.0
    assert off[at_fold].min() > 20.0


def test_bumps_are_left_and_the_whole_is_as_cubic():
    V, F, bump = bumpy_ball()
    heights, widths = [], []
    for proxy in (PAPER, DETAIL):
        U = stylize(V, F, 0.4, proxy=proxy, **KEPT).positions
        heights.append(_prominence(V, U))
        widths.append(np.linalg.norm(U[bump < 0.01], axis=1).std())
    assert heights[1] > 0.33 and heights[1] > 2.0 * heights[0]
    assert widths[1] > widths[0], "a cube varies more than a ball"


def _prominence(V, U):
    """Return how far bumps stand out of the ring around them, relative to rest."""
    found = []
    for way in shapes.sphere(1)[0]:
        at = np.linalg.norm(V / np.linalg.norm(V, axis=1)[:, None] - way, axis=1)
        rise = [_rise(X, at < 0.03, (at > 0.13) & (at < 0.17), way) for X in (V, U)]
        found.append(rise[1] / rise[0])
    return float(np.mean(found))


def _rise(X, top, around, way):
    normal = np.linalg.eigh(np.cov(X[around].T))[1][:, 0]
    return (X[top].mean(axis=0) - X[around].mean(axis=0)) @ (normal * np.sign(normal @ way))


def test_no_normal_is_averaged_across_the_edges_of_a_box():
    V, F = proxy_shapes.box((2, 1.5, 1))
    rest = rest_mesh(V, F, ProxyOptions())
    is_counted = rest.cubic_shares > 0.0
    largest = np.abs(rest.cubic_normals[is_counted]).max(axis=1)
    np.testing.assert_allclose(largest, 1.0, atol=1e-9)
    U = stylize(V, F, 1.0, proxy=ProxyOptions(), **KEPT).positions
    np.testing.assert_allclose(U, V, atol=1e-9)


def test_details_of_thin_parts_are_smaller_in_proportion_but_small_parts_are_details():
    whole, sizes = np.ones(4), np.array([1.0, 1.0, 0.06, 1.0])
    thickness, is_alone = np.array([0.04, 0.4, 0.04, np.inf]), np.array([True, True, False, True])
    found = radii(0.05, whole, thickness, sizes, is_alone)
    np.testing.assert_allclose(found, [0.005, 0.05, 0.05, 0.05])
    found = radii(0.3, whole, thickness, sizes, is_alone)
    np.testing.assert_allclose(found, [0.02, 0.2, 0.3, 0.3], err_msg="never over half of it")


def test_a_small_part_stays_what_it_is():
    (V, F), (W, G) = shapes.sphere(4), shapes.sphere(2)
    eye = 0.04 * W + [0.0, -1.0, 0.2] / np.sqrt(1.04)
    both, faces = proxy_shapes.joined((V, F), (eye, G))
    U = stylize(both, faces, 0.6, proxy=ProxyOptions(), **KEPT).positions
    now = U[len(V) :] - U[len(V) :].mean(axis=0)
    distance = np.linalg.norm(now, axis=1)
    assert distance.std() < 0.03 * distance.mean(), "a ball"


def test_a_detail_of_an_invalid_size_is_refused():
    for value in (-0.1, np.nan, np.inf):
        with pytest.raises(Exception, match="detail must be finite"):
            ProxyOptions(detail=value)
