# SPDX-License-Identifier: GPL-3.0-or-later
"""Details ride along: the normals that the cubic term sees, and what becomes of bumps."""

from dataclasses import replace

import numpy as np
import proxy_shapes
import pytest
import shapes
from scipy.sparse import diags
from scipy.sparse.linalg import spsolve

from solver import PAPER, ProxyOptions, Setup, SolverOptions, Stylization, rest_mesh, run, stylize
from solver.details import radii, smoothed

DETAIL = replace(PAPER, detail=0.05)
KEPT = {"keep_rotation": True}


def bumpy_ball(height=0.02):
    """Return a ball with bumps 0.12 wide, and the share (n,) of a bump at each vertex."""
    V, F = shapes.sphere(5)
    ways = shapes.sphere(1)[0]
    near = np.linalg.norm(V[:, None] - ways[None], axis=2).min(axis=1)
    bump = np.exp(-((near / 0.06) ** 2))
    return V * (1.0 + height * bump)[:, None], F, bump


def test_they_solve_the_diffusion_equation():
    V, F = shapes.blob(3)
    rest = rest_mesh(V, F)
    radius = np.full(len(rest.V), 0.1)
    unit, length = smoothed(rest.skin, rest.areas, rest.normals, radius)
    L = rest.skin.matrix(np.minimum(rest.skin.laplacian, 0.0)).tolil()
    L.setdiag(0.0)
    L = L.tocsr()
    L = L - diags(np.asarray(L.sum(axis=1)).ravel())
    M = diags(rest.areas)
    exact = spsolve((M + 0.1**2 / 4 * L).tocsc(), M @ rest.normals)
    np.testing.assert_allclose(length[:, None] * unit, exact, atol=0.02)
    assert length.max() <= 1.0


def test_without_a_size_all_normals_are_as_they_are():
    rest = rest_mesh(*shapes.blob(3), PAPER)
    assert rest.cubic_normals is rest.normals


def test_bumps_are_left_and_the_whole_is_as_cubic():
    V, F, bump = bumpy_ball()
    heights, widths = [], []
    for proxy in (PAPER, DETAIL):
        U = stylize(V, F, 0.4, proxy=proxy, **KEPT).positions
        heights.append(_prominence(V, U))
        widths.append(np.linalg.norm(U[bump < 0.01], axis=1).std())
    assert heights[1] > 0.4 and heights[1] > 2.0 * heights[0]
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


def test_no_further_than_half_of_what_is_thick_but_small_parts_are_details():
    thickness, sizes = np.array([0.04, 1.0, 0.04, np.inf]), np.array([1.0, 1.0, 0.06, 1.0])
    is_alone = np.array([True, True, False, True])
    found = radii(np.full(4, 0.05), thickness, sizes, is_alone)
    np.testing.assert_allclose(found, [0.02, 0.05, 0.05, 0.05])


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


def test_the_energy_falls_and_pins_hold(device):
    V, F, _ = bumpy_ball()
    rest = rest_mesh(V, F, replace(ProxyOptions(), keep_apart=False))
    state = Stylization(
        Setup(rest, pinned=np.arange(30)),
        0.4,
        options=SolverOptions(device=device, is_accelerated=False),
    )
    energies = []
    result = run(state, 12, 1e-12, lambda s: energies.append(s.energy.total))
    assert np.diff(energies).max() <= 1e-9 * energies[0]
    np.testing.assert_array_equal(result.positions[:30], V[:30])
