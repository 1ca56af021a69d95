# SPDX-License-Identifier: GPL-3.0-or-later
"""Grounds, walls and stray parts: a figure becomes what it becomes alone."""

from functools import cache

import numpy as np
import proxy_shapes
import pytest
import shapes
from procrustes import degrees

from solver import ProxyOptions, rest_mesh, stylize
from solver.proxy.sheets import extrusions, planar_sheets

RUN = {"device": "numpy", "keep_rotation": True, "crispness": 0.0, "proxy": ProxyOptions()}


def figure():
    """Return an egg that stands on the plane z = 0, of height 3."""
    V, F = shapes.sphere(4)
    V = V * [1.0, 0.8, 1.5]
    return V - [0.0, 0.0, V[:, 2].min()], F


@cache
def moves_alone():
    V, F = figure()
    return stylize(V, F, 0.4, **RUN).positions - V


def ground(size, turn=None):
    V, F = shapes.sheet(9)
    V = (V * [1.0, 1.0, 0.0] / np.ptp(V, axis=0).max() - [0.5, 0.5, 0.0]) * size
    return (V if turn is None else V @ turn.T), F


def test_sheets_are_told_from_other_parts():
    tilted = ground(1.0, shapes.rotation(20, 30, 0))
    V, F = proxy_shapes.joined(figure(), tilted)
    part = np.repeat([0, 1], [len(figure()[0]), len(tilted[0])])
    assert planar_sheets(V, F, part).tolist() == [False, True]
    V, F = proxy_shapes.joined(tilted, ground(2.0))
    part = np.repeat([0, 1], len(tilted[0]))
    assert not planar_sheets(V, F, part).any(), "there is nothing else"


def test_a_plane_beside_a_point_keeps_its_size():
    V, F = ground(3.0)
    W, G = proxy_shapes.joined((V, F), (np.ones((3, 3)), np.array([[0, 1, 2]])))
    U = stylize(W, G, 0.4, **RUN).positions
    assert np.isfinite(U).all() and np.ptp(U, axis=0).max() > 2.0


@pytest.mark.parametrize("size", [10.0, 1000.0])
def test_a_ground_neither_moves_nor_moves_the_figure(size):
    V, F = figure()
    alone = moves_alone()
    W, G = proxy_shapes.joined((V, F), ground(size))
    both = stylize(W, G, 0.4, **RUN).positions - W
    assert np.abs(both[len(V) :]).max() < 1e-9
    assert np.abs(both[: len(V)] - alone).max() < 0.06 * np.abs(alone).max()


def test_no_form_turns_a_sheet_beside_a_figure():
    (V, F), (P, T) = figure(), ground(1.0, shapes.rotation(20, 30, 0))
    W, G = proxy_shapes.joined((V, F), (P + [3.0, 0.0, 1.5], T))
    U = stylize(W, G, 0.4, **{**RUN, "keep_rotation": False}).positions
    assert np.abs(U - W)[len(V) :].max() < 1e-9


def test_a_stray_triangle_far_away_changes_nothing():
    V, F = figure()
    alone = moves_alone()
    W, G = proxy_shapes.joined((V, F), ([[100.0, 0, 0], [100.1, 0, 0], [100, 0, 0.1]], [[0, 1, 2]]))
    both = stylize(W, G, 0.4, **RUN).positions - W
    assert np.abs(both[: len(V)] - alone).max() < 0.06 * np.abs(alone).max()


def letter(sides=4):
    """Return an extruded L, or a prism of `sides` that is as long."""
    if sides == 4:
        outline = np.array([[0, 0], [3, 0], [3, 1], [1, 1], [1, 4], [0, 4.0]])
        caps = np.array([[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]])
        depth = 0.6
    else:
        angles = np.arange(sides) * 2.0 * np.pi / sides
        outline = 0.3 * np.stack([np.cos(angles), np.sin(angles)], axis=1)
        caps = np.array([[0, k, k + 1] for k in range(1, sides - 1)])
        depth = 4.0
    n = len(outline)
    V = np.concatenate([np.c_[outline, np.full(n, z)] for z in (0.0, depth)])
    ring = np.arange(n)
    after = (ring + 1) % n
    rim = np.concatenate([np.c_[ring, after, after + n], np.c_[ring, after + n, ring + n]])
    return V, np.concatenate([caps[:, ::-1], caps + n, rim])


@pytest.mark.parametrize(("sides", "is_letter"), [(4, True), (6, False)])
def test_letters_are_told_from_limbs(sides, is_letter):
    V, F = letter(sides)
    V = V @ shapes.rotation(20, 30, 40).T
    part = np.zeros(len(V), np.int64)
    assert extrusions(V, F, part).tolist() == [is_letter]
    assert bool(len(rest_mesh(V, F, ProxyOptions()).limbs.directions)) != is_letter


def test_leaves_do_not_turn_a_trunk():
    """Cards at one side of its top: their number, area and stiffness are those of many leaves."""
    rng = np.random.default_rng(5)
    V, F = shapes.sphere(3)
    trunk = V * [0.35, 0.3, 1.5]
    corners = np.array([[0.0, -0.5, 0], [1, -0.5, 0], [1, 0.5, 0], [0, 0.5, 0]])
    places = trunk[(V[:, 2] > 0.3) & (V[:, 0] > 0.0)]
    leaves = [
        (0.4 * corners @ np.linalg.qr(rng.normal(size=(3, 3)))[0] + place, [[0, 1, 2], [0, 2, 3]])
        for place in places[rng.choice(len(places), 60)]
    ]
    free = {**RUN, "keep_rotation": False}
    alone = stylize(trunk, F, 0.4, **free).positions
    W, G = proxy_shapes.joined((trunk, F), *((P, np.array(T)) for P, T in leaves))
    U = stylize(W, G, 0.4, **free).positions[: len(trunk)]
    assert degrees(alone, U) < 0.06
    assert abs(U[:, 2].min() - alone[:, 2].min()) < 0.003 * np.ptp(alone[:, 2])


def test_a_flag_that_begins_to_wave_stays_a_sheet():
    flag = ground(1.0, shapes.rotation(90, 0, 0))
    W, G = proxy_shapes.joined(figure(), (flag[0] + [1.5, 0, 1.5], flag[1]))
    rest = rest_mesh(W, G, ProxyOptions())
    waving = W + 0.1 * np.sin(8.0 * W[:, :1]) * [0.0, 1.0, 0.0]
    posed = rest.posed(waving)
    assert rest.is_sheet.any()
    np.testing.assert_array_equal(posed.is_sheet, rest.is_sheet)
