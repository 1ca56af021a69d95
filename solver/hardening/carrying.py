# SPDX-License-Identifier: GPL-3.0-or-later
"""Parts go along with what they are linked to as its sides become flat: eyes with a face."""

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import spsolve

_MASS = 1e-3  # of the links of a part: the lighter of two goes along, and what is fixed stays
_FIXED = 1e3  # times the area of all


def carried(rest, moves, fixed):
    """Return how far (n,3) parts go along, each as a whole, where vertices (n,3) are moved so far.

    As far as the ends of their links are moved apart, in the mean:

        sum_k w_k |d_k + t_p - t_q|^2 + m sum_p a_p |t_p|^2

    for the translations t of parts p of areas a. Those with vertices `fixed` stay.
    """
    part, links = rest.topology.part, rest.to_neighbors
    used = (links.coefficients != 0.0) & (links.weights.any(axis=1))[:, None]
    first, other = part[links.vertices[:, 0]], part[links.vertices[:, 1]]
    rows = np.flatnonzero(used[:, 1] & (first != other) & moves[links.vertices].any(axis=(1, 2)))
    if not len(rows):
        return np.zeros_like(moves)
    first, other, coefficients = first[rows], other[rows], links.coefficients[rows]
    apart = np.einsum("kj,kjx->kx", coefficients, moves[links.vertices[rows]])
    weight, count = links.weights[rows].sum(axis=1), int(part.max()) + 1
    k = np.arange(len(rows))
    sign = coefficients[:, 0]
    at = np.concatenate([k, k]), np.concatenate([first, other])
    D = sp.csr_matrix((np.concatenate([sign, -sign]), at), shape=(len(rows), count))
    mass = np.bincount(part, rest.areas, count)
    mass[part[fixed]] += _FIXED * mass.sum()
    pull = D.T @ sp.diags(weight) @ D
    matrix = pull + sp.diags(_MASS * weight.sum() * mass / mass.sum() + 1e-300)
    along = spsolve(matrix.tocsc(), -D.T @ (weight[:, None] * apart))
    return along.reshape(count, 3)[part]
