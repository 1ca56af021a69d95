# SPDX-License-Identifier: GPL-3.0-or-later
"""Keep each part of a component from turning, not only the component as a whole.

Links hold parts together where they touch, which is often a joint: the roof of a lamp could tilt
to bring its slope to the cube, and the post would lean the other way, so that both together had
not turned; so could the rods of an arm. A shirt, however, must be able to follow its body. So parts
that others cover only in part keep their rotation, by constraints like those of `no_turning.py`;
the others, and crumbs, follow what they touch.

The torques t_j of all constraints are to vanish, those of the parts and that of the component.
Among the positions that obey them, those of least energy are U + sum_k mu_k x P_k with
P_k = L^-1 (w_k x_k); the mu solve

    sum_k (tr(M_jk) 1 - M_jk') mu_k = -t_j(U),    M_jk = sum_i y_ji P_ki',    y_j = w_j x_j
"""

import numpy as np
import scipy.sparse as sp

from ..algebra import AXIAL
from ..proxy.samples import extents
from .no_turning import SMALLEST
from .tall_products import tall_product, weighted_sum

LARGE = 0.05
"""extent of a part whose rotation is kept, relative to that of its component"""
MOST_PARTS = 32
"""in a component; of more, those that stand out"""
STAND_OUT = 1.5
"""times the extent of the largest part that is not kept: of ten thousand blades of grass, no few
are kept before the others, only the lawn is"""
MANY, SMALL = 16, 2000
"""small components, and their vertices: so many take less time together than one by one"""
MOST_MEMORY = 2**28
"""bytes for the constraints of all components together; the largest components come first"""


class UprightParts:
    """The constraints of the components that have more than one large part.

    `is_free`: (component_count,) bool, components without a pinned vertex; the others are left
    alone. `solve`: maps B (n,3) to the solution X (n,3) of L X = B, or to what is near it: the
    constraints are satisfied all the same, at a little more energy.

    `is_kept`: (component_count,) bool, components that have such constraints.
    """

    def __init__(self, rest, is_free, solve):
        groups = _large_parts(rest, is_free)
        self.is_kept = np.zeros(len(is_free), dtype=bool)
        self.is_kept[list(groups)] = True
        of_all = slice(None) if len(is_free) == 1 else None  # which copies nothing
        self._rows = {c: of_all or groups[c][-1] for c in groups}
        pulls, ways = ({c: [] for c in groups} for _ in range(2))
        place = np.arange(len(rest.V))  # of each vertex among those of its component
        for c in groups if of_all is None else ():
            place[groups[c][-1]] = np.arange(len(groups[c][-1]))
        # One solve serves all components, which have nothing to do with each other.
        for k in range(max(map(len, groups.values()), default=0)):
            pull = np.zeros_like(rest.V)
            having = [c for c in groups if k < len(groups[c])]
            for c in having:
                vertices = groups[c][k]
                share = rest.standing[vertices] / rest.standing[vertices].sum()
                V = rest.V[vertices]
                pull[vertices] = share[:, None] * (V - weighted_sum(share, V))
            P = solve(pull)
            for c in having:
                rows, vertices = self._rows[c], groups[c][k]
                pulls[c].append((place[vertices], pull[vertices]))
                share = rest.weighing[rows] / rest.weighing[rows].sum()
                ways[c].append(P[rows] - weighted_sum(share, P[rows]))  # the centroid stays
        self._ways = {c: np.hstack(ways[c]) for c in groups}
        self._pulls = {c: _rows_of(pulls[c], len(self._ways[c])) for c in groups}
        self._inverses = {c: _inverse(self._pulls[c], self._ways[c]) for c in groups}
        small = [c for c in groups if len(self._ways[c]) <= SMALL]
        self._rows_of_small = np.empty(0, np.intp)
        if len(small) >= MANY:
            self._rows_of_small = np.concatenate([groups[c][-1] for c in small])
            self._rows = {c: self._rows[c] for c in groups if len(self._ways[c]) > SMALL}
            self._of_small = [
                sp.block_diag([blocks.pop(c) for c in small], "csr")
                for blocks in (self._pulls, self._inverses, self._ways)
            ]

    def impose(self, *positions):
        """Move positions (n,3), in place, to the nearest in which no such part has turned.

        Several are moved at once, which takes hardly longer than one of them.
        """
        for c, rows in self._rows.items():
            U = np.hstack([here[rows] for here in positions])
            twists = []
            for moments in np.split(self._pulls[c] @ U, len(positions), axis=1):
                torques = moments.reshape(-1, 9) @ AXIAL
                mu = np.negative(self._inverses[c] @ torques.ravel()).reshape(-1, 3)
                twists.append((mu @ AXIAL.T).reshape(-1, 3))
            moves = tall_product(self._ways[c], np.hstack(twists))
            for here, move in zip(positions, np.split(moves, len(positions), axis=1), strict=True):
                here[rows] += move
        if len(self._rows_of_small):
            for here in positions:
                self._impose_on_small(here)

    def _impose_on_small(self, U):
        rows, (pulls, inverses, ways) = self._rows_of_small, self._of_small
        torques = (pulls @ U[rows]).reshape(-1, 9) @ AXIAL
        mu = np.negative(inverses @ torques.ravel()).reshape(-1, 3)
        U[rows] += ways @ (mu @ AXIAL.T).reshape(-1, 3)


def _large_parts(rest, is_free):
    """Return {component: vertices of each of its large parts, and of all of it}."""
    part, component = rest.topology.part, rest.topology.component
    size = extents(rest.V, part)
    of_part = np.zeros(len(size), np.int64)
    of_part[part] = component
    is_large = is_free[of_part] & (size >= LARGE * extents(rest.V, component)[of_part])
    is_large &= ~rest.is_worn
    counts = np.bincount(of_part[is_large], minlength=len(is_free))
    vertices = np.bincount(component, minlength=len(is_free))
    groups, memory = {}, 0
    for c in sorted(np.flatnonzero(counts > 1), key=lambda c: -vertices[c]):
        parts = np.flatnonzero(is_large & (of_part == c))
        parts = parts[np.argsort(-size[parts], kind="stable")]
        if len(parts) > MOST_PARTS:
            parts = parts[:MOST_PARTS][
                size[parts[:MOST_PARTS]] > STAND_OUT * size[parts[MOST_PARTS]]
            ]
        if not len(parts):
            continue
        memory += 3 * 8 * vertices[c] * (1 + len(parts))
        if memory > MOST_MEMORY:
            break
        groups[c] = [*(np.flatnonzero(part == p) for p in parts), np.flatnonzero(component == c)]
    return groups


def _rows_of(pulls, count):
    columns = np.concatenate([np.tile(vertices, 3) for vertices, _ in pulls])
    data = np.concatenate([pull.T.ravel() for _, pull in pulls])
    start = np.append(0, np.cumsum(np.repeat([len(pull) for _, pull in pulls], 3)))
    return sp.csr_matrix((data, columns, start), shape=(3 * len(pulls), count))


def _inverse(pulls, ways):
    """Return the inverse (3k,3k) of the matrix that maps all mu to torques."""
    count = pulls.shape[0] // 3
    M = (pulls @ ways).reshape(count, 3, count, 3).swapaxes(1, 2)
    traces = np.trace(M, axis1=2, axis2=3)[:, :, None, None] * np.eye(3)
    matrix = (traces - M.swapaxes(2, 3)).swapaxes(1, 2).reshape(3 * count, 3 * count)
    return np.linalg.pinv(0.5 * (matrix + matrix.T), rcond=SMALLEST, hermitian=True)
