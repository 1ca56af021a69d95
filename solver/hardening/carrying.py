# SPDX-License-Identifier: GPL-3.0-or-later
"""What goes along as sides become flat: linked parts, as eyes with a face."""

from typing import Any

import numpy as np
import scipy.sparse as sp
from scipy.spatial import KDTree

from ..algebra import smoothstep

STILL = 0.005, 0.055
"""in the unit box: how far from what is fixed or would cross nothing goes to planes, or all does"""
_MASS = 1e-3  # of the links of a part: the lighter of two goes along, and what is fixed stays
_FIXED = 1e3  # times the area of all


def carried(rest, moves, fixed):
    """Return how far (n,3) parts go along, each as a whole, where vertices (n,3) are moved so far.

    As far as the ends of their links are moved apart, in the mean:

        sum_k w_k |d_k + t_p - t_q|^2 + m sum_p a_p |t_p|^2

    for the translations t of parts p of areas a. Those with vertices `fixed` stay.
    """
    from scipy.sparse.linalg import spsolve  # takes a tenth of a second to import

    part, links = rest.topology.part, rest.to_neighbors
    first, other = part[links.vertices[:, 0]], part[links.vertices[:, 1]]
    rows = np.flatnonzero((first != other) & links.weights.any(axis=1))
    if not len(rows) or not moves.any():
        return np.zeros_like(moves)
    c, weight, count = links.coefficients[rows], links.weights[rows].sum(axis=1), part.max() + 1
    apart = np.einsum("kj,kjx->kx", c, moves[links.vertices[rows]])
    at = np.tile(np.arange(len(rows)), 2), np.concatenate([first[rows], other[rows]])
    ends = sp.csr_matrix((np.concatenate([c[:, 0], -c[:, 0]]), at), shape=(len(rows), count))
    mass = np.bincount(part, rest.areas, count)
    mass[part[fixed]] += _FIXED * mass.sum()
    mass *= _MASS * weight.sum() / mass.sum()
    pulls = ends.multiply(weight[:, None]).T.tocsr()
    matrix: Any = pulls @ ends + sp.diags(mass)
    along: Any = spsolve(matrix.tocsc(), -pulls @ apart)
    return along.reshape(count, 3)[part]


def away_from(U, vertices, times=1.0):
    """Return 0 for positions (n,3) near some vertices (k,), 1 away from them, see `STILL`."""
    if not np.size(vertices):
        return np.ones(len(U))
    start, end = np.multiply(STILL, times)
    far, _ = KDTree(U[np.unique(vertices)]).query(U, distance_upper_bound=end)
    return smoothstep(far, start, end)
