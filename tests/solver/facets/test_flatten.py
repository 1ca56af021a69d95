# SPDX-License-Identifier: GPL-3.0-or-later
"""Planar facets: exact, no farther than allowed, with straight edges and without cracks."""

import numpy as np
import pytest
from shapes import blob, extent, rotation, squares

from solver import PAPER, CubicCraftError, flatten_facets, stylize
from solver.mesh.nearest_on_planes import nearest_on_planes

SIDES = np.concatenate([np.eye(3), -np.eye(3)])
ANGLE = np.radians(20.0)


def box(n=8, noise=0.0, seed=0):
    """Return a box of side 1 with n x n squares on each side, and vertices moved at random."""
    V, F = squares(n)
    return V + np.random.default_rng(seed).uniform(-noise, noise, V.shape), F


def normals_of(V, F):
    N = np.cross(V[F[:, 1]] - V[F[:, 0]], V[F[:, 2]] - V[F[:, 0]])
    return N / np.linalg.norm(N, axis=1, keepdims=True)


def roof(slopes, n=6):
    """Return strips side by side, each n squares long, that rise by the given slopes."""
    x = np.arange(len(slopes) + 1.0)
    z = np.concatenate([[0.0], np.cumsum(slopes)])
    V = np.array([[a, y, b] for a, b in zip(x, z, strict=True) for y in range(n + 1)])
    V = V.astype(np.float64)
    i = (np.arange(len(slopes))[:, None] * (n + 1) + np.arange(n)).ravel()
    F = np.concatenate(
        [np.stack([i, i + n + 1, i + 1], 1), np.stack([i + 1, i + n + 1, i + n + 2], 1)]
    )
    return V, F


@pytest.mark.parametrize("turn", [(0, 0, 0), (12, 25, -40)])
def test_a_rough_box_gets_exact_sides_edges_and_corners(turn):
    R = rotation(*turn)
    V, F = box(noise=0.01)
    V = V @ R.T
    flat = flatten_facets(V, F, SIDES @ R.T, ANGLE, 0.05)
    assert flat.count == 6 and (flat.facet_of >= 0).all()
    assert flat.deviation < 1e-14
    np.testing.assert_allclose(
        normals_of(flat.positions, F), flat.normals[flat.facet_of], atol=1e-12
    )
    assert {tuple(n) for n in flat.normals} == {tuple(n) for n in SIDES @ R.T}
    # each side has one height, so the box has 12 straight edges and 8 corners
    heights = flat.positions @ R
    corners = np.array([h for h in np.round(heights, 12) if (np.abs(h) > 0.45).all()])
    assert len(corners) == 8
    assert all(len(np.unique(corners[:, axis])) == 2 for axis in range(3))
    assert flat.moved == len(V)
    assert flat.largest_move == pytest.approx(np.linalg.norm(flat.positions - V, axis=1).max())


def test_each_vertex_goes_to_the_nearest_point_of_its_planes():
    rng = np.random.default_rng(3)
    V = rng.normal(size=(60, 3))
    normals = rng.normal(size=(3, 3))
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    offsets = rng.normal(size=3)
    for k in (1, 2, 3):
        vertex = np.repeat(np.arange(60), k)
        plane = np.tile(np.arange(k), 60)
        most = np.full(60, 3)
        moved, is_in = nearest_on_planes(V, vertex, plane, normals, offsets, most, np.inf)
        A = normals[:k]
        step = np.linalg.lstsq(A, (offsets[:k] - V @ A.T).T, rcond=None)[0].T
        np.testing.assert_allclose(moved, V + step, atol=1e-12)
        assert is_in.all()
        np.testing.assert_allclose(moved @ A.T, np.tile(offsets[:k], (60, 1)), atol=1e-12)


def test_nothing_moves_farther_than_the_tolerance_and_the_rest_keeps_its_bits():
    V, F = blob(4)
    U = stylize(V, F, cubeness=0.4, proxy=PAPER).positions
    for tolerance in (0.02, 0.005):
        flat = flatten_facets(U, F, SIDES, ANGLE, tolerance * extent(U))
        moves = np.linalg.norm(flat.positions - U, axis=1)
        assert 0 < moves.max() <= tolerance * extent(U) * (1 + 1e-12)
        assert flat.moved == np.count_nonzero((flat.positions != U).any(axis=1)) < len(V)
        assert flat.count >= 6 and flat.deviation < 1e-12
        is_flat = flat.facet_of >= 0
        np.testing.assert_allclose(
            normals_of(flat.positions, F)[is_flat], flat.normals[flat.facet_of[is_flat]], atol=1e-9
        )


def test_no_triangle_turns_over():
    for seed in range(6):
        V, F = box(12, noise=0.03, seed=seed)  # a third of the edges: with steep triangles
        before = normals_of(V, F)
        flat = flatten_facets(V, F, SIDES, np.radians(50.0), 0.2)
        assert flat.moved and flat.deviation < 1e-12
        areas = np.cross(
            flat.positions[F[:, 1]] - flat.positions[F[:, 0]],
            flat.positions[F[:, 2]] - flat.positions[F[:, 0]],
        )
        assert (np.einsum("mj,mj->m", areas, before) > 0.0).all()


def test_steeper_triangles_than_the_angle_are_left_alone():
    V, F = roof([0.0, 0.0, 0.0, 0.3])  # 0.3 is 16.7 degrees
    for angle, is_wanted in ((16.0, False), (18.0, True)):
        flat = flatten_facets(V, F, [[0, 0, 1]], np.radians(angle), 1.0)
        is_steep = normals_of(V, F)[:, 2] < 0.99
        assert ((flat.facet_of[is_steep] >= 0) == is_wanted).all()
        assert (flat.facet_of[~is_steep] >= 0).all()


def test_a_tube_is_not_cut_into_flats():
    ring, rows = 48, 12
    around = 2.0 * np.pi * np.arange(ring) / ring
    V = np.array([[np.cos(a), np.sin(a), z] for z in np.linspace(0, 3, rows) for a in around])
    i = np.arange(ring * (rows - 1))
    j = i - i % ring + (i + 1) % ring
    F = np.concatenate([np.stack([i, j, j + ring], 1), np.stack([i, j + ring, i + ring], 1)])
    flat = flatten_facets(V, F, SIDES, ANGLE, 0.1)
    assert flat.count == 0 and flat.moved == 0
    V[:, :2] /= np.linalg.norm(V[:, :2], ord=8, axis=1, keepdims=True)  # a pillar, almost square
    assert flatten_facets(V, F, SIDES, ANGLE, 0.1).count == 4


def test_vertices_beyond_the_tolerance_are_left_alone():
    V, F = roof([0.0, 0.0, 0.0, 0.3, 0.3, 0.3])
    flat = flatten_facets(V, F, [[0, 0, 1]], ANGLE, 0.4)
    is_far = flat.positions[:, 2] > 0.7
    assert is_far.any() and (flat.positions[is_far] == V[is_far]).all()
    assert flat.count == 1 and (flat.facet_of >= 0).sum() < len(F)


def test_fewer_than_three_triangles_are_no_facet():
    V = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0.1], [0, 1, 0]])
    F = np.array([[0, 1, 2], [0, 2, 3]])
    flat = flatten_facets(V, F, [[0, 0, 1]], ANGLE, 1.0)
    assert flat.count == 0 and flat.moved == 0 and (flat.facet_of == -1).all()
    assert flat.positions.tobytes() == V.tobytes() and flat.deviation == 0.0
    more = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4]])
    flat = flatten_facets(np.vstack([V, [[-1, 1, 0.05]]]), more, [[0, 0, 1]], ANGLE, 1.0)
    assert flat.count == 1 and (flat.facet_of == 0).all()


def test_vertices_at_one_place_move_together():
    V, F = box(noise=0.01)
    together = flatten_facets(V, F, SIDES, ANGLE, 0.05)
    apart = flatten_facets(V[F.ravel()], np.arange(F.size).reshape(-1, 3), SIDES, ANGLE, 0.05)
    assert apart.count == 6
    np.testing.assert_allclose(apart.positions, together.positions[F.ravel()], atol=1e-14)
    # to the same bits, or there would be cracks
    places = {tuple(p) for p in apart.positions}
    assert len(places) == len(V)


def test_of_two_planes_that_are_almost_parallel_the_larger_one_wins():
    for slopes, ridge_at, inside in (
        ([0.2, 0.2, 0.2, 0.205, 0.205], 3.0, 1.0),
        ([0.2, 0.2, 0.205, 0.205, 0.205], 2.0, 4.0),
    ):
        V, F = roof(slopes)
        V = V + np.random.default_rng(0).uniform(-1e-4, 1e-4, V.shape)
        flat = flatten_facets(V, F, [[-0.2, 0, 1.0], [-0.205, 0, 1.0]], ANGLE, 0.1)
        assert flat.count == 2
        assert flat.largest_move < 1e-3  # their intersection may be anywhere
        larger = flat.facet_of[(np.abs(V[F, 0] - inside) < 0.1).any(axis=1)][0]
        ridge = np.abs(V[:, 0] - ridge_at) < 0.1
        heights = flat.positions[ridge] @ flat.normals[larger] - flat.offsets[larger]
        assert np.abs(heights).max() < 1e-14


def test_a_vertex_of_no_flat_triangle_is_left_alone():
    V, F = roof([0.0, 0.0, 0.0, 0.3, -0.3, 0.3])
    flat = flatten_facets(V, F, [[0, 0, 1]], ANGLE, 0.2)
    is_between = V[:, 0] == 5.0  # near the plane, but its neighbours are not
    assert (flat.positions[is_between] == V[is_between]).all()
    assert flat.moved == np.count_nonzero(V[:, 0] < 3.5)


def test_a_vertex_may_lie_in_more_than_three_planes():
    top = np.array([0.25, -0.5, 2.0])
    normals = np.array([[1.0, 0, 1], [-1, 0, 1], [0, 1, 1], [0, -1, 1]]) / np.sqrt(2.0)
    offsets = normals @ top
    start = np.array([[0.3, -0.4, 1.9]])
    vertex, most = np.zeros(4, int), np.array([3])
    moved, is_in = nearest_on_planes(start, vertex, np.arange(4), normals, offsets, most, 1.0)
    np.testing.assert_allclose(moved, [top], atol=1e-14)
    assert is_in.all()
    offsets[3] += 0.1
    moved, is_in = nearest_on_planes(start, vertex, np.arange(4), normals, offsets, most, 1.0)
    np.testing.assert_allclose(moved, [top], atol=1e-14)
    assert is_in.tolist() == [True, True, True, False]


def test_a_vertex_too_far_from_the_edge_stays_in_the_larger_plane():
    V, F = box(8)
    is_edge = (np.abs(V) == 0.5).sum(axis=1) == 2
    V = np.where(is_edge[:, None], 0.97 * V, V)  # rounds the edges, not the corners
    wide = flatten_facets(V, F, SIDES, ANGLE, 0.05)
    assert (wide.facet_of >= 0).all() and wide.count == 6
    tight = flatten_facets(V, F, SIDES, ANGLE, 0.014)  # more than to one plane, less than to two
    assert tight.largest_move <= 0.014
    assert (tight.facet_of >= 0).sum() < len(F) and tight.deviation < 1e-14


def test_vertices_stay_on_a_wall():
    R = rotation(y=10)
    V, F = box(noise=0.005)
    inside = np.abs(V[:, 0]) < 0.01
    V, F = V @ R.T, F[(V[F, 0] < 0.01).all(axis=1)]
    V[inside, 0] = 0.0
    free = flatten_facets(V, F, SIDES @ R.T, ANGLE, 0.1)
    assert np.abs(free.positions[inside, 0]).max() > 1e-4
    walled = flatten_facets(V, F, SIDES @ R.T, ANGLE, 0.1, walls=[(inside, [2.0, 0, 0])])
    assert np.abs(walled.positions[inside, 0]).max() < 1e-15
    assert walled.count == free.count and walled.deviation < 1e-14


def test_the_same_input_gives_the_same_bits_and_the_unit_does_not_matter():
    V, F = box(noise=0.01)
    one, two = (flatten_facets(V, F, SIDES, ANGLE, 0.05) for _ in range(2))
    assert one.positions.tobytes() == two.positions.tobytes()
    large = flatten_facets(1024.0 * V, F, 3.0 * SIDES, ANGLE, 1024.0 * 0.05)
    assert large.positions.tobytes() == (1024.0 * one.positions).tobytes()
    again = flatten_facets(one.positions, F, SIDES, ANGLE, 0.05)
    np.testing.assert_allclose(again.positions, one.positions, atol=1e-14)


def test_the_deviation_is_that_of_the_facets():
    V, F = box(noise=0.01)
    flat = flatten_facets(V, F, SIDES, ANGLE, 0.05)
    other = flat.positions.copy()
    other[7] += 0.25
    assert flat.deviation_of(other) == pytest.approx(0.25)
    assert {tuple(p) for p in flat.corners} == {
        (v, f) for triangle, f in zip(F, flat.facet_of, strict=True) for v in triangle
    }


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"positions": np.zeros((3, 2))}, "positions must have the shape"),
        ({"positions": np.full((26, 3), np.nan)}, "not finite"),
        ({"triangles": np.zeros((0, 3), int)}, "no faces"),
        ({"triangles": [[0, 1, 99999]]}, "only"),
        ({"directions": np.zeros((0, 3))}, "directions must have the shape"),
        ({"directions": [[0.0, 0.0, 0.0]]}, "directions must be finite and not zero"),
        ({"directions": [[np.inf, 0.0, 0.0]]}, "directions must be finite and not zero"),
        ({"angle": -0.1}, "the angle must be"),
        ({"angle": np.nan}, "the angle must be"),
        ({"angle": 2.0}, "the angle must be"),
        ({"tolerance": -1.0}, "the tolerance must be"),
        ({"tolerance": np.inf}, "the tolerance must be"),
    ],
)
def test_what_cannot_be_used_is_refused(change, words):
    V, F = box(2)
    given = {"positions": V, "triangles": F, "directions": SIDES, "angle": 0.3, "tolerance": 0.1}
    with pytest.raises(CubicCraftError, match=words) as error:
        flatten_facets(**{**given, **change})
    assert len(str(error.value).splitlines()) == 1
