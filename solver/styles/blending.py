# SPDX-License-Identifier: GPL-3.0-or-later
"""Several styles on one mesh: what each vertex is turned toward where they overlap.

A vertex that has several forms with shares c has the cost c_1 h_1 + c_2 h_2. This is the support
function of the Minkowski sum c_1 W_1 + c_2 W_2 (Schneider, Convex Bodies: The Brunn-Minkowski
Theory, section 1.7), another convex body, so the local step stays exact.
"""

from functools import lru_cache

import numpy as np

from .forms import cube
from .polytope import minkowski_sum

LEVELS = 8
"""steps from one form to another; each has a body of its own"""
MOST_SUMS = 8000
"""of two vertices; between bodies with more, such as a cylinder and a cone, there is no third"""
_ALIKE = 1e-6  # rotations that differ less are the same


def blended(styles, weights):
    """Return what each vertex is turned toward if it has shares of several styles.

    The cubeness is the weighted mean. Of the forms, the two with the largest shares count, in steps
    of 1/8.

    `styles`: sequence of Style, each with one cubeness and one form. `weights`: (n,k), shares of
    them; each row adds up to 1. Returns `cubeness`: (n,); `orientation`: (1,3,3) or (n,3,3);
    `bodies`: list of Polytope, or None for the cube; `body_of`: (n,) int, that of each vertex.
    """
    shares = weights * np.array([style.cubeness for style in styles])
    cubeness = shares.sum(axis=1)
    # Where nothing is turned, the form is that of the weights.
    shares = np.where(cubeness[:, None] > 0.0, shares, weights)
    order = np.argsort(-shares, axis=1, kind="stable")
    first, second = order[:, 0], order[:, min(1, len(styles) - 1)]
    rows = np.arange(len(shares))
    larger, smaller = shares[rows, first], shares[rows, second]
    total = larger + smaller
    level = np.round(LEVELS * smaller / np.where(total > 0.0, total, 1.0)).astype(int)
    level[first == second] = 0
    second = np.where(level > 0, second, first)
    cases, case = np.unique(np.stack([first, second, level], axis=1), axis=0, return_inverse=True)
    bodies = [_between(styles, *row) for row in cases.tolist()]
    distinct, numbers = numbered(bodies)
    return cubeness, _orientations(styles, first), distinct, numbers[case.ravel()]


def numbered(bodies):
    """Return the distinct ones of some bodies, None for the cube, and the number (k,) of each."""
    keys = [body and body.key for body in bodies]
    distinct = dict(zip(keys, bodies, strict=True))
    place = {key: number for number, key in enumerate(distinct)}
    return list(distinct.values()), np.array([place[key] for key in keys])


def _between(styles, first, second, level):
    """Return the body between two styles in the frame of the first, None for the cube."""
    one, other = styles[first], styles[second]
    if level == 0:
        return one.form
    # of one vertex: beyond a plane of symmetry, both are mirrored alike
    a, b = (np.reshape(style.orientation, (-1, 3, 3))[0] for style in (one, other))
    turn = b @ a.T
    body, added = one.form or cube(), other.form or cube()
    if _is_the_same(body, added, turn):
        return one.form
    if len(body.vertices) * len(added.vertices) > MOST_SUMS:
        return one.form
    return _sum(body, added, turn.tobytes(), level)


def _is_the_same(body, other, turn):
    costs = other.cost(body.normals @ turn.T)
    return (
        len(body.normals) == len(other.normals)
        and np.abs(costs - body.offsets).max() <= _ALIKE * body.radius
        and np.abs(body.cost(other.normals @ turn) - other.offsets).max() <= _ALIKE * body.radius
    )


@lru_cache(maxsize=128)
def _sum(one, other, turn, level):
    share = level / LEVELS
    turned = other.turned(np.frombuffer(turn).reshape(3, 3))
    return minkowski_sum(one.scaled(1.0 - share), turned.scaled(share))


def _orientations(styles, number):
    """Return the orientations of the styles with these numbers (n,), (1,3,3) if all are alike."""
    n = len(number)
    all_Q = np.stack([np.broadcast_to(style.orientation, (n, 3, 3)) for style in styles])
    if np.abs(all_Q - all_Q[0, :1]).max() <= _ALIKE:
        return all_Q[0, :1]
    return all_Q[number, np.arange(n)]
