# SPDX-License-Identifier: GPL-3.0-or-later
"""Straight borders between two polygons that lie in one plane.

Parts that are not planar are cut into polygons, some of which then lie in the plane of a neighbor
from another part. Where such two have more than one edge in common, the border between them takes a
turn that nothing in the shape asks for: corners between them go.
"""

from .polygons import beside, crossings, edges_of, is_polygon, normal_of


def straightened(P, polygons, chart_of, flatness):
    """Return polygons without the corners that only two of them have, and their numbers (k,).

    `P`: (n,3), positions. `polygons`: list of lists of int, planar, counterclockwise. `chart_of`:
    sequence of int, corners between polygons of two charts stay. `flatness`: float, how far the
    corners of a polygon may be from a plane.
    """
    loops = dict(enumerate(map(list, polygons)))
    owner = {edge: k for k, loop in loops.items() for edge in edges_of(loop)}
    around = {}
    for k, loop in loops.items():
        for v in loop:
            around.setdefault(v, []).append(k)
    open_ones = sorted(around)
    while open_ones:
        again = set()
        for v in open_ones:
            pair = around.get(v, ())
            if len(pair) != 2 or chart_of[pair[0]] != chart_of[pair[1]]:
                continue
            made = _without(P, loops, owner, v, pair, flatness)
            if made is None:
                continue
            del around[v]
            for k, loop in zip(pair, made, strict=True):
                again.update(loop)
                for edge in edges_of(loops.pop(k)):
                    owner.pop(edge, None)
                if len(loop) < 3:
                    for other in loop:
                        around[other].remove(k)
                else:
                    loops[k] = loop
            owner.update({e: k for k in pair if k in loops for e in edges_of(loops[k])})
        open_ones = sorted(again & around.keys())
    kept = sorted(loops)
    return [loops[k] for k in kept], kept


def _without(P, loops, owner, v, pair, flatness):
    """Return both polygons (2 lists) without a corner that they share, None if it has to stay."""
    one, other = (beside(loops[k], v) for k in pair)
    if one != other[::-1]:
        return None
    found = [[x for x in loops[k] if x != v] for k in pair]
    if max(map(len, found)) < 3:
        return None
    for (a, b), loop, k in zip((one, other), found, pair, strict=True):
        if len(loop) >= 3:
            normal = normal_of(P, loops[k])
            if not is_polygon(P, loop, flatness, normal) or crossings(P, [loop], normal):
                return None
            if owner.get((a, b), k) not in pair:
                return None
    return found
