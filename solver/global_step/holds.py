# SPDX-License-Identifier: GPL-3.0-or-later
"""Groups of vertices that keep their place, or follow a handle, while their surface changes.

A group with weights w_i, centroid c and offsets x_i = v_i - c has a place and a rotation: those of
the rigid map v -> R (v - c) + d that fits it best. They are asked for by linear constraints

    sum_i w_i u_i = d,    sum_i w_i y_i x u_i = 0,    y_i = R x_i

of the global step (compare `no_turning`). With P = L^-1 w and T = L^-1 (w x), the best positions
that obey them are the unconstrained ones plus P a' + b x (R T) for each group; all a and b, and in
components without a pinned vertex a translation as well, come from one small linear system.
"""

import numpy as np

from ..algebra import AXIAL
from ..rotation_fit import svd_rotations
from .tall_products import tall_product, transposed_product, weighted_sum

_SMALLEST = 1e-9  # relative; a group on a line may turn about it


class HoldFields:
    """Everything that is computed once per mesh, pins and groups.

    `weights`: sequence of (N,), of the vertices of the input. What is pinned, loose, or in a
    component of which the group has nothing, does not count.

    `components`: (c,) int, those in which there is a group. `fields`: of each group its weights w
    (n,), its centroid, the offsets x (n,3) from that, and P and T, (n,4).
    """

    def __init__(self, setup, weights):
        self.setup, self.weights, rest = setup, weights, setup.rest
        is_free = np.ones(len(rest.V))
        is_free[setup.pinned] = 0.0
        self.fields = []
        for given in weights:
            w = rest.input_map.spread(np.asarray(given, dtype=np.float64)) * rest.standing * is_free
            if w.sum() > 0.0:
                w /= w.sum()
            centroid = w @ rest.V
            x = rest.V - centroid
            stiff = np.column_stack([w, w[:, None] * x])
            self.fields.append((w, centroid, x, self._solve(stiff)))
        component = rest.topology.component
        held = [component[w > 0.0] for w, *_ in self.fields]
        self.components = np.unique(np.concatenate(held or [[]]).astype(int))

    def _solve(self, K):
        """Return L^-1 K (n,4), with nothing where vertices are held."""
        parts = K[:, :3], np.column_stack([K[:, 3:], np.zeros((len(K), 2))])
        columns = [self.setup.global_step.solution(part) for part in parts]
        return np.column_stack([columns[0], columns[1][:, :1]])


class Holds:
    """Constraints of the global step: `impose` moves positions so that they are satisfied.

    `fields`: HoldFields. `matrices`: sequence of (4,4), the map of each group, in the user's unit.
    """

    def __init__(self, fields, matrices):
        rest = fields.setup.rest
        self._places, self._pulls, self._moves, goals = [], [], [], []
        for (w, centroid, x, P), matrix in zip(fields.fields, matrices, strict=True):
            R = svd_rotations(np.asarray(matrix)[:3, :3].T[None])[0]
            start = rest.box.from_unit(centroid[None])
            goal = rest.box.to_unit(start @ matrix[:3, :3].T + matrix[:3, 3])[0]
            self._places.append(w)
            self._pulls.append(w[:, None] * (x @ R.T))
            self._moves.append((P[:, 0], P[:, 1:] @ R.T))
            goals += [goal, np.zeros(3)]
        self._goals = np.concatenate(goals)
        self._free = fields.components[~fields.setup.has_pin[fields.components]]
        self._component = rest.topology.component
        self._inverse = np.linalg.pinv(self._system(), rcond=_SMALLEST)

    def _measure(self, U):
        """Return the places and torques of the groups, (6g,)."""
        found = []
        for w, pull in zip(self._places, self._pulls, strict=True):
            # by a product of matrices: the cross product of each row takes longer
            found += [weighted_sum(w, U), transposed_product(pull, U).ravel() @ AXIAL]
        return np.concatenate(found)

    def _system(self):
        """Return the effect of the unknowns on the measurements, and the balance of forces."""
        groups, free = len(self._places), len(self._free)
        size = 6 * groups + 3 * free
        A = np.zeros((size, size))
        for k in range(size):
            unknown = np.zeros(size)
            unknown[k] = 1.0
            A[: 6 * groups, k] = self._measure(self._change(unknown))
        for j, component in enumerate(self._free):
            for g, w in enumerate(self._places):
                share = w[self._component == component].sum()
                A[6 * groups + 3 * j :, 6 * g : 6 * g + 3][:3] += share * np.eye(3)
                pull = self._pulls[g][self._component == component].sum(axis=0)
                A[6 * groups + 3 * j :, 6 * g + 3 : 6 * g + 6][:3] += _turn(pull)
        return A

    def _change(self, unknown):
        """Return the change (n,3) of the positions for given unknowns."""
        change = np.zeros((len(self._component), 3))
        for g, (P, T) in enumerate(self._moves):
            a, b = unknown[6 * g : 6 * g + 3], unknown[6 * g + 3 : 6 * g + 6]
            change += P[:, None] * a + tall_product(T, _turn(b))
        begin = 6 * len(self._places)
        for j, component in enumerate(self._free):
            change[self._component == component] += unknown[begin + 3 * j : begin + 3 * j + 3]
        return change

    def impose(self, U):
        """Move positions (n,3) to the nearest ones that satisfy the constraints, in place."""
        wrong = np.zeros(len(self._inverse))
        wrong[: len(self._goals)] = self._goals - self._measure(U)
        U += self._change(self._inverse @ wrong)


def _turn(b):
    """Return the matrix (3,3) with the rows b x e_k: times it, a vector v is b x v."""
    return (b @ AXIAL.T).reshape(3, 3)
