# SPDX-License-Identifier: GPL-3.0-or-later
"""The cube: the cost of a normal, its active sets and its symmetries."""

from functools import cache

import numpy as np
from numpy.typing import ArrayLike

from ..algebra import columns, cross, times, transposed_times
from ..aliases import FloatArray


class Cube:
    """The cube as the form of a local problem; `Polytopes` is the other one.

    The state of a vertex is its subgradient s (3,): the sign of x_k, but anything in [-1, 1] on the
    active axes, those with x_k = 0.
    """

    width = 3
    """columns of a state"""
    faces = None
    """no tables: they are found from the state itself"""

    def part(self, rows):
        """Return the form of some rows."""
        return self

    def cost(self, x):
        """Return the costs |x|_1 (n,) of normals x (n,3) in the frame of the form."""
        return np.abs(x).sum(axis=-1)

    def starting(self, x):
        """Return the states (n,3) to begin with, for normals x (n,3): no axis active."""
        return np.where(x < 0.0, -1.0, 1.0)

    def begin(self, states):
        """Return what is kept from step to step: here s and the active axes, both (n,3)."""
        return states, np.abs(states) < 1.0

    def end(self, kept):
        """Return the states (n,3)."""
        return kept[0]

    def active_count(self, kept):
        """Return how many axes are active (n,)."""
        return kept[1].sum(axis=1)

    def constraints(self, kept):
        """Return s (n,3), how many axes are active (n,), and the direction that they leave (n,3).

        With one active axis that is the axis, with two it is where the normal has to point.
        """
        s, active = kept
        number = self.active_count(kept)
        return s, number, np.where((number == 2)[:, None], np.where(active, 0.0, s), active)

    def next_set(self, kept, moment, x, y, problem, slack):
        """Return what is kept, with new multipliers, and where the active axes may stay (n,).

        `kept`: tuple of arrays. `moment`: (n,3), gradient of tr(W G) for small turns W. `x`, `y`:
        (n,3), normals in the frame of the form, and in that of the mesh. `problem`: LocalProblem.
        `slack`: float.
        """
        (s, active), x, lam, Q = (a.T for a in kept), x.T, problem.lam, columns(problem.Q)
        has_cost = lam > 0.0
        fixed = transposed_times(*Q, *np.where(active, 0.0, s))
        force = moment.T - lam * cross(*y.T, *fixed)
        size = np.maximum(1.0 - x * x, 1e-6) * np.where(has_cost, lam, 1.0)
        s = np.where(active, times(*Q, *cross(*force, *y.T)) / size, s)
        crossed = has_cost & ~active & (x * s < -slack)
        freed = np.abs(s) > 1.0
        is_kept = ~(crossed | (np.abs(s) > 1.0 + slack)).any(axis=0)
        s, active = np.where(freed, np.sign(s), s), (active & ~freed) | crossed
        size = np.abs(x)
        freed = (size == size.max(axis=0)) & active.all(axis=0)
        s = np.where(freed, np.where(x > 0.0, 1.0, -1.0), s)
        return (s.T, (active & ~freed).T), is_kept

    def split(self, x, states):
        """Return normals x (n,3) without their part along active axes."""
        return np.where(np.abs(states) < 1.0, 0.0, x)

    def project(self, points):
        """Return the states (n,3) nearest to points (n,3)."""
        return np.clip(points, -1.0, 1.0)


CUBE = Cube()


def nearest_to_identity(Q: ArrayLike) -> FloatArray:
    """Return the rotation (3,3) nearest to the identity that is equivalent to Q for a cube.

    There are 24 that map the cube to the same orientation as Q (3,3) does.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import nearest_to_identity
    >>> quarter_turn = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    >>> np.allclose(nearest_to_identity(quarter_turn), np.eye(3))
    True
    """
    same = _symmetries() @ Q
    return same[np.argmax(np.trace(same, axis1=1, axis2=2))]


def proper(matrix):
    """Return the rotations (...,3,3) that are equivalent for a cube, which is its mirror image."""
    is_proper = np.linalg.det(matrix)[..., None, None] > 0.0
    return np.where(is_proper, matrix, -matrix)


@cache
def _symmetries():
    from scipy.spatial.transform import Rotation  # here, because drawing the cube does not need it

    return Rotation.create_group("O").as_matrix()
