# SPDX-License-Identifier: GPL-3.0-or-later
"""Limbs: what is one, which way it lies, and that it keeps its direction."""

import tracemalloc
from dataclasses import replace

import limb_shapes
import named_forms
import numpy as np
import proxy_shapes
import pytest
import scipy.sparse as sp
import shapes
from facing import angle_to_axes
from proxy_shapes import uv_sphere

from solver import (
    Mirror,
    Pose,
    ProxyOptions,
    Setup,
    SolverOptions,
    Style,
    Stylization,
    partners,
    rest_mesh,
    run,
    stylize,
)
from solver.limbs import KnownLimbs, Limbs, no_limbs, turns, with_hollows, without_shells
from solver.limbs.swing import swung
from solver.proxy.cavities import OF_STRENGTH
from solver.proxy.links import links_between
from solver.proxy.thickness import STRENGTH
from solver.styles import forms
from solver.styles.forms import cube, prism

LIMBS = ProxyOptions(detail=0.0, keep_apart=False)
DEFAULTS = ProxyOptions()
KEPT = {"keep_rotation": True, "crispness": 0.0}


def tilted(degrees):
    return shapes.rotation(y=degrees)


def along_z(V):
    """Return the direction of the largest spread of positions (n,3), upward."""
    direction = np.linalg.eigh(np.cov(V.T))[1][:, 2]
    return direction if direction[2] > 0 else -direction


def angle_between(a, b):
    return np.degrees(np.arccos(np.clip(a @ b, -1.0, 1.0)))


@pytest.mark.thorough(2)
@pytest.mark.parametrize("degrees", [10, 30, 45, 60])
def test_a_tilted_bar_becomes_a_box_along_itself(degrees):
    turn = tilted(degrees)
    V, F = limb_shapes.bar(turn)
    U = stylize(V, F, 0.4, proxy=DEFAULTS, **KEPT).positions
    assert angle_between(along_z(U), along_z(V)) < 1.0
    V, F = limb_shapes.bar(np.eye(3))
    upright = stylize(V, F, 0.4, proxy=DEFAULTS, **KEPT).positions
    assert angle_to_axes(U @ turn, F) < angle_to_axes(upright, F) + 0.5 < 15.0
    assert angle_to_axes(V, F) > 20.0


def test_without_it_the_bar_swings():
    V, F = limb_shapes.bar(tilted(30))
    proxy = replace(DEFAULTS, keep_pose=False)
    U = stylize(V, F, 0.4, proxy=proxy, **KEPT).positions
    middle = np.abs(V @ tilted(30))[:, 2] < 0.5
    assert angle_between(along_z(U[middle]), along_z(V[middle])) > 10.0


def leg(thigh, shank):
    """Return a leg of two halves at these angles to the vertical."""
    way = [[np.sin(x), 0.0, np.cos(x)] for x in np.radians([thigh] * 40 + [shank] * 40)]
    return limb_shapes.tube(np.cumsum(way, axis=0) * 0.035, 0.2)


def test_beside_a_bend_a_limb_lies_as_itself_and_not_as_what_is_beyond():
    directions = rest_mesh(*leg(30.0, 0.0), DEFAULTS).limbs.directions
    angles = np.degrees(np.arctan2(np.abs(directions[:, 0]), np.abs(directions[:, 2])))
    is_right = np.minimum(angles, np.abs(angles - 30.0)) < 4.0
    assert len(angles) > 4 and np.count_nonzero(~is_right) <= 1, angles


@pytest.mark.parametrize("slope", [60.0, 80.0])
def test_a_shank_lies_as_itself_and_not_as_the_foot(slope):
    bend = [2.0] * 35 + [0.0] * 35 + list(np.linspace(0.0, slope, 6)) + [slope] * 12
    way = [[np.sin(x), 0.0, np.cos(x)] for x in np.radians(bend)]
    leg_and_foot = limb_shapes.tube(np.cumsum(way, axis=0) * 0.035, 0.2)
    directions = rest_mesh(*leg_and_foot, DEFAULTS).limbs.directions
    assert np.degrees(np.arccos(np.abs(directions[:, 2]))).max() < 8.0


def test_a_leg_that_bends_a_little_keeps_its_bend():
    V, F = leg(40.0, 20.0)
    U = stylize(V, F, 0.4, proxy=DEFAULTS, **KEPT).positions
    low, high = V[:, 2] < 0.8 * V[:, 2].mean(), V[:, 2] > 1.2 * V[:, 2].mean()
    before, after = (angle_between(along_z(x[low]), along_z(x[high])) for x in (V, U))
    assert before > 17.0 and after > 0.8 * before


def test_a_spring_keeps_its_height_and_its_turns_apart():
    V, F = limb_shapes.spring(3)
    result = stylize(V, F, 0.4, proxy=DEFAULTS, **KEPT)
    assert np.ptp(result.positions[:, 2]) > 0.8 * np.ptp(V[:, 2])
    assert result.crossings == 0


@pytest.mark.parametrize("make", [shapes.sphere, shapes.blob, proxy_shapes.box, shapes.sheet])
def test_balls_boxes_and_sheets_have_no_limbs(make):
    rest = rest_mesh(*make(), DEFAULTS)
    assert rest.limbs.shares.sum() < 0.01 * len(rest.V)


def test_the_paths_of_a_spring_do_not_lead_from_turn_to_turn():
    limbs = rest_mesh(*limb_shapes.spring(), DEFAULTS).limbs
    assert len(limbs) > 20
    slope = np.abs(limbs.directions[:, 2])
    difference = np.abs(slope - np.sin(np.arctan(0.45 / (2 * np.pi))))
    assert difference.max() < 0.06 and np.median(difference) < 0.005
    assert limbs.shares.sum(axis=1).min() > 0.9


def test_a_sleeve_lies_as_the_arm_in_it():
    arm, cloth = limb_shapes.bar(tilted(40)), limb_shapes.sleeve(tilted(40))
    rest = rest_mesh(*proxy_shapes.joined(arm, cloth), DEFAULTS)
    shares = rest.limbs.shares.toarray()
    of_cloth = rest.topology.part == rest.topology.part[rest.place[1][-1]]
    assert 0 < of_cloth.sum() < len(of_cloth)
    assert shares[of_cloth].sum(axis=1).min() > 0.9
    ways = shares[of_cloth] @ np.abs(rest.limbs.directions @ (tilted(40) @ [0, 0, 1.0]))
    assert ways.min() > 0.9


def test_sleeves_with_nothing_in_them_keep_their_direction():
    V, F = limb_shapes.empty_sleeves(40.0)
    U = stylize(V, F, 0.4, proxy=DEFAULTS, **KEPT).positions
    x = V[:, 0] - V[:, 0].mean()
    for side in (-x, x):
        is_sleeve = side > 0.8
        assert angle_between(along_z(U[is_sleeve]), along_z(V[is_sleeve])) < 5.0


@pytest.mark.parametrize("has_two_sides", [True, False])
def test_how_much_of_a_part_faces_itself_counts_beside_one_of_its_sides(has_two_sides):
    V, areas, limbs = np.random.default_rng(0).random((10, 3)), np.full(10, 0.1), no_limbs(10)
    weight = 0.2 * OF_STRENGTH * STRENGTH / ((V[1] - V[0]) ** 2).sum()  # a fifth of the area
    walls, cavities = (
        links_between(*np.array([[i], [i + 1]]), weight * np.ones(1)) for i in (2, 0)
    )
    walls = walls.part(np.arange(1 if has_two_sides else 0))
    found = with_hollows(limbs, V, None, walls, cavities, np.zeros(10, int), 0.0 * V, areas)
    assert (found is not limbs) == has_two_sides


def test_the_outer_side_of_a_sleeve_lies_as_the_inner_one():
    V, F = limb_shapes.empty_sleeves(40.0)
    rest = rest_mesh(V, F, DEFAULTS)
    outer, inner = np.split(rest.limbs.shares.toarray()[rest.place[1]], 2)
    assert np.median(np.abs(outer - inner).sum(axis=1)) < 0.05
    assert outer.sum(axis=1).min() > 0.9


def test_halves_have_frames_that_are_mirror_images_bit_for_bit():
    V, F = limb_shapes.bar(tilted(35))
    V = V + [1.5, 0.0, 0.0]
    both, faces = proxy_shapes.joined((V, F), (V * [-1, 1, 1], F[:, ::-1]))
    flip = np.diag([-1.0, 1.0, 1.0])
    mirror = Mirror(partners(both, both @ flip, 1e-6), flip, np.zeros(3))
    setup = Setup(rest_mesh(both, faces, LIMBS), mirrors=[mirror])
    state = Stylization(setup, 0.4, options=SolverOptions(keep_rotation=True))
    (solved,) = setup.mirrors
    pair = np.flatnonzero(solved.partner > np.arange(len(solved.partner)))
    assert len(pair) > 1000
    Q = state._style.Q
    np.testing.assert_array_equal(Q[solved.partner[pair]], flip @ Q[pair] @ flip)
    assert np.abs(Q - np.eye(3)).max() > 0.5
    U = run(state).positions
    np.testing.assert_allclose(U[len(V) :], U[: len(V)] * [-1, 1, 1], atol=1e-12)


def test_what_is_known_counts_instead_of_the_shape():
    V, F = limb_shapes.bar(tilted(30))
    n = len(V)
    known = KnownLimbs(
        np.array([[0.0, 0.0, 1.0]]), sp.csr_matrix(np.ones((n, 1))), np.ones(n, bool)
    )
    rest = rest_mesh(V, F, LIMBS)
    upright = Stylization(Setup(rest), 0.4, Pose(limbs=known), SolverOptions(keep_rotation=True))
    np.testing.assert_allclose(
        upright._style.Q, np.tile(np.eye(3), (len(rest.V), 1, 1)), atol=1e-12
    )
    nothing = replace(known, known=np.zeros(n, bool))
    found, same = (
        Stylization(Setup(rest), 0.4, Pose(limbs=x), SolverOptions(keep_rotation=True))._style.Q
        for x in (None, nothing)
    )
    np.testing.assert_allclose(found, same, atol=1e-12)


@pytest.mark.thorough(2)
@pytest.mark.parametrize("proxy", [LIMBS, replace(DEFAULTS, keep_apart=False)])
@pytest.mark.parametrize("form", [None, forms.octahedron()])
def test_the_energy_falls_and_a_second_run_has_the_same_bits(proxy, form, device):
    V, F = limb_shapes.bar(tilted(35), length=1.6)
    found = []
    for _ in range(2):
        state = Stylization(
            Setup(rest_mesh(V, F, proxy)),
            Style(0.4, form=form),
            options=SolverOptions(device=device, keep_rotation=True, is_accelerated=False),
        )
        energies = []
        run(state, 15, 1e-12, lambda s, energies=energies: energies.append(s.energy.total))
        assert np.diff(energies).max() <= 1e-9 * energies[0]
        found.append(state.positions.tobytes())
    assert found[0] == found[1]


# -- where limbs swing to, and the turn of the frame ---------------------------------------------


def test_in_a_cube_they_swing_to_the_nearest_axis():
    d = shapes.rotation(20, -25, 12)
    np.testing.assert_allclose(swung(d, cube()), np.eye(3), atol=0.01)


def test_in_a_prism_they_swing_to_its_axis_if_that_is_near():
    upright = np.array([[0.3, 0.1, 1.0]])
    upright /= np.linalg.norm(upright)
    assert abs(swung(upright, prism(6))[0, 2]) > 0.999


@pytest.mark.parametrize("form", ["octahedron", "dodecahedron", "icosahedron", "cylinder"])
def test_a_limb_that_lies_right_is_not_turned(form):
    body = named_forms.POLYTOPES[form]()
    d = np.random.default_rng(1).normal(size=(20, 3))
    there = swung(d / np.linalg.norm(d, axis=1)[:, None], body)
    again = swung(there, body)
    assert np.degrees(np.arccos(np.clip(np.abs((there * again).sum(axis=1)), 0, 1))).max() < 1.0


def test_between_pieces_the_nearest_of_equal_frames_is_blended():
    """At 44 and at 46 degrees the cube turns to different axes, which is nearly the same cube."""
    directions = np.array([[np.sin(x), 0.0, np.cos(x)] for x in np.radians([44.0, 46.0])])
    limbs = Limbs(directions, sp.csr_matrix([[1.0, 0.0], [0.5, 0.5], [0.0, 1.0]]))
    G = turns(limbs, np.eye(3)[None])
    for x in G:
        in_the_frame = np.abs(x @ directions[0])
        assert np.degrees(np.arccos(in_the_frame.max())) < 2.5
    np.testing.assert_allclose(G @ G.swapaxes(1, 2), np.tile(np.eye(3), (3, 1, 1)), atol=1e-12)


def test_toward_a_trunk_the_turn_of_a_limb_becomes_less():
    d = shapes.rotation(y=20) @ [0.0, 0.0, 1.0]
    limbs = Limbs(d[None], sp.csr_matrix([[1.0], [0.5], [0.0]]))
    angles = [np.degrees(np.arccos((np.trace(G) - 1) / 2)) for G in turns(limbs, np.eye(3)[None])]
    np.testing.assert_allclose(angles, [20.0, 10.0, 0.0], atol=1e-4)


TIN = [(0.02, 0), (0.45, 0), (0.45, 1), (0.42, 1), (0.42, 0.03), (0.02, 0.03)]
MUG = [(0.02, 0), (0.45, 0), (0.5, 0.04), (0.5, 1.05), (0.48, 1.08), (0.45, 1.05), (0.45, 0.1)]
MUG += [(0.42, 0.07), (0.02, 0.07)]


@pytest.mark.parametrize(
    ("outline", "step", "around"), [(TIN, 0.15, 40), (TIN, 0.3, 24), (MUG, 0.5, 64)]
)
def test_the_rings_of_a_wall_are_no_limbs(outline, step, around):
    """Where vertices of both sides are on rings, so are the midpoints: half of it was limbs."""
    V, F = proxy_shapes.revolved(outline, around, step)
    assert not rest_mesh(V, F).limbs.shares.nnz


STAND = [(0.02, 0), (0.5, 0), (0.52, 0.08), (0.4, 0.15), (0.42, 0.25), (0.02, 0.25)]
RING = [(1.0 + 0.2 * np.cos(a), 0.2 * np.sin(a)) for a in np.linspace(0.0, 2.0 * np.pi, 13)]


@pytest.mark.parametrize(("outline", "is_limb"), [(STAND, False), (RING, True)])
def test_what_is_attached_all_along_is_no_limb(outline, is_limb):
    """The flange of a stand was one, around it, and stayed round; a ring for itself is one."""
    V, F = proxy_shapes.revolved(outline, 32)
    limbs = rest_mesh(V, F).limbs
    assert (limbs.shares.nnz > 0.5 * len(V)) == is_limb


@pytest.mark.parametrize(
    ("share", "wall", "is_shell"), [(0.2, 0.02, True), (0.2, 0.1, False), (0.6, 0.02, False)]
)
def test_the_rim_of_a_shell_is_no_limb(share, wall, is_shell):
    """The trunk of a figure is thicker than its limbs, and a spring is all limb."""
    V = np.random.default_rng(0).uniform(size=(100, 3))
    is_limb = np.arange(100) < 100 * share
    limbs = Limbs(np.eye(3)[:1], sp.csr_matrix(is_limb[:, None].astype(float)))
    thickness = np.where(is_limb, 0.03, wall)
    found = without_shells(limbs, V, np.zeros(100, int), np.full(100, 0.01), thickness)
    assert found.shares.sum() == (0.0 if is_shell else limbs.shares.sum())


def test_a_flat_bar_is_a_limb():
    """As flat as an arm of a cartoon, it faces more ways than a wall."""
    V, F = limb_shapes.bar(np.eye(3))
    limbs = rest_mesh(V * [1.0, 0.35, 1.0] @ tilted(30.0).T, F, DEFAULTS).limbs
    assert limbs.shares.sum() > 0.9 * len(V)


@pytest.mark.parametrize("thickness", [0.06, 0.1])
def test_a_ring_lies_as_its_axis_does_and_becomes_square(thickness):
    """A wheel was a polygon of many sides, each of which lay its own way."""
    angle = np.linspace(0.0, 2.0 * np.pi, 13)
    V, F = proxy_shapes.revolved(
        np.stack([1.0 + thickness * np.cos(angle), thickness * np.sin(angle)], axis=1), 64
    )
    leaning = V @ tilted(20.0).T
    limbs = rest_mesh(leaning, F, DEFAULTS).limbs
    is_used = np.asarray(limbs.shares.sum(axis=0)).ravel() > 0.0
    assert np.abs(limbs.directions[is_used] @ tilted(20.0)[:, 2]).min() > 0.999
    U = stylize(leaning, F, 0.4, proxy=DEFAULTS, **KEPT).positions @ tilted(20.0)
    across = np.ptp(U @ shapes.rotation(z=45.0), axis=0)[:2]
    assert (across > 1.2 * np.ptp(U, axis=0)[:2]).all()


def bars(count):
    """Return the RestMesh of bars side by side, each turned another way."""
    z = np.linspace(-1.5, 1.5, 24)
    V, F = limb_shapes.tube(np.outer(z, [0.0, 0.0, 1.0]), 0.2, 12)
    angles = np.random.default_rng(2).uniform(-60, 60, (count, 3))
    places = [[4.0 * (k % 16), 4.0 * (k // 16), 0.0] for k in range(count)]
    turned = ((V @ shapes.rotation(*a).T + at, F) for a, at in zip(angles, places, strict=True))
    return rest_mesh(*proxy_shapes.joined(*turned), ProxyOptions())


def peak_of_limbs(rest):
    """Return the Limbs of a RestMesh, and the most bytes at once while they are found."""
    tracemalloc.start()
    limbs = rest.limbs
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return limbs, peak


def test_of_many_bars_each_lies_along_itself_in_memory_that_grows_with_their_number():
    few, peak_of_few = peak_of_limbs(bars(32))
    rest = bars(128)
    limbs, peak = peak_of_limbs(rest)
    assert peak < 6.0 * peak_of_few  # with distances between all, it was 9 times
    assert len(limbs) == 4 * len(few) == 128
    of_vertex = np.asarray(limbs.shares.argmax(axis=1)).ravel()
    for k in range(128):
        rows = np.flatnonzero(rest.topology.part == k)
        found = np.bincount(of_vertex[rows]).argmax()
        direction = np.linalg.eigh(np.cov(rest.V[rows].T))[1][:, 2]
        assert abs(limbs.directions[found] @ direction) > 0.999


SIDES, RINGS = 16, 24


def horn(degrees, length):
    """Return a horn that leans and whose one side runs along it, its direction, and its head."""
    a = np.radians(degrees)
    d = np.array([0.8 * np.sin(a), 0.6 * np.sin(a), np.cos(a)])
    x = np.cross(d, [0.3, 0.2, 0.9])
    x /= np.linalg.norm(x)
    y = np.cross(d, x)
    t, angle = np.meshgrid(np.linspace(0, 1, RINGS), 2 * np.pi * np.arange(SIDES) / SIDES)
    t, angle = t.T[..., None], angle.T[..., None]
    radius, middle = 0.2 - 0.18 * t, (0.5 + length * t) * d - 0.162 * t * y
    V = (middle + radius * (np.cos(angle) * x + np.sin(angle) * y)).reshape(-1, 3)
    V = np.concatenate([V, [0.5 * d], middle[-1]])
    i = np.arange(SIDES * RINGS).reshape(RINGS, SIDES)
    p, q = i[:-1].ravel(), np.roll(i, -1, axis=1)[:-1].ravel()
    first, second = np.roll(i[0], -1), np.roll(i[-1], -1)
    F = [
        np.stack([p, q, q + SIDES], 1),
        np.stack([p, q + SIDES, p + SIDES], 1),
        np.stack([np.full(SIDES, len(V) - 2), first, i[0]], 1),
        np.stack([np.full(SIDES, len(V) - 1), i[-1], second], 1),
    ]
    head, of_head = uv_sphere(32, 16)
    return np.concatenate([V, 0.7 * head]), np.concatenate([*F, of_head + len(V)])


def direction(V):
    middles = V[: SIDES * RINGS].reshape(RINGS, SIDES, 3).mean(axis=1)[RINGS // 4 :]
    return np.linalg.svd(middles - middles.mean(axis=0))[2][0]


@pytest.mark.thorough(1)
@pytest.mark.parametrize(("degrees", "length"), [(45, 0.6), (20, 0.8), (35, 0.8)])
def test_a_horn_keeps_its_direction(degrees, length):
    V, F = horn(degrees, length)
    result = stylize(V, F, proxy=ProxyOptions(), keep_rotation=True)
    cosine = abs(direction(V) @ direction(result.positions))
    assert np.degrees(np.arccos(min(cosine, 1.0))) < 5.0
