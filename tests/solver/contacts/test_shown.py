# SPDX-License-Identifier: GPL-3.0-or-later
"""Crossings count if they can be seen."""

import numpy as np
from contact_shapes import joined
from proxy_shapes import uv_sphere

from solver.contacts.crossings import crossings
from solver.contacts.shown import shown


def cross(at):
    """Return two small triangles that cross each other at a place."""
    V = np.array([[-1.0, -1, 0], [1, -1, 0], [0, 1, 0], [0, 0, -1], [0, 0.1, 1], [0, -1, 1]])
    return 0.1 * V + at, np.array([[0, 1, 2], [3, 4, 5]])


def test_what_is_inside_is_not_seen():
    V, F = joined(uv_sphere(24, 12), cross([0.1, 0.2, 0.0]), cross([2.0, 0.3, 0.1]))
    pairs = crossings(V, F)
    count = len(uv_sphere(24, 12)[1])
    assert pairs.tolist() == [[count, count + 1], [count + 2, count + 3]]
    assert shown(V, F, pairs).tolist() == [False, True]


def test_a_line_on_the_outside_is_seen():
    """Where two balls go into each other, a line goes around both."""
    V, F = uv_sphere(24, 12)
    V, F = joined((V, F), (V * 0.9 + [0.7, 0.05, 0.02], F))
    assert shown(V, F, crossings(V, F)).all()


def test_nothing_crosses():
    V, F = uv_sphere(8, 4)
    assert shown(V, F, np.empty((0, 2), int)).shape == (0,)
