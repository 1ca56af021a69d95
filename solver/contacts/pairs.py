# SPDX-License-Identifier: GPL-3.0-or-later
"""Which vertices are linked so that surfaces no longer cross.

From the triangles that newly cross, the search spreads over the surface as long as gaps are closed:
a gap d at rest, which has become d~, is closed if d~ is shorter than a share of d along R d. Vertices
beside such gaps are linked across them. Where triangles cross that had no gap between them, as
where a surface has slid to another, their corners are linked to the nearest points that they had at
rest on the other triangle.
"""

import numpy as np

from ..proxy.closest_point import closest_points
from ..proxy.links import links_between, links_to_triangles, no_links
from .gaps import REACH, are_near, grown

STRENGTH = 2.0
"""of a link, in areas per squared distance"""
CLOSED = 0.35
"""share of a gap below which it is closed"""
STRONGER = 4.0
"""factor for a link that has not prevented a crossing"""

_RINGS = 2  # of vertices around those of crossing triangles, and around closed gaps
_SPREADS = 20
_LEAST_SHARE = 0.1  # of the length of edges: gaps of less are as strong as these


def links_against(rest, gaps, shown, pairs, U, R):
    """Return links across the gaps that are closed around pairs of triangles that cross.

    Parameters
    ----------
    rest : RestMesh
    gaps : Gaps
        Of its surface.
    shown : (m,3) int array
        The triangles that `pairs` counts.
    pairs : (k,2) int array
        Triangles that newly cross.
    U : (n,3) float array
        Positions.
    R : (n,3,3) array
        Rotations.
    """
    i, j = _closed_gaps(rest, gaps, _inside(rest, shown[pairs.ravel()]), U, R)
    across = links_between(i, j, _weights(rest, i, rest.V[j] - rest.V[i]))
    is_linked = np.zeros(len(rest.V), dtype=bool)
    is_linked[i] = is_linked[j] = True
    return across.joined(_links_of_corners(rest, gaps, shown, pairs, is_linked))


def _inside(rest, triangles):
    """Return a mask (n,) of the corners of shown triangles, and of what lies between them."""
    used, place = rest.place
    is_corner = np.zeros(len(rest.V), dtype=bool)
    is_corner[triangles.ravel()] = True
    of_input = np.zeros(len(rest.input_positions), dtype=bool)
    of_input[used] = is_corner[place]
    return rest.input_map.spread_mask(of_input)


def _closed_gaps(rest, gaps, region, U, R):
    """Return pairs i, j (k,) of vertices across closed gaps, spread from a mask (n,)."""
    found_i, found_j = [], []
    is_new, is_done = grown(gaps.graph, region, _RINGS), np.zeros(len(region), dtype=bool)
    for _ in range(_SPREADS):
        i, j = gaps.partners(np.flatnonzero(is_new))
        is_closed = _openness(rest.V, U, R, i, j) < CLOSED
        found_i.append(i[is_closed])
        found_j.append(j[is_closed])
        is_done |= is_new
        beside = np.zeros(len(region), dtype=bool)
        beside[found_i[-1]] = beside[found_j[-1]] = True
        is_new = grown(gaps.graph, beside, _RINGS) & ~is_done
        if not is_new.any():
            break
    return np.concatenate(found_i), np.concatenate(found_j)


def _openness(V, U, R, i, j):
    """Return how wide gaps are now, along their turned direction, as a share of that at rest."""
    d = V[j] - V[i]
    turned = np.einsum("kab,kb->ka", R[i] + R[j], d)
    now = ((U[j] - U[i]) * turned).sum(axis=1)
    size = np.linalg.norm(turned, axis=1) * np.linalg.norm(d, axis=1)
    return now / np.maximum(size, 1e-300)


def _weights(rest, i, d):
    """Return the weights (k,) of links from vertices i along d (k,3)."""
    area = rest.areas[i]
    return STRENGTH * area / np.maximum((d * d).sum(axis=1), _LEAST_SHARE**2 * area + 1e-12)


def _links_of_corners(rest, gaps, shown, pairs, is_linked):
    """Return links from corners of crossing triangles, if not linked, to the other triangle."""
    i = np.concatenate([shown[pairs[:, 0]].ravel(), shown[pairs[:, 1]].ravel()])
    other = np.concatenate([np.repeat(pairs[:, 1], 3), np.repeat(pairs[:, 0], 3)])
    is_free = ~is_linked[i]
    i, corners = i[is_free], shown[other[is_free]].astype(np.int64)
    if not len(i):
        return no_links()
    barycentric = closest_points(rest.V[i], *(rest.V[corners[:, k]] for k in range(3)))
    d = np.einsum("kc,kcx->kx", barycentric, rest.V[corners]) - rest.V[i]
    distance = np.linalg.norm(d, axis=1)
    order = np.lexsort((distance, i))
    is_first = np.ones(len(order), dtype=bool)
    is_first[1:] = i[order][1:] != i[order][:-1]
    best = order[is_first]
    best = best[distance[best] < REACH]
    best = best[~are_near(gaps.graph, i[best], corners[best, barycentric[best].argmax(axis=1)])]
    i, corners, barycentric, d = i[best], corners[best], barycentric[best], d[best]
    return links_to_triangles(i, corners, barycentric, _weights(rest, i, d))


def merged(links, more):
    """Return links with others; what is in both becomes stronger."""
    both = links.joined(more)
    _, first, place, count = np.unique(
        both.vertices, axis=0, return_index=True, return_inverse=True, return_counts=True
    )
    place = place.ravel()
    weights = both.weights[first].copy()
    is_old = np.zeros(len(first), dtype=bool)
    is_old[place[: len(links)]] = True
    is_again = np.zeros(len(first), dtype=bool)
    is_again[place[len(links) :]] = True
    weights[is_old & is_again] *= STRONGER
    return type(both)(both.vertices[first], both.coefficients[first], weights)


def mirrored(links, mirrors):
    """Return links with the mirror images of those that have one."""
    for mirror in mirrors:
        image = mirror.partner[links.vertices]
        has_one = (image >= 0).all(axis=1)
        images = type(links)(image, links.coefficients, links.weights)
        chosen = np.flatnonzero(has_one)
        images = type(links)(*(x[chosen] for x in (image, links.coefficients, links.weights)))
        both = links.joined(images)
        _, first = np.unique(both.vertices, axis=0, return_index=True)
        first = np.sort(first)
        links = type(links)(*(x[first] for x in (both.vertices, both.coefficients, both.weights)))
    return links
