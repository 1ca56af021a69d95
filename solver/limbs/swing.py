# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a limb would swing to: the directions in which its sides cost least.

Around a limb along d, the normals are those at right angles to d. In a form of the cost h they cost

    c(d) = mean of h(n) over n at right angles to d

on average, so a limb swings down the slope of c until it has reached a minimum: in the cube, the
nearest axis; in a cylinder, its axis, or the nearest direction at right angles to that.
"""

import numpy as np

from ..styles.cube import Cube

_NORMALS = 48  # around a limb, half of them; the others cost the same in most forms
_STEPS = np.radians([8.0, 4.0, 2.0, 1.0, 0.5, 0.25, 0.125])
_WAYS = 8
_MOST_MOVES = 24  # with each step


def swung(directions, form):
    """Return the nearest directions (s,3) that cost least, for unit vectors in the form's frame.

    form : Cube or Polytope
    """
    if isinstance(form, Cube):
        return _axes(directions)
    d = directions.copy()
    best = _costs(d, form)
    angles = np.arange(_WAYS) * (2.0 * np.pi / _WAYS)
    for step in _STEPS:
        for _ in range(_MOST_MOVES):
            a, b = _across(d)
            sideways = np.cos(angles)[:, None, None] * a + np.sin(angles)[:, None, None] * b
            tried = np.cos(step) * d + np.sin(step) * sideways
            costs = np.stack([_costs(one, form) for one in tried])
            least = costs.argmin(axis=0)
            rows = np.arange(len(d))
            is_lower = costs[least, rows] < best - 1e-9
            if not is_lower.any():
                break
            d = np.where(is_lower[:, None], tried[least, rows], d)
            best = np.where(is_lower, costs[least, rows], best)
    return d


def _axes(directions):
    found = np.zeros_like(directions)
    rows, axis = np.arange(len(found)), np.abs(directions).argmax(axis=1)
    found[rows, axis] = np.where(directions[rows, axis] < 0.0, -1.0, 1.0)
    return found


def _across(d):
    """Return two unit vectors (s,3) at right angles to each other and to d (s,3)."""
    least = np.eye(3)[np.abs(d).argmin(axis=1)]
    a = np.cross(d, least)
    a /= np.linalg.norm(a, axis=1)[:, None]
    return a, np.cross(d, a)


def _costs(d, form):
    a, b = _across(d)
    angles = np.arange(_NORMALS) * (2.0 * np.pi / _NORMALS)
    n = np.cos(angles)[:, None, None] * a + np.sin(angles)[:, None, None] * b
    return form.cost(n.reshape(-1, 3)).reshape(_NORMALS, -1).mean(axis=0)
