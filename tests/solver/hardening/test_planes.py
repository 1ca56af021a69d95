# SPDX-License-Identifier: GPL-3.0-or-later
"""Sides that are nearly flat: flat, whatever held them."""

import numpy as np
import pytest
from facing import share_facing
from proxy_shapes import uv_sphere
from shapes import sheet

from solver import Run, Setup, SolverOptions, Style, Stylization, rest_mesh
from solver.hardening.planes import _to_planes, flat_at_rest, flattening
from solver.mesh.face_graph import FaceGraph


def bulging(bulge, slope=0.3, n=12):
    """Return a ridge of two sides (n,3), (m,3) that rise by a slope and bulge, and the sides (m,).

    `bulge`: (2,), how far the middle of each is above its plane, relative to its width.
    """
    V, F = sheet(n + 1)
    x, y = V[:, 0], V[:, 1]
    side = (V[F, 0].mean(axis=1) > 0.5).astype(np.int64)
    across = np.abs(x - 0.5)
    up = np.sin(2.0 * np.pi * across) * np.sin(np.pi * y)
    V[:, 2] = -slope * across + 0.5 * np.where(x > 0.5, bulge[1], bulge[0]) * up
    return V, F, side


def flattened(V, F, side, heights=None, *, is_tilted=False, thickness=0.0, rim=0.0):
    up = np.tile([0.0, 0.0, 1.0], (len(F), 1))
    heights = np.zeros(len(V)) if heights is None else heights
    tilted = np.full(len(F), is_tilted)
    thick, of_rim = np.full(len(F), thickness), np.full(len(V), rim)
    return flattening(V, F, FaceGraph(V, F), side, up, heights, tilted, thick, of_rim)


def from_planes(U, F, side):
    """Return the largest distance of the vertices of each side from its plane of least squares."""
    off = []
    for number in range(2):
        X = U[np.unique(F[side == number])]
        X = X - X.mean(axis=0)
        off.append(np.abs(X @ np.linalg.svd(X, full_matrices=False)[2][-1]).max())
    return np.array(off)


def test_a_side_aslant_keeps_its_slope_and_loses_its_bulge():
    V, F, side = bulging((0.03, 0.03))
    moves, flat = flattened(V, F, side)
    assert flat.min() > 0.99
    before, after = (from_planes(U, F, side) for U in (V, V + moves))
    assert (before > 5e-3).all() and (after < 1e-4).all()
    ridge = (V + moves)[V[:, 0] == 0.5]
    assert np.ptp(ridge[:, 2]) < 1e-4
    assert ridge[0, 2] - (V + moves)[V[:, 0] == 0.0, 2].mean() == pytest.approx(0.15, abs=0.01)


def test_what_bulges_by_more_is_a_form_and_stays():
    V, F, side = bulging((0.03, 0.2))
    moves, flat = flattened(V, F, side)
    assert not flat[V[:, 0] > 0.5].any(), "which only follows its edge"
    assert np.abs(moves[V[:, 0] > 0.95]).max() < 1e-4
    assert flat[V[:, 0] < 0.5].min() > 0.99
    assert from_planes(V + moves, F, side)[0] < 1e-4


def test_a_face_is_bent_by_less_than_what_is_bare():
    V, F, side = bulging((0.075, 0.075))
    assert flattened(V, F, side)[1].min() > 0.9
    assert flattened(V, F, side, is_tilted=True)[1].max() < 0.5


def test_what_is_thick_loses_a_larger_bulge_than_what_is_slender():
    V, F, side = bulging((0.13, 0.13))
    assert flattened(V, F, side, thickness=0.7)[1].min() > 0.99
    assert flattened(V, F, side, thickness=0.15)[1].max() < 0.1
    assert flattened(V, F, side, thickness=0.7, is_tilted=True)[1].max() < 0.1


def test_the_rim_of_a_plate_becomes_straight_however_thin_it_is():
    """A bun in a burger, whose sides bow more than it is thick."""
    V, F, side = bulging((0.13, 0.13))
    assert flattened(V, F, side, thickness=0.05)[1].max() < 0.1
    assert flattened(V, F, side, thickness=0.05, rim=1.0)[1].min() > 0.99
    assert flattened(V, F, side, thickness=0.05, rim=1.0, is_tilted=True)[1].max() < 0.5


def test_a_side_that_was_flat_at_rest_loses_a_larger_bulge():
    """Posts between a floor and a roof that become square bent, as what holds their ends turned."""
    (V, F, side), (at_rest, _, _) = bulging((0.13, 0.13)), bulging((0.0, 0.13))
    was_flat = flat_at_rest(at_rest, F, FaceGraph(at_rest, F), side)
    flat = flattened(V, F, side, rim=was_flat)[1]
    assert flat[V[:, 0] < 0.49].min() > 0.99
    assert flat[V[:, 0] > 0.51].max() < 0.5


@pytest.mark.parametrize(("degrees", "height"), [(2.0, 0.0), (45.0, 0.01 * np.sqrt(2.0))])
def test_the_tip_of_a_post_that_tapers_goes_not_to_where_its_sides_would_meet(degrees, height):
    """Posts of a fence became spikes, twice as high."""
    lean = np.radians(degrees)
    normals = np.array([[np.cos(lean), 0, np.sin(lean)], [-np.cos(lean), 0, np.sin(lean)]])
    moves, _ = _to_planes(1, np.zeros(2, int), normals, np.ones(2), np.full(2, 0.01))
    np.testing.assert_allclose(moves, [[0.0, 0.0, height]], atol=1e-4)


def test_a_side_without_a_plane_follows_its_edges():
    V, F, side = bulging((0.06, 0.2))
    moves, flat = flattened(V, F, side)
    assert flat[V[:, 0] < 0.5].min() > 0.99 and not flat[V[:, 0] > 0.5].any()
    row = np.abs(V[:, 1] - 0.5) < 0.01
    along = np.linalg.norm(moves[row], axis=1)[np.argsort(V[row, 0])]
    assert along[6] > 0.01, "the edge"
    assert 0.4 * along[6] < along[7] < along[6] and along[-1] < 1e-4


def test_details_stay_as_high_as_they_are():
    V, F, side = bulging((0.03, 0.03))
    heights = np.zeros(len(V))
    heights[40] = 0.02
    moves, _ = flattened(V + heights[:, None] * [0.0, 0.0, 1.0], F, side, heights)
    np.testing.assert_allclose(moves, flattened(V, F, side)[0], atol=2e-4)


def test_without_sides_nothing_moves():
    V, F, side = bulging((0.03, 0.03))
    moves, flat = flattened(V, F, np.full_like(side, -1))
    assert not moves.any() and not flat.any()


@pytest.mark.parametrize(("crispness", "least", "most"), [(0.9, 0.95, 1.0), (0.5, 0.0, 0.5)])
def test_a_ball_becomes_a_cube_of_planes(crispness, least, most):
    V, F = uv_sphere(32, 16)
    style, options = Style(0.4, crispness=crispness), SolverOptions(keep_rotation=True)
    made = Run(Stylization(Setup(rest_mesh(V, F)), style, options=options))
    made.complete()
    assert least <= share_facing(made.result().positions, F, degrees=1.0) <= most


def test_a_pin_in_the_middle_of_a_side_stays():
    V, F = uv_sphere(32, 16)
    pinned = np.flatnonzero(V[:, 2] > 0.8 * V[:, 2].max())
    setup = Setup(rest_mesh(V, F), pinned)
    made = Run(Stylization(setup, Style(0.4, crispness=1.0)))
    made.complete()
    np.testing.assert_allclose(made.result().positions[pinned], V[pinned], atol=1e-9)


def test_balls_that_are_stuck_together_become_cubes_of_planes():
    """Sides that move cross a part that is stuck in them elsewhere, and it goes along."""
    V, F = uv_sphere(32, 16)
    V = np.concatenate([V, 0.7 * V + [0.0, 0.0, 1.4], 0.15 * V + [0.0, -1.0, 0.1]])
    F = np.concatenate([F + k * (len(V) // 3) for k in range(3)])
    made = Run(Stylization(Setup(rest_mesh(V, F)), Style(0.4, crispness=0.9)))
    made.complete()
    result = made.result()
    assert share_facing(result.positions, F, degrees=2.0) > 0.9 and result.crossings == 0
    knob, body = (result.positions[k * len(V) // 3 :][: len(V) // 3, 1] for k in (2, 0))
    assert knob.min() < body.min() - 0.08 and knob.max() > body.min() + 0.08


def test_however_many_regions_there_are():
    """The number of the region times that of the vertices is more than 32 bit hold."""
    V, F, side = bulging((0.03, 0.03))
    alone = flattened(V, F, side)[0]
    others = np.arange(90_000).reshape(-1, 3)
    places = np.tile([[5.0, 0.0, 0.0], [6.0, 0.0, 0.0], [5.0, 1.0, 0.0]], (len(others), 1))
    F = np.concatenate([others, F + others.size])
    side = np.concatenate([np.full(len(others), -1), side])
    moves, _ = flattened(np.concatenate([places, V]), F, side)
    np.testing.assert_allclose(moves[others.size :], alone, atol=1e-12)


def test_a_flat_open_rim_stays_flat():
    """A lampshade's, which rises at the corners as it becomes square."""
    angle, height = np.meshgrid(np.arange(48) * np.pi / 24, np.linspace(0.0, 1.2, 12))
    radius = 1.0 - 0.3 * height
    V = np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=-1).reshape(-1, 3)
    row, column = np.divmod(np.arange(11 * 48), 48)
    right = 48 * row + (column + 1) % 48
    F = np.stack([48 * row + column, right, right + 48, 48 * (row + 1) + column], axis=1)
    made = Run(Stylization(Setup(rest_mesh(V, F)), Style(0.4, crispness=0.9)))
    made.complete()
    U = made.result().positions
    for rim in (U[:48], U[-48:]):
        assert np.ptp(rim[:, 2]) < 0.004
        assert np.linalg.norm(rim[:, :2], axis=1).max() > 1.3 * np.abs(rim[:, :2]).max(), "square"
