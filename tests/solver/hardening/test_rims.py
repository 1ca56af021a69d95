# SPDX-License-Identifier: GPL-3.0-or-later
"""Brims become square: their rims become straight, and their flat gives way."""

import numpy as np
import proxy_shapes
import pytest
from facing import squareness

from solver import rest_mesh, stylize
from solver.hardening.rims import rims_and_flats

HAT = [
    (0.02, 0.0),
    (0.5, 0.0),
    (0.98, 0.0),
    (1.0, 0.02),
    (1.0, 0.04),
    (0.98, 0.06),
    (0.5, 0.08),
    (0.42, 0.2),
]
HAT += [(0.25, 0.7), (0.08, 1.2), (0.02, 1.3)]
"""radii and heights of a pointed hat with a brim"""


def revolved(profile, around=48, spacing=0.06):
    """Return a closed surface of revolution."""
    V, F = proxy_shapes.revolved(profile, around, spacing)
    tips, last = [V[:around].mean(axis=0), V[-around:].mean(axis=0)], len(V) - around
    k, after, tip = np.arange(around), np.roll(np.arange(around), -1), np.full(around, len(V))
    caps = [np.stack([tip, after, k], axis=1), np.stack([tip + 1, last + k, last + after], axis=1)]
    return np.concatenate([V, tips]), np.concatenate([F, *caps])


def test_the_outline_of_a_brim_is_square():
    """Where its flat and its rim were held like all else, it stayed round: 1.07."""
    V, F = revolved(HAT)
    U = stylize(V, F).positions
    assert squareness(V) < 1.01
    assert squareness(U) > 1.3
    assert np.ptp(U[:, 2]) == pytest.approx(np.ptp(V[:, 2]), rel=0.1)


def test_a_brim_that_is_thin_beside_the_whole_becomes_square_too():
    """As it is thinner than the details of the whole, it stayed rounder: 1.15."""
    V, F = revolved([(r, z + 3.7) for r, z in HAT])
    W, G = proxy_shapes.joined((V, F), revolved([(0.02, 0), (0.8, 0), (0.7, 2.0), (0.6, 3.7)]))
    U = stylize(W, G).positions
    assert squareness(U[: len(V)]) > 1.25


def test_a_stand_with_a_step_becomes_square():
    """Its flange counted as a limb around it, and its upper rim as none: 1.07 and 1.1."""
    stand = [(0.02, 0), (0.5, 0), (0.52, 0.08), (0.4, 0.15), (0.42, 0.25), (0.02, 0.25)]
    V, F = revolved(stand, 32, 1.0)
    U = stylize(V, F).positions
    for ring in (V[:, 2] == 0.08, (V[:, 2] == 0.25) & (np.linalg.norm(V[:, :2], axis=1) > 0.4)):
        assert squareness(U[ring]) > 1.25


@pytest.mark.parametrize(("size", "is_brim"), [((1, 1, 0.05), True), ((0.1, 0.1, 1), False)])
def test_a_rim_is_narrow_and_between_two_larger_sides(size, is_brim):
    rest = rest_mesh(*proxy_shapes.box(size))
    graph = rest.face_graph
    axis = np.abs(graph.normals).argmax(axis=1)
    side = 2 * axis + (graph.normals[np.arange(len(axis)), axis] < 0.0)
    rim, plate = rims_and_flats(graph, rest.V, rest.F, side, graph.normals)
    is_at_rim = np.zeros(len(rest.V), dtype=bool)
    is_at_rim[rest.F[axis < 2]] = True
    assert rim == pytest.approx(float(is_brim) * is_at_rim)
    assert plate == pytest.approx(float(is_brim))
