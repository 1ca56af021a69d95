# SPDX-License-Identifier: GPL-3.0-or-later
"""Bones say which vertices belong to a limb, and which way it lies."""

from itertools import pairwise

import limb_shapes
import numpy as np
import pytest
import shapes
from scipy.sparse import csr_matrix

from solver import Pose, ProxyOptions, Setup, SolverOptions, Stylization, limbs_of_bones, rest_mesh
from solver.limbs import KnownLimbs, Limbs, turns

X, Y, Z = np.eye(3)
TILTED = np.array([1.0, 0.0, -1.0]) / 2**0.5


def tube(head, tail, radius, rings=12, around=12):
    """Return points (n,3) around a segment."""
    head, tail = np.asarray(head, float), np.asarray(tail, float)
    along = (tail - head) / np.linalg.norm(tail - head)
    a = np.cross(along, Y if abs(along[1]) < 0.9 else X)
    a /= np.linalg.norm(a)
    b = np.cross(along, a)
    angle = np.arange(around) * 2.0 * np.pi / around
    ring = radius * (np.cos(angle)[:, None] * a + np.sin(angle)[:, None] * b)
    return np.concatenate([head + t * (tail - head) + ring for t in np.linspace(0, 1, rings)])


def rig(*bones):
    """Return the arguments of `limbs_of_bones` for bones of (head, tail, radius, parent)."""
    parts = [tube(head, tail, radius) for head, tail, radius, _ in bones]
    of = np.repeat(np.arange(len(parts)), [len(part) for part in parts])
    weights = csr_matrix((np.ones(len(of)), (np.arange(len(of)), of)), shape=(len(of), len(parts)))
    heads, tails = (np.array([bone[k] for bone in bones], float) for k in (0, 1))
    return np.concatenate(parts), weights, heads, tails, np.array([bone[3] for bone in bones])


def chain(points, radii):
    """Return bones from each point to the next."""
    pairs = zip(points[:-1], points[1:], radii, strict=True)
    return [(head, tail, radius, k - 1) for k, (head, tail, radius) in enumerate(pairs)]


def shares(*bones):
    """Return the share (b,) of the vertices of each bone in limbs, and the KnownLimbs."""
    V, weights, heads, tails, parents = rig(*bones)
    limbs = limbs_of_bones(V, weights, heads, tails, parents)
    own = np.asarray(limbs.shares.sum(axis=1)).ravel()
    assert limbs.known.all() and own.max() <= 1.0 + 1e-12
    return (weights.T @ own) / weights.sum(axis=0).A1, limbs


def test_an_arm_is_a_limb_along_its_bones():
    elbow, lower = 3.0 * TILTED, np.array([0.6, 0.0, -0.8])
    found, limbs = shares(*chain([0 * X, elbow, elbow + 2.0 * lower], [0.4, 0.3]))
    assert found == pytest.approx(1.0)
    np.testing.assert_allclose(limbs.present, [TILTED, lower], atol=1e-12)


def test_many_short_bones_of_a_tail_are_measured_together():
    points = [np.array([0.3 * k, 0.0, -0.01 * k**2]) for k in range(13)]
    found, _ = shares(*chain(points, np.linspace(0.4, 0.25, 12)))
    assert found.min() == pytest.approx(1.0)
    alone, _ = shares(chain(points, 12 * [0.4])[0])
    assert alone.max() == 0.0


def test_before_a_fork_a_bone_is_measured_with_neither_of_the_next():
    way = np.array([np.sin(np.radians(15.0)), 0.0, np.cos(np.radians(15.0))])
    first = (0 * X, Z, 0.4, -1)
    legs = [(Z, Z + way * side, 0.4, 0) for side in ([1, 1, 1], [-1, 1, 1])]
    one, _ = shares(first, legs[0])
    both, _ = shares(first, *legs)
    assert one.min() > 0.9 and both.max() == 0.0


def test_a_spine_in_a_wide_trunk_is_no_limb():
    found, _ = shares(*chain([0.25 * k * Z for k in range(5)], [0.4, 0.45, 0.45, 0.5]))
    assert found.max() == 0.0


def test_a_head_stays_trunk_and_a_hand_goes_with_its_arm():
    found, _ = shares((0 * X, 2 * TILTED, 0.2, -1), (2 * TILTED, 2.5 * TILTED, 0.5, 0))
    assert found == pytest.approx([1.0, 0.0])
    hand = 2 * TILTED + 0.25 * TILTED + 0.1 * X
    found, limbs = shares((0 * X, 2 * TILTED, 0.2, -1), (2 * TILTED, hand, 0.25, 0))
    assert found == pytest.approx(1.0)
    np.testing.assert_allclose(limbs.present, [TILTED, TILTED], atol=1e-12)
    bent = np.array([np.sin(np.radians(72.0)), 0.0, -np.cos(np.radians(72.0))])
    hand = 2 * TILTED + 0.35 * bent
    found, limbs = shares((0 * X, 2 * TILTED, 0.2, -1), (2 * TILTED, hand, 0.25, 0))
    assert found == pytest.approx(1.0)
    np.testing.assert_allclose(limbs.present, [TILTED, bent], atol=1e-12)


def test_arms_of_a_slim_figure_are_no_hands_of_its_spine():
    """Its spine is as long and thin as a limb; shoulders go aside from it, and lead to the arms."""
    spine = ((0, 0, 0), Z, 0.2, -1)
    shoulders = [(Z, (x, 0, 0.95), 0.12, 0) for x in (0.3, -0.3)]
    arm = ((0.3, 0, 0.95), (0.8, 0, 0.45), 0.08, 1)
    own, limbs = shares(spine, *shoulders, arm)
    assert own[0] > 0.9 and own[3] > 0.9
    for bone, direction in ((0, Z), (3, TILTED)):
        np.testing.assert_allclose(abs(limbs.carried[bone] @ limbs.directions[bone] @ direction), 1)


def test_a_limb_that_bends_past_a_diagonal_is_not_twisted():
    angles = np.radians([20, 35, 50, 65])
    directions = np.stack([np.cos(angles), 0.6 * np.sin(angles), 0.8 * np.sin(angles)], axis=1)
    points = [0 * X, *np.cumsum(directions, axis=0)]
    _, limbs = shares(*chain(points, 4 * [0.1]))
    np.testing.assert_allclose(limbs.present, directions, atol=1e-12)
    G = turns(limbs, np.eye(3)[None])[::144]
    for one, other in pairwise(G):
        angle = np.degrees(np.arccos(0.5 * (np.trace(one.T @ other) - 1.0)))
        assert angle == pytest.approx(15.0, abs=1e-6)  # that of the bend; no more about itself


def test_mirror_images_have_mirrored_limbs():
    flip = np.array([-1.0, 1.0, 1.0])
    arm = [(0.3 * X, 1.5 * X - Z, 0.2, -1), (1.5 * X - Z, 2.5 * X - Y - 1.5 * Z, 0.15, 0)]
    V, weights, heads, tails, parents = rig(*arm)
    rng = np.random.default_rng(0)
    mixed = csr_matrix(weights.toarray() + 0.4 * rng.random(weights.shape))
    one = limbs_of_bones(V, mixed, heads, tails, parents)
    other = limbs_of_bones(V * flip, mixed, heads * flip, tails * flip, parents)
    np.testing.assert_allclose(other.present, one.present * flip, atol=1e-14)
    np.testing.assert_allclose(other.shares.toarray(), one.shares.toarray(), atol=1e-13)


def test_bones_that_point_sideways_lie_toward_the_next():
    V, weights, heads, tails, parents = rig(*chain([0 * X, 2 * TILTED, 4 * TILTED], [0.2, 0.2]))
    tails[0] = heads[0] + 0.5 * Y
    limbs = limbs_of_bones(V, weights, heads, tails, parents)
    np.testing.assert_allclose(limbs.present[0], TILTED, atol=1e-12)


@pytest.mark.parametrize("slope", [5, 45, 60])
@pytest.mark.parametrize("has_twist", [False, True])
def test_bones_that_all_point_up_lie_along_the_limbs(slope, has_twist):
    """As those of a VRM or glTF file, also with a twist bone between two joints."""
    along = np.array([np.cos(np.radians(slope)), 0.0, -np.sin(np.radians(slope))])
    points = [t * along for t in (0.0, 3.0, 6.0, 7.0)]
    V, weights, heads, tails, parents = rig(*chain(points, [0.7, 0.6, 0.5]))
    before = limbs_of_bones(V, weights, heads, tails, parents)
    tails = heads + 0.5 * Z
    if has_twist:  # which moves a few of the vertices of the upper arm
        own = weights.toarray()
        middle = 1.5 * along
        is_near = (np.linalg.norm(V - middle, axis=1) < 1.0) & (own[:, 0] > 0.0)
        weights = csr_matrix(np.c_[own, 0.3 * is_near])
        heads, tails = np.vstack([heads, middle]), np.vstack([tails, middle + 0.5 * Z])
        parents = np.append(parents, 0)
    limbs = limbs_of_bones(V, weights, heads, tails, parents)
    np.testing.assert_allclose(limbs.present[:2], before.present[:2], atol=1e-9)
    total = [np.asarray(one.shares.sum(axis=1)).ravel() for one in (before, limbs)]
    np.testing.assert_allclose(total[1], total[0], atol=0.02)


def test_what_is_broken_is_no_limb():
    V, weights, heads, tails, _ = rig(*chain([0 * X, 2 * X, 4 * X, 6 * X], 3 * [0.2]))
    tails[2] = heads[2]
    heads[1] = np.nan
    weights.data[:3] = np.nan, -1.0, np.inf
    empty = csr_matrix((len(V), 1))
    weights = csr_matrix(np.hstack([weights.toarray(), empty.toarray()]))
    heads, tails = np.vstack([heads, X]), np.vstack([tails, Y])
    limbs = limbs_of_bones(V, weights, heads, tails, np.array([-1, 0, 1, 3]))
    assert np.isfinite(limbs.directions).all() and np.isfinite(limbs.shares.data).all()
    assert not limbs.known[:3].any() and limbs.known[3:].all()
    assert limbs.shares[:, 1:].nnz == 0 and limbs.shares[:, 0].max() == pytest.approx(1.0)


def test_a_frame_goes_along_with_a_bone_in_any_pose():
    limb = Limbs(TILTED[None], csr_matrix([[1.0]]))
    at_rest = turns(limb, np.eye(3)[None])[0]
    spun = np.linalg.qr(np.random.default_rng(1).random((3, 3)))[0]
    spun *= np.linalg.det(spun)
    np.testing.assert_allclose(
        turns(limb.turned(spun[None]), np.eye(3)[None])[0], at_rest @ spun.T, atol=1e-12
    )


def test_pieces_turn_as_their_vertices_do():
    V, *bones = rig(*chain([0 * X, 3.0 * TILTED, 3.0 * TILTED + 2.0 * Y], [0.4, 0.3]))
    limbs, spun = limbs_of_bones(V, *bones), shapes.rotation(x=50, z=-70)
    posed = limbs.posed(V, V @ spun.T + [3.0, -1.0, 2.0])
    np.testing.assert_allclose(posed.present, limbs.present @ spun.T, atol=1e-9)


def test_a_body_of_which_bones_say_that_it_has_no_limbs_has_none():
    V, F = limb_shapes.bar(shapes.rotation(y=30))
    rest = rest_mesh(V, F, ProxyOptions())
    known = np.ones(len(V), dtype=bool)
    trunk = KnownLimbs(np.empty((0, 3)), csr_matrix((len(V), 0)), known)
    of_trunk = Stylization(
        Setup(rest), 0.4, Pose(limbs=trunk), SolverOptions(device="numpy")
    ).style.Q
    np.testing.assert_array_equal(of_trunk, np.broadcast_to(np.eye(3), of_trunk.shape))
    known[: len(V) // 2] = False
    partly = KnownLimbs(np.empty((0, 3)), csr_matrix((len(V), 0)), known)
    found = Stylization(Setup(rest), 0.4, Pose(limbs=partly), SolverOptions(device="numpy")).style.Q
    assert np.abs(found - np.eye(3)).max() > 0.1
