# SPDX-License-Identifier: GPL-3.0-or-later
"""Links that keep small parts from swinging on a hinge.

A blade of grass is linked to its lawn at its root, a leaf to its twig at a corner. Links as short
as these hold a point or a line, about which the part could turn at no cost: it would lie down on
the lawn, and the iteration would not end before the last one had. So the far end of such a part is
linked to where it hangs, too: it turns as that does.
"""

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components, dijkstra

from ..algebra import dot
from .links import links_to_triangles, no_links

SMALL = 0.1
"""extent of a part that is held; larger ones keep their rotation, see `upright_parts.py`"""
HINGE = 0.1
"""width of what is linked of a part, relative to its extent: with more, it cannot swing"""


def arms(V, areas, part, sizes, joints):
    """Return the Links of parts that hang on others by a point or a line.

    Of two, the one hangs that has more parts between it and the largest one, or else the smaller.

    Parameters
    ----------
    V : (n,3) float array
        Rest positions in the unit box.
    areas : (n,) float array
    part : (n,) int array
    sizes : (p,) array
        Extents of the parts.
    joints : (i, corners, barycentric)
        The vertices i (k,), and the triangles (k,3) with the points on them, that are linked.
    """
    i, corners, barycentric = joints
    if not len(i):
        return no_links()
    points = np.einsum("kc,kcx->kx", barycentric, V[corners])
    one, other = part[i], part[corners[:, 0]]
    rank = _rank(one, other, sizes)
    is_vertex = rank[one] > rank[other]
    hanging = np.where(is_vertex, one, other)
    is_held, middles = _hinges(hanging, np.where(is_vertex[:, None], V[i], points), sizes)
    distance = np.linalg.norm(points - V[i], axis=1)
    order = np.lexsort((distance, hanging))
    order = order[np.append(True, np.diff(hanging[order]) > 0)]  # the nearest joint of each part
    order = order[is_held[hanging[order]]]
    if not len(order):
        return no_links()
    to = np.where(is_vertex[order, None], corners[order], i[order, None])
    shares = np.where(is_vertex[order, None], barycentric[order], [1.0, 0.0, 0.0])
    hanging, far = hanging[order], _far_ends(V, part, is_held, middles)
    total = np.bincount(part, areas)
    found = no_links()
    for ends in far:
        end = ends[hanging]
        d = np.einsum("kc,kcx->kx", shares, V[to]) - V[end]
        weights = 0.5 * total[hanging] / np.maximum(dot(*d.T, *d.T), total[hanging] + 1e-12)
        found = found.joined(links_to_triangles(end, to, shares, weights))
    return found


def _rank(one, other, sizes):
    """Return the order (p,) of parts, of which some (k,) are linked to others (k,)."""
    count = len(sizes)
    graph = sp.csr_matrix((np.ones(len(one)), (one, other)), shape=(count, count))
    _, component = connected_components(graph, directed=False)
    by_size = np.argsort(-sizes, kind="stable")
    roots = by_size[np.unique(component[by_size], return_index=True)[1]]
    steps = dijkstra(graph, directed=False, indices=roots, unweighted=True, min_only=True)
    rank = np.empty(count, np.intp)
    rank[by_size[np.argsort(steps[by_size], kind="stable")]] = np.arange(count)
    return rank


def _hinges(hanging, places, sizes):
    """Return which parts (p,) hang by a point or a line, and the middle (p,3) of it."""
    count = np.bincount(hanging, minlength=len(sizes))
    share = 1.0 / np.maximum(count, 1)
    middles = np.stack([share * np.bincount(hanging, x, len(sizes)) for x in places.T], axis=1)
    d = places - middles[hanging]
    moments = [share * np.bincount(hanging, x * y, len(sizes)) for x in d.T for y in d.T]
    spread = np.linalg.eigvalsh(np.stack(moments, axis=1).reshape(-1, 3, 3))[:, 1]
    is_held = (count > 0) & (sizes < SMALL)
    return is_held & (spread < (HINGE * sizes) ** 2), middles


def _far_ends(V, part, is_held, middles):
    """Return two vertices (2,p) of each part that is held, off its hinge and off each other."""
    rows = np.flatnonzero(is_held[part])
    of_row, d = part[rows], V[rows] - middles[part[rows]]
    ends = np.zeros((2, len(middles)), np.intp)
    ends[0] = _farthest(rows, of_row, dot(*d.T, *d.T), len(middles))
    axis = V[ends[0]] - middles
    axis /= np.maximum(np.linalg.norm(axis, axis=1), 1e-300)[:, None]
    beside = d - (d * axis[of_row]).sum(axis=1)[:, None] * axis[of_row]
    ends[1] = _farthest(rows, of_row, dot(*beside.T, *beside.T), len(middles))
    return ends


def _farthest(rows, of_row, squared, count):
    """Return the row (count,) of each part that is farthest."""
    last = np.zeros(count, np.intp)
    order = np.argsort(squared, kind="stable")
    last[of_row[order]] = rows[order]  # of several, the last one stays
    return last
