# SPDX-License-Identifier: GPL-3.0-or-later
"""Links across the outside of a part, so that a helmet stays as wide as the head in it.

They lead from wall to wall as those of `thickness.py` do, by balls on the other side: outside of a
part that encloses a volume, on either side of an open sheet. What a ball lies in is a cavity if the
part is seen from the middle of the link in nearly all directions. Between two legs, or beneath a
chin, it is not; nor do a mouth or an armpit count, which are a small share of their part.

Those are gaps. One that narrows to a crease, as around a neck, is linked less firmly, beside a part
that encloses a volume. Else a head sinks onto its body as soon as the skin on both sides of the
neck faces up and down, and swallows the chin. Fingers side by side are not linked to each other:
handles spread them.
"""

import numpy as np

from .links import links_between
from .nearest import Nearest
from .thickness import FACING, STRENGTH, facing, facing_pairs

ENCLOSED = 0.7
"""least share of directions in which the part is seen"""
LEAST_AREA = 0.05
"""of the part, from which links lead..."""
SLANTED, AREA_OF_SLANTED = 0.7, 0.15
"""...or, where walls are not parallel, as in a boat, the least cosine between links and normals,
and the area: beneath a chin and between legs, there is less. Not in a sheet with several openings:
the rims of a lampshade would bow"""
OF_STRENGTH = 1.5
"""of the links inside: nothing else holds a cavity open"""
LEAST_FACING = 0.5
"""cosine between a link across a gap and the normals at its ends; of a neck, all are aslant"""
NEAR = 0.5
"""how far the bottom of a gap may be from where its sides would meet, in lengths of the link"""
SAMPLES = 2000
"""approximate number of vertices to start from, and of points of each part that are looked for"""

LEAST_OPENING = 0.1
"""of the sum of the normals; between parallel sides, it is 0"""

_CELLS = 3  # along the edges of a cube, whose cells are the directions
_AT_ONCE = 100


def links_outside(triangles, normals, areas, part, outward):
    """Return links of solidity 1 across cavities, and others across gaps.

    `triangles`: Triangles. `normals`: (n,3), unit normals, or zero. `areas`: (n,). `part`: (n,)
    int, connected part of each vertex. `outward`: (n,), its `outward_sign`.
    """
    V, is_open = triangles.V, outward == 0.0
    sides = [np.where(is_open, 1.0, -outward), np.where(is_open, -1.0, 0.0)]
    is_tube = is_open & (_openings(triangles.edges, part)[part] > 1)
    cavities, gaps = [], []
    for side in sides:
        away = side[:, None] * normals
        found = facing_pairs(V, away, areas, part, SAMPLES, 3 * SAMPLES, LEAST_FACING)
        i, j, weights = found
        is_cavity = _are_cavities(V, away, areas, part, is_tube, *found)
        is_gap = ~is_cavity & ~is_open[i]
        is_gap[is_gap] = _narrow(V, away, i[is_gap], j[is_gap])
        cavities.append((i[is_cavity], j[is_cavity], OF_STRENGTH * weights[is_cavity]))
        gaps.append((i[is_gap], j[is_gap], weights[is_gap]))
    return _joined(cavities), _joined(gaps)


def _joined(pairs):
    return links_between(*(np.concatenate(values) for values in zip(*pairs, strict=True)))


def _openings(edges, part):
    """Return how many open rims each part has."""
    vertices, rim = edges.rims
    _, first = np.unique(rim, return_index=True)
    return np.bincount(part[vertices[first]], minlength=int(part.max(initial=-1)) + 1)


def _narrow(V, normals, i, j):
    """Return which gaps i, j (k,), with inward normals, narrow to a crease."""
    middle, chord = (V[i] + V[j]) / 2.0, np.linalg.norm(V[j] - V[i], axis=1)
    outward = -(normals[i] + normals[j])
    length = np.maximum(np.linalg.norm(outward, axis=1), LEAST_OPENING)
    outward /= length[:, None]
    depth = chord * facing(V, normals, i, j) / length
    expected = middle - depth[:, None] * outward
    found = Nearest(V)(expected)
    is_near = np.linalg.norm(V[found] - expected, axis=1) < NEAR * chord
    return is_near & (-(normals[found] * outward).sum(axis=1) > LEAST_FACING)


def _are_cavities(V, normals, areas, part, is_tube, i, j, weights):
    """Return which pairs i, j (k,) with weights (k,) lead across a cavity."""
    are_cavities = np.zeros(len(i), dtype=bool)
    rows = np.flatnonzero(facing(V, normals, i, j) > np.where(is_tube[i], FACING, SLANTED))
    i, j, weights = i[rows], j[rows], weights[rows]
    is_kept = _enclosed((V[i] + V[j]) / 2.0, part[i], V, part) > ENCLOSED
    rows, i, j, weights = rows[is_kept], i[is_kept], j[is_kept], weights[is_kept]
    # a link of this weight stands for so much area, see `facing_pairs`
    area = weights / STRENGTH * ((V[j] - V[i]) ** 2).sum(axis=1)
    total, is_parallel = np.bincount(part, areas), facing(V, normals, i, j) > FACING
    parallel, all_of_them = (
        np.bincount(part[i], x * area, len(total)) for x in (is_parallel, np.ones(len(i)))
    )
    is_cavity = parallel > LEAST_AREA * total
    is_slanted = ~is_cavity & (all_of_them > AREA_OF_SLANTED * total)
    are_cavities[rows[is_cavity[part[i]] & is_parallel | is_slanted[part[i]]]] = True
    return are_cavities


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
