# SPDX-License-Identifier: GPL-3.0-or-later
"""What covers a limb, such as a sleeve, lies as the limb does, whatever its own shape says."""

import numpy as np
import scipy.sparse as sp
from scipy.spatial import KDTree

from .limbs import Limbs

COVERING = 0.6
"""share of the area of a part that is linked to others; with more, it lies and turns as these do"""
_PASSES = 2  # a button on a sleeve on an arm
_APART = 10.0  # farther than any part is wide


def with_coverings(limbs, V, part, links, linked_share):
    """Return the Limbs in which parts that cover others lie as these do.

    `limbs`: Limbs, as found in each part. `V`: (n,3), rest positions in the unit box. `part`: (n,)
    int. `links`: Links between parts. `linked_share`: (p,), share of the area of each part that is
    linked to others. Of two that are linked to each other, that with the larger share covers the
    other.
    """
    is_covering = linked_share > COVERING
    if not (len(limbs) and is_covering.any()):
        return limbs
    target, source, weight = _directed(links)
    is_used = is_covering[part[target]] & (linked_share[part[target]] > linked_share[part[source]])
    target, source, weight = target[is_used], source[is_used], weight[is_used]
    if not len(target):
        return limbs
    n = len(V)
    means = sp.csr_matrix((weight, (target, source)), shape=(n, n))
    total = np.asarray(means.sum(axis=1)).ravel()
    known = np.flatnonzero(total > 0.0)
    means = sp.diags(1.0 / total[known]) @ means[known]
    is_taking = np.zeros(len(linked_share), dtype=bool)
    is_taking[part[known]] = True
    rows = np.flatnonzero(is_taking[part])
    place = np.column_stack([V, _APART * part])
    nearest = KDTree(place[known]).query(place[rows])[1]
    taken = sp.csr_matrix((np.ones(len(rows)), (rows, nearest)), shape=(n, len(known)))
    own = sp.diags(np.where(is_taking[part], 0.0, 1.0)) @ limbs.shares
    shares = own
    for _ in range(_PASSES):
        shares = own + taken @ (means @ shares)
    return Limbs(limbs.directions, sp.csr_matrix(shares))


def _directed(links):
    """Return vertices (e,), vertices (e,) that they are linked to, and weights, both ways."""
    first = np.repeat(links.vertices[:, 0], 3)
    others, weight = links.vertices[:, 1:].ravel(), np.abs(links.coefficients[:, 1:]).ravel()
    is_link = weight > 1e-9
    first, others, weight = first[is_link], others[is_link], weight[is_link]
    both = np.concatenate([first, others]), np.concatenate([others, first])
    return *both, np.tile(weight, 2)
