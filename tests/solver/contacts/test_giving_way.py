# SPDX-License-Identifier: GPL-3.0-or-later
"""What may cross: hair gives way to a head, and parts where they would stay round."""

from types import SimpleNamespace

import contact_shapes
import numpy as np
import pytest
from facing import angle_to_axes
from proxy_shapes import eye_in_head, joined, revolved, torus, uv_sphere
from shapes import rotation

from solver import (
    ProxyOptions,
    Run,
    Setup,
    SolverOptions,
    Style,
    Stylization,
    rest_mesh,
    stylize,
)
from solver.contacts.riding import Riding, riding
from solver.proxy.sheets import cards

COUNT, ROWS = 100, 5
SIDES = 5


def hair():
    """Return cards that hang down around the upper half of a ball, through each other."""
    rng = np.random.default_rng(0)
    z, a = rng.uniform(0.1, 1.0, COUNT), rng.uniform(0.0, 2.0 * np.pi, COUNT)
    flat = np.sqrt(1.0 - z * z)
    p = np.stack([flat * np.cos(a), flat * np.sin(a), z], axis=1)
    down = 0.3 * rng.normal(size=p.shape) - [0.0, 0.0, 1.0]
    down -= p * (p * down).sum(axis=1)[:, None]
    down /= np.linalg.norm(down, axis=1)[:, None]
    t = np.linspace(0.0, 1.0, ROWS)
    angle, height = 0.5 * t, 1.01 + 0.02 * rng.random(COUNT)[:, None] + 0.08 * t
    along = p[:, None] * np.cos(angle)[:, None] + down[:, None] * np.sin(angle)[:, None]
    across = 0.05 * np.cross(p, down)[:, None] * (1.0 - 0.6 * t)[:, None]
    middle = along * height[..., None]
    V = np.stack([middle - across, middle + across], axis=2).reshape(-1, 3)
    i = (2 * ROWS * np.arange(COUNT)[:, None] + 2 * np.arange(ROWS - 1)).ravel()
    return V, np.concatenate([np.stack([i, i + 2, i + 1], 1), np.stack([i + 1, i + 2, i + 3], 1)])


def strands(count=COUNT):
    """Return closed tubes where the cards are."""
    cards_of_hair, _ = hair()
    left, right = cards_of_hair.reshape(COUNT, ROWS, 2, 3)[:count].swapaxes(0, 2).swapaxes(1, 2)
    middle, across = (left + right) / 2.0, (right - left) / 4.0
    up = middle * np.linalg.norm(across, axis=2)[..., None]
    angle = np.linspace(0.0, 2.0 * np.pi, SIDES, endpoint=False)[:, None, None, None]
    rings = middle + np.cos(angle) * across + np.sin(angle) * up  # (sides,count,rows,3)
    V = rings.transpose(1, 2, 0, 3).reshape(count, -1, 3)
    i, side = np.arange(ROWS - 1)[:, None] * SIDES, np.arange(SIDES)
    a, b = (i + side).ravel(), (i + (side + 1) % SIDES).ravel()
    walls = [np.stack([a, b, b + SIDES], 1), np.stack([a, b + SIDES, a + SIDES], 1)]
    k, last = np.arange(1, SIDES - 1), (ROWS - 1) * SIDES
    lids = [np.stack([0 * k, k + 1, k], 1), last + np.stack([0 * k, k, k + 1], 1)]
    F = np.concatenate(walls + lids) + V.shape[1] * np.arange(count)[:, None, None]
    return V.reshape(-1, 3), F.reshape(-1, 3)


@pytest.mark.thorough(1)  # that strands are cards is tested below
@pytest.mark.parametrize("make, crispness", [(hair, 0.9), (strands, 0.9), (hair, 0.0)])
def test_a_head_becomes_as_cubic_as_without_keep_apart(make, crispness):
    head = uv_sphere(24, 12)
    V, F = joined(head, make())
    n, results = len(head[0]), []
    for keep_apart in (False, True):
        proxy = ProxyOptions(keep_apart=keep_apart)
        results.append(stylize(V, F, proxy=proxy, keep_rotation=True, crispness=crispness))
    free, kept = (angle_to_axes(result.positions[:n], head[1]) for result in results)
    assert kept < free + 0.3
    before, after = (_below(result.positions, n, head[1]) for result in results)
    assert after < 0.4 * before + 2


def test_parts_may_cross_where_a_round_would_cost_more_style_than_it_saves():
    V, F = joined(bird(32), ring(0.6, 0.09, 2.62))
    free, kept = (stylize(V, F, proxy=ProxyOptions(keep_apart=kept)) for kept in (False, True))
    assert angle_to_axes(kept.positions, F) < angle_to_axes(free.positions, F) + 0.5
    assert 0 < kept.pressed <= kept.crossings
    assert free.pressed is None


def crisp_run(V, F, crispness=1.0):
    """Return a Run to flat sides, at its end, and how much of what was crisp there is left."""
    setup = Setup(rest_mesh(V, F, ProxyOptions(keep_apart=True, refine=False)))
    style, options = Style(0.4, crispness=crispness), SolverOptions(keep_rotation=True)
    made = Run(Stylization(setup, style, options=options))
    made.complete()
    return made, made.hard.crisp_area / made._hard_end[0].crisp_area


@pytest.mark.parametrize(
    "make",
    [
        lambda: contact_shapes.dressed(gap=0.006)[:2],
        lambda: contact_shapes.figure(degrees=40)[:2],
        eye_in_head,
    ],
)
def test_what_crosses_once_sides_are_flat_is_pushed_apart_and_stays_crisp(make):
    made, share = crisp_run(*make())
    assert share > 0.98 and made.result().crossings == 0


def test_parts_may_cross_where_they_would_else_stay_soft():
    mesh = bird(16)
    made, share = crisp_run(*mesh)
    result = made.result()
    assert share > 0.99 and result.crossings == result.pressed > 0
    softer = made.with_crispness(0.4)
    softer.complete()
    assert softer.result() == crisp_run(*mesh, 0.4)[0].result(), "that before is not the measure"


def bird(segments):
    """Return an egg with a head, wings and feet, all of them close to each other."""
    ball, faces = uv_sphere(segments, segments // 2)
    sizes = [(0.7, 0.6, 0.95), (0.58, 0.55, 0.52)] + 2 * [(0.14, 0.28, 0.6), (0.2, 0.33, 0.12)]
    places = [(0, 0, 1), (0, 0, 2.25), (-0.76, 0.05, 1.2), (-0.3, -0.15, 0.12)]
    places += [(0.76, 0.05, 1.2), (0.3, -0.15, 0.12)]
    parts = [(ball * size + place, faces) for size, place in zip(sizes, places, strict=True)]
    return joined(*parts)


def ring(radius, thickness, height):
    V, quads = torus(40, 12, thickness / radius)
    return radius * V + [0, 0, height], np.concatenate([quads[:, :3], quads[:, [0, 2, 3]]])


def test_studs_stay_on_their_bricks():
    """They touch them at rest, and stand on what is seen of them, not on what is solved."""
    cells = np.stack(np.meshgrid(*3 * [np.arange(-3, 4)]), axis=-1).reshape(-1, 3)
    distance = np.linalg.norm(cells, axis=1)
    V, F = joined(*(brick_with_stud(cell) for cell in cells[(distance > 1.5) & (distance < 3.5)]))
    result = stylize(V, F, keep_rotation=True, crispness=0.9)
    assert result.crossings == 0
    stud = result.positions.reshape(-1, 8 + 25, 3)[:, 8:]
    assert np.median(np.ptp(stud[:, :, 2], axis=1)) > 0.15


def brick_with_stud(place):
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]) - 0.5
    quads = np.array(
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    )
    angle = np.arange(12) * np.pi / 6
    circle = 0.3 * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    rings = [np.column_stack([circle, np.full(12, z)]) for z in (0.5, 0.7)]
    i, j = np.arange(12), (np.arange(12) + 1) % 12
    stud = [(i, j, j + 12), (i, j + 12, i + 12), (i + 12, j + 12, np.full(12, 24))]
    F = [quads[:, [0, 1, 2]], quads[:, [0, 2, 3]], *(np.stack(t, axis=1) + 8 for t in stud)]
    return np.vstack([corners, *rings, [[0, 0, 0.7]]]) + place, np.concatenate(F)


def _below(U, n, F):
    """Return how many vertices of cards are inside the head, by solid angles."""
    a, b, c = (U[F[:, k]][None] - U[n:, None] for k in range(3))
    la, lb, lc = (np.linalg.norm(x, axis=2) for x in (a, b, c))
    volume = np.einsum("pfx,pfx->pf", a, np.cross(b, c))
    rest = la * lb * lc + (a * b).sum(2) * lc + (b * c).sum(2) * la + (c * a).sum(2) * lb
    return int((np.arctan2(volume, rest).sum(axis=1) > np.pi).sum())


def test_what_is_large_or_closed_is_no_card():
    head, (V, F) = uv_sphere(32, 16), hair()
    shirt = 1.1 * head[0], head[1][: len(head[1]) // 2]
    V, F = joined(head, (V, F), shirt, (0.1 * head[0] + [2.0, 0, 0], head[1]))
    sizes = [len(head[0]), *[2 * ROWS] * COUNT, len(head[0]), len(head[0])]
    part = np.repeat(np.arange(len(sizes)), sizes)
    found = cards(V, F, part, np.zeros(len(V), int))
    assert found.tolist() == [False, *[True] * COUNT, False, False]


def test_closed_strands_are_cards_where_they_are_many_on_something():
    head = uv_sphere(32, 16)
    for parts, count, expected in (
        ((head, strands()), COUNT, True),
        ((head, strands(50)), 50, False),
        ((strands(),), COUNT, False),
    ):
        V, F = joined(*parts)
        sizes = [len(head[0])] * (len(parts) - 1) + [ROWS * SIDES] * count
        part = np.repeat(np.arange(len(sizes)), sizes)
        found = cards(V, F, part, np.zeros(len(V), int))
        assert found.tolist() == [False] * (len(parts) - 1) + [expected] * count


def test_each_vertex_of_a_card_rides_on_what_is_nearest_to_it():
    V, F = uv_sphere(24, 12)
    heights = np.linspace(0.1, 0.5, 20)
    above = (1.0 + heights)[:, None] * V[40:60]
    rest = SimpleNamespace(V=np.concatenate([V, above]), shown=F, is_card=np.zeros(len(V), bool))
    ridden = riding(rest, np.arange(len(rest.V)) >= len(V))
    assert ridden.vertices.tolist() == list(range(len(V), len(rest.V)))
    np.testing.assert_allclose(np.linalg.norm(ridden.offsets, axis=1), heights, atol=0.02)


def test_what_rides_is_turned_as_what_it_rides_on():
    V = np.random.default_rng(0).normal(size=(3, 3))
    share, offset, spun = np.array([[0.2, 0.3, 0.5]]), np.array([[0.1, 0.2, 1.0]]), rotation(40, 70)
    card = Riding(np.array([3]), np.array([[0, 1, 2]]), share, offset)
    R = card.turned(np.concatenate([np.tile(spun, (3, 1, 1)), np.eye(3)[None]]))
    np.testing.assert_allclose(R[3], spun, atol=1e-12)
    U = card.carried(np.vstack([V @ spun.T, np.zeros(3)]), R)
    np.testing.assert_allclose(U[3], ((share @ V + offset) @ spun.T)[0], atol=1e-12)


def test_a_stick_that_goes_through_a_ball_becomes_square():
    """As both became square, its faces crossed others of the ball, and it stayed round: 1.06."""
    stick = revolved([(1e-3, -1.3), (0.06, -1.3), (0.06, 1.3), (1e-3, 1.3)], 16)
    ball, faces = uv_sphere(64, 48)
    V, F = joined(stick, (0.2 * ball + [0.0, 0.0, 1.2], faces))
    far = np.linalg.norm(stylize(V, F).positions[16:32, :2], axis=1)
    assert far.max() / far.min() > 1.25


def lathed(low, high, radius, around):
    """Return a cylinder whose lids are fans of triangles."""
    V, F = revolved([(radius, low), (radius, high)], around)
    i, n = np.arange(around), len(V)
    j = (i + 1) % around
    bottom = np.stack([j, i, np.full(around, n)], axis=1)
    top = np.stack([around + i, around + j, np.full(around, n + 1)], axis=1)
    return np.vstack([V, [0, 0, low], [0, 0, high]]), np.concatenate([F, bottom, top])


def test_what_stands_on_a_lid_does_not_dent_it():
    cake, candle = lathed(0.0, 0.37, 0.47, 48), lathed(0.37, 0.67, 0.035, 16)
    ways = ([0.2, 0, 0], [0, 0.2, 0], [-0.2, 0, 0], [0, -0.2, 0])
    V, F = joined(cake, *((candle[0] + way, candle[1]) for way in ways))
    U = stylize(V, F, 0.4, proxy=ProxyOptions(), keep_rotation=True, crispness=0.9).positions
    top = U[: len(cake[0])][cake[0][:, 2] > 0.3]
    assert np.ptp(top[:, 2]) < 1e-3
