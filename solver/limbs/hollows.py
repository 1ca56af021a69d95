# SPDX-License-Identifier: GPL-3.0-or-later
"""Limbs of hollow parts, such as the sleeves of a jacket with nothing in them.

Between the two sides of its cloth, a sleeve is a sheet. What is slender is the space in it, so the
midpoints that count are those across cavities; the outer side of the wall lies as the inner one.
"""

import numpy as np

from ..proxy.cavities import OF_STRENGTH
from ..proxy.thickness import STRENGTH
from .of_shape import limbs_of_shape

INNER = 0.3
"""least share of a side of a hollow part that faces itself across cavities..."""
SLENDER = 0.5
"""...and that is a limb, in a part whose wall is one: the wire of a spring is no cloth"""


def with_hollows(limbs, V, skin, walls, cavities, part, normals, areas):
    """Return Limbs in which hollow parts have those of their cavities.

    `limbs`: Limbs, as found between the sides of walls. `V`: (n,3), rest positions in the unit box.
    `skin`: SpokesAndRims. `walls`, `cavities`: Links, to the other side, and across cavities, see
    `proxy/cavities.py`. `part`: (n,) int. `normals`: (n,3). `areas`: (n,).
    """
    total = np.bincount(part, areas)
    i, j = cavities.vertices[:, 0], cavities.vertices[:, 1]
    # a link of this weight stands for so much area, see `facing_pairs`
    inner = cavities.weights[:, 0] * ((V[j] - V[i]) ** 2).sum(axis=1) / (OF_STRENGTH * STRENGTH)
    has_two_sides = np.bincount(part[walls.vertices[:, 0]], minlength=len(total)) > 0
    side = np.where(has_two_sides, 0.5, 1.0) * total
    is_hollow = np.bincount(part[i], inner, len(total)) > INNER * side
    own = areas * np.asarray(limbs.shares.sum(axis=1)).ravel()
    is_hollow &= np.bincount(part, own) < SLENDER * total
    if not is_hollow.any():
        return limbs
    inside = cavities.part(is_hollow[part[i]])
    found = limbs_of_shape(V, skin, inside, part, normals, areas, walls)
    return limbs.replaced(is_hollow[part], found)
