# SPDX-License-Identifier: GPL-3.0-or-later
"""Shells, such as helmets, caps and cups: what is found along their rims is no limb.

The trunk of a figure is thicker than its limbs. The wall of a shell is no thicker than its rim, its
crest or its handle, and is most of it.
"""

from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from ..proxy.samples import extents

WALL = 0.7
"""least share of the area that is no limb, in a shell"""
THIN = 0.08
"""largest thickness of that, beside the extent of the part,..."""
THICKER = 1.2
"""...and beside what looks like limbs"""


def without_shells(limbs, V, part, areas, thickness):
    """Return Limbs without those in parts that are shells.

    `V`: (n,3). `part`: (n,) int. `areas`, `thickness`: (n,), infinite where it is unknown.
    """
    if not len(limbs):
        return limbs
    own = np.minimum(np.asarray(limbs.shares.sum(axis=1)).ravel(), 1.0)
    count = int(part.max()) + 1
    is_known = np.isfinite(thickness)
    weights = [np.where(is_known, areas * share, 0.0) for share in (own, 1.0 - own)]
    total = [np.bincount(part, weight, count) for weight in weights]
    means = [
        np.bincount(part, weight * np.where(is_known, thickness, 0.0), count)
        / np.where(area > 0.0, area, 1.0)
        for weight, area in zip(weights, total, strict=True)
    ]
    is_shell = (total[1] > WALL * (total[0] + total[1])) & (means[1] < THICKER * means[0])
    is_shell &= means[1] < THIN * extents(V, part)
    if not is_shell[part].any():
        return limbs
    keep = sp.diags(np.where(is_shell[part], 0.0, 1.0))
    return replace(limbs, shares=sp.csr_matrix(keep @ limbs.shares))
