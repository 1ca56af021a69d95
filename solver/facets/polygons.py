# SPDX-License-Identifier: GPL-3.0-or-later
"""Planar polygons that fill loops of vertices.

A loop that is planar is a polygon as it is. Others, and those with holes, are cut into triangles,
of which neighbors become one again where they are planar together.
"""

import numpy as np

MOST_CORNERS = 64
_TRIED = 200  # bridges to a hole


def filled(P, loops, normal, flatness):
    """Return polygons, lists of vertices, that fill a part of a surface.

    `P`: (n,3), positions. `loops`: list of lists of int, the vertices around the part, and around
    its holes. `normal`: (3,), that the part faces. `flatness`: float, how far the corners of a
    polygon may be from a plane.
    """
    if len(loops) == 1 and is_polygon(P, loops[0], flatness, normal):
        return loops
    vertices = np.unique(np.concatenate(loops))
    heights = P[vertices] @ normal
    is_off = np.abs(heights - np.median(heights)) > flatness
    at = _plane_coordinates(P, loops, normal)
    return _merged(P, _triangles(at, loops, vertices[is_off]), flatness, normal)


def edges_of(loop):
    """Return pairs of the vertices of a loop, each with the next."""
    return list(zip(loop, [*loop[1:], loop[0]], strict=True))


def beside(loop, v):
    """Return the vertices of a loop before and after one of them."""
    at = loop.index(v)
    return loop[at - 1], loop[(at + 1) % len(loop)]


def normal_of(P, loop):
    """Return the normal of a loop, of the length of twice its area."""
    X = P[loop] - P[loop[0]]
    return np.cross(X, np.roll(X, -1, axis=0)).sum(axis=0)


def is_polygon(P, loop, flatness, normal):
    """Return whether a loop has each vertex once, few of them, in a plane that faces the normal."""
    if not 3 <= len(loop) <= MOST_CORNERS or len(set(loop)) < len(loop):
        return False
    own = normal_of(P, loop)
    size = np.linalg.norm(own)
    if not size > 0.0 or own @ normal <= 0.0:
        return False
    return float(np.ptp(P[loop] @ (own / size))) <= 2.0 * flatness


def crossings(P, loops, normal):
    """Return pairs of edges that meet, seen along the normal, and have no corner in common."""
    turn = np.linalg.svd(normal[None])[2][1:]
    edges = np.array([edge for loop in loops for edge in edges_of(loop)])
    A, B = (P[edges[:, k]] @ turn.T for k in (0, 1))
    ways = _side(A[:, None], B[:, None], A) * _side(A[:, None], B[:, None], B)
    is_met = (ways <= 0.0) & (ways <= 0.0).T
    is_met &= (edges[:, None, :, None] != edges[None, :, None, :]).all(axis=(2, 3))
    return edges[np.argwhere(np.triu(is_met))].tolist()


def _plane_coordinates(P, loops, normal):
    axis = np.eye(3)[np.abs(normal).argmin()]
    x = np.cross(axis, normal)
    x /= np.linalg.norm(x)
    y = np.cross(normal, x)
    return {v: np.array([P[v] @ x, P[v] @ y]) for loop in loops for v in loop}


def _area(X):
    following = np.roll(X, -1, axis=0)
    return float((X[:, 0] * following[:, 1] - X[:, 1] * following[:, 0]).sum())


def _triangles(at, loops, off=()):
    """Cut a loop, bridged to its holes, into triangles by its ears.

    Corners off the plane are cut off first, so that the rest can be one polygon.
    """
    loops = sorted(loops, key=lambda loop: -_area(np.array([at[v] for v in loop])))
    outer, holes = list(loops[0]), loops[1:]
    while holes:
        hole = min(holes, key=lambda h: _gaps(at, outer, h).min())
        holes.remove(hole)
        outer = _bridged(at, outer, hole, holes)
    found = []
    while len(outer) > 3:
        k = _best_ear(np.array([at[v] for v in outer]), np.array(outer), off)
        found.append([outer[k - 1], outer[k], outer[(k + 1) % len(outer)]])
        del outer[k]
    found.append(outer)
    return [t for t in found if len(set(t)) == 3]


def _gaps(at, one, other):
    A, B = (np.array([at[v] for v in loop]) for loop in (one, other))
    return np.linalg.norm(A[:, None] - B, axis=2)


def _bridged(at, outer, hole, others):
    """Return the loop that goes from the outer one to the hole, around it, and back."""
    gaps = _gaps(at, outer, hole)
    order = np.argsort(gaps, axis=None, kind="stable")[:_TRIED]
    segments = [(loop[k - 1], loop[k]) for loop in (outer, hole, *others) for k in range(len(loop))]
    A, B = (np.array([at[s[k]] for s in segments]) for k in (0, 1))
    ends = np.array(segments)
    i, j = divmod(int(order[0]), len(hole))
    for number in order.tolist():
        a, b = divmod(number, len(hole))
        p, q = at[outer[a]], at[hole[b]]
        is_other = ~np.isin(ends, (outer[a], hole[b])).any(axis=1)
        is_crossed = (_side(p, q, A) * _side(p, q, B) <= 0) & (_side(A, B, p) * _side(A, B, q) <= 0)
        if not (is_crossed & is_other).any():
            i, j = a, b
            break
    around = [*hole[j:], *hole[:j]]
    if hole[j] == outer[i]:  # they touch
        return [*outer[:i], *around, *outer[i:]]
    return [*outer[: i + 1], *around, hole[j], *outer[i:]]


def _side(a, b, c):
    u, v = b - a, c - a
    return u[..., 0] * v[..., 1] - u[..., 1] * v[..., 0]


def _best_ear(X, vertex, off):
    """Return the corner of a loop that is best cut off: the least narrow without others inside."""
    A, C = np.roll(X, 1, axis=0), np.roll(X, -1, axis=0)
    area = _side(A, X, C)
    longest = np.max([((p - q) ** 2).sum(axis=1) for p, q in ((A, X), (X, C), (C, A))], axis=0)
    quality = area / np.where(longest > 0.0, longest, 1.0)
    inside = np.ones((len(X), len(X)), bool)
    for p, q in ((A, X), (X, C), (C, A)):
        inside &= _side(p[:, None], q[:, None], X[None]) >= 0.0
    for own in (np.roll(vertex, 1), vertex, np.roll(vertex, -1)):
        inside &= own[:, None] != vertex
    is_ear = ~inside.any(axis=1) & (quality > 0.0)
    quality = quality + 10.0 * np.isin(vertex, off)
    return int(np.where(is_ear, quality, quality - 20.0).argmax())


def _merged(P, polygons, flatness, normal):
    polygons = dict(enumerate(polygons))
    is_changed = True
    while is_changed:
        is_changed = False
        owner = {edge: k for k, loop in polygons.items() for edge in edges_of(loop)}
        pairs = {
            (min(k, o), max(k, o))
            for (a, b), k in owner.items()
            if (o := owner.get((b, a), k)) != k
        }
        for one, other in sorted(pairs):
            if one not in polygons or other not in polygons:
                continue
            loop = _joined(polygons[one], polygons[other])
            if loop and is_polygon(P, loop, flatness, normal):
                polygons[one] = loop
                del polygons[other]
                is_changed = True
    return list(polygons.values())


def _joined(one, other):
    """Return the loop around two neighbors, or None if it is not a single one."""
    edges = set(edges_of(one)) | set(edges_of(other))
    outer = [(a, b) for a, b in edges if (b, a) not in edges]
    follows = dict(outer)
    if not outer or len(follows) < len(outer):
        return None
    start = min(follows)
    loop = [start]
    while (v := follows.get(loop[-1])) is not None and v != start and len(loop) < len(outer):
        loop.append(v)
    return loop if len(loop) == len(outer) else None
