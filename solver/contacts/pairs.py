# SPDX-License-Identifier: GPL-3.0-or-later
"""Which vertices are linked so that surfaces no longer cross.

From the triangles that newly cross, the search spreads over the surface as long as gaps are closed:
a gap d at rest, which has become d~, is closed if d~ is shorter than a share of d along R d.
Vertices beside such gaps are linked across them. Triangles that cross are also linked themselves,
along what is nearest between them at rest (`features.py`): where two sheets almost touch, it is not
enough to keep their vertices apart.
"""

import numpy as np

from ..proxy.links import Links, links_between
from .features import features
from .gaps import REACH, grown

STRENGTH = 2.0
"""of a link, in areas per squared distance"""
CLOSED = 0.5
"""share of a gap below which it is closed"""
STRONGER = 4.0
"""factor for a link that has not prevented a crossing"""

_RINGS = 2  # of vertices around those of crossing triangles, and around closed gaps
_SPREADS = 20
_NEAREST = 1.5  # times the least distance of two triangles: what else is linked between them
_LEAST_GAP = 1e-6  # of less, the direction is rounding
_LEAST_SHARE = 0.1  # of the length of edges: gaps of less are as strong as these


def links_against(rest, gaps, shown, pairs, U, R, is_wide):
    """Return links across the gaps that are closed around pairs of triangles that cross.

    `rest`: RestMesh. `gaps`: Gaps, of its surface. `shown`: (m,3) int, the triangles that `pairs`
    counts. `pairs`: (k,2) int, triangles that newly cross. `U`: (n,3), positions. `R`: (n,3,3),
    rotations. `is_wide`: bool, whether also to link narrow gaps beside those that are closed.
    """
    i, j = _closed_gaps(rest, gaps, _inside(rest, shown[pairs.ravel()]), U, R, is_wide)
    across = links_between(i, j, _weights(rest.areas[i], rest.V[j] - rest.V[i]))
    return across.joined(_links_between(rest, shown, pairs, U, R))


def _inside(rest, triangles):
    """Return a mask (n,) of the corners of shown triangles, and of what lies between them."""
    used, place = rest.place
    is_corner = np.zeros(len(rest.V), dtype=bool)
    is_corner[triangles.ravel()] = True
    of_input = np.zeros(len(rest.input_positions), dtype=bool)
    of_input[used] = is_corner[place]
    return rest.input_map.spread_mask(of_input)


def _closed_gaps(rest, gaps, region, U, R, is_wide):
    """Return pairs i, j (k,) of vertices across closed gaps, spread from a mask (n,).

    Widely, with them go the gaps beside that are narrower than any of these has been closed by:
    where one finger has gone through another, the rest of both would follow in the next round.
    Between parts, the search does not spread from these: all leaves of a crown are beside others.
    """
    found_i, found_j, deepest = [], [], 0.0
    part = rest.topology.part
    is_new, is_done = grown(gaps.graph, region, _RINGS), np.zeros(len(region), dtype=bool)
    for _ in range(_SPREADS):
        i, j = gaps.partners(np.flatnonzero(is_new))
        width = np.linalg.norm(rest.V[j] - rest.V[i], axis=1)
        openness = _openness(rest.V, U, R, i, j)
        is_linked = is_closed = openness < CLOSED
        if is_wide:
            deepest = max(deepest, ((1.0 - openness) * width)[is_closed].max(initial=0.0))
            is_linked = is_closed | (width < deepest)
        found_i.append(i[is_linked])
        found_j.append(j[is_linked])
        is_done |= is_new
        spreads = is_closed | (is_linked & (part[i] == part[j]))
        beside = np.zeros(len(region), dtype=bool)
        beside[i[spreads]] = beside[j[spreads]] = True
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


def _weights(area, d):
    return STRENGTH * area / np.maximum((d * d).sum(axis=1), _LEAST_SHARE**2 * area + 1e-12)


def _links_between(rest, shown, pairs, U, R):
    """Return links along what is nearest between triangles that cross, where it is closed."""
    A, B = (shown[triangles].astype(np.int64) for triangles in pairs.T)
    vertices, c = features(rest.V, A, B)
    d = np.einsum("kfc,kfcx->kfx", c, rest.V[vertices])
    distance = np.linalg.norm(d, axis=2)
    turned = np.einsum("kfc,kfcab,kfb->kfa", np.abs(c), R[vertices], d)
    now = (np.einsum("kfc,kfcx->kfx", c, U[vertices]) * turned).sum(axis=2)
    is_closed = now < CLOSED * distance * np.linalg.norm(turned, axis=2)
    is_closed &= (distance > _LEAST_GAP) & (distance < REACH)
    nearest = np.where(is_closed, distance, np.inf).min(axis=1, keepdims=True)
    is_linked = is_closed & (distance <= _NEAREST * nearest)
    vertices, c, d = vertices[is_linked], c[is_linked], d[is_linked]
    share = 0.5 * np.abs(c)
    weights = _weights((share * rest.areas[vertices]).sum(axis=1), d)
    return Links(vertices, c, weights[:, None] * share)


def merged(links, more):
    """Return links with others; what is in both becomes stronger."""
    both = links.joined(more)
    _, first, place = np.unique(_keys(both), axis=0, return_index=True, return_inverse=True)
    place = place.ravel()
    is_again = np.zeros((2, len(first)), dtype=bool)
    is_again[0, place[: len(links)]] = is_again[1, place[len(links) :]] = True
    weights = both.weights[first] * np.where(is_again.all(axis=0), STRONGER, 1.0)[:, None]
    return Links(both.vertices[first], both.coefficients[first], weights)


def mirrored(links, mirrors):
    """Return links with the mirror images of those that have one."""
    for mirror in mirrors:
        image = mirror.partner[links.vertices]
        chosen = (image >= 0).all(axis=1)
        images = (image[chosen], links.coefficients[chosen], links.weights[chosen])
        both = links.joined(Links(*images))
        first = np.sort(np.unique(_keys(both), axis=0, return_index=True)[1])
        links = Links(both.vertices[first], both.coefficients[first], both.weights[first])
    return links


def _keys(links):
    """Return (k,5) ints that are the same for links between the same vertices."""
    from_edges = links.coefficients[:, 1] < 0.0
    return np.column_stack([links.vertices, from_edges])
