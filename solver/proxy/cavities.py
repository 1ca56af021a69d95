# SPDX-License-Identifier: GPL-3.0-or-later
"""Links across cavities, so that a helmet stays as wide as the head in it.

They lead from wall to wall as those of `thickness.py` do, by balls on the other side: outside of a
part that encloses a volume, on either side of an open sheet. What a ball lies in is a cavity if the
part is seen from the middle of the link in nearly all directions. Between two legs, or beneath a
chin, it is not; nor do a mouth or an armpit count, which are a small share of their part.
"""

import numpy as np

from .links import links_between
from .thickness import STRENGTH, facing_pairs, outward_sign

ENCLOSED = 0.7
"""least share of directions in which the part is seen"""
LEAST_AREA = 0.05
"""of the part, from which links lead"""
OF_STRENGTH = 1.5
"""of the links inside: nothing else holds a cavity open"""
SAMPLES = 2000
"""approximate number of vertices to start from, and of points of each part that are looked for"""

_CELLS = 3  # along the edges of a cube, whose cells are the directions
_AT_ONCE = 500


def cavity_links(triangles, normals, areas, part):
    """Return links of solidity 1 across cavities.

    `triangles`: Triangles. `normals`: (n,3), unit normals, or zero. `areas`: (n,). `part`: (n,)
    int, connected part of each vertex.
    """
    V, outward = triangles.V, outward_sign(triangles, part)[part]
    is_open = outward == 0.0
    sides = [np.where(is_open, 1.0, -outward), np.where(is_open, -1.0, 0.0)]
    found = [_across(V, side[:, None] * normals, areas, part) for side in sides]
    i, j, weights = (np.concatenate(values) for values in zip(*found, strict=True))
    return links_between(i, j, weights)


def _across(V, normals, areas, part):
    """Return pairs i, j (k,) and weights (k,) across cavities on the side away from the normals."""
    i, j, weights = facing_pairs(V, normals, areas, part, SAMPLES, 3 * SAMPLES)
    is_kept = _enclosed((V[i] + V[j]) / 2.0, part[i], V, part) > ENCLOSED
    i, j, weights = i[is_kept], j[is_kept], weights[is_kept]
    # a link of this weight stands for so much area, see `facing_pairs`
    area = weights / STRENGTH * ((V[j] - V[i]) ** 2).sum(axis=1)
    total = np.bincount(part, areas)
    is_kept = (np.bincount(part[i], area, len(total)) > LEAST_AREA * total)[part[i]]
    return i[is_kept], j[is_kept], OF_STRENGTH * weights[is_kept]


def _enclosed(places, of, V, part):
    """Return the share (k,) of directions in which the part `of` (k,) is seen from places (k,3)."""
    shares = np.zeros(len(places))
    by_part = np.argsort(part, kind="stable")
    bounds = np.searchsorted(part[by_part], [np.unique(of), np.unique(of) + 1])
    for number, start, end in zip(np.unique(of), *bounds, strict=True):
        points = V[by_part[start:end]]
        points = points[:: -(-len(points) // SAMPLES)]
        rows = np.flatnonzero(of == number)
        for first in range(0, len(rows), _AT_ONCE):
            asked = rows[first : first + _AT_ONCE]
            cell = _directions(points - places[asked, None])
            is_seen = np.zeros((len(asked), 6 * _CELLS**2), dtype=bool)
            is_seen[np.arange(len(asked))[:, None], cell] = True
            shares[asked] = is_seen.mean(axis=1)
    return shares


def _directions(d):
    """Return the number (...) of the cell, on a cube around the origin, of vectors (...,3)."""
    axis = np.abs(d).argmax(axis=-1)
    along, *beside = (
        np.take_along_axis(d, ((axis + k) % 3)[..., None], axis=-1)[..., 0] for k in range(3)
    )
    cell = 2 * axis + (along > 0.0)
    for x in beside:
        angle = np.arctan2(x, np.abs(along)) * (2.0 / np.pi) + 0.5  # 0 to 1
        cell = _CELLS * cell + np.minimum((_CELLS * angle).astype(np.int64), _CELLS - 1)
    return cell
