# SPDX-License-Identifier: GPL-3.0-or-later
"""Corners that polygons can do without.

Those are corners beside each other that have no room apart, corners on the straight line between
two others, and those of a border within a plane. All polygons around lose them alike, so no gap
opens.
"""

import numpy as np

from .polygons import beside, crossings, edges_of, is_polygon, normal_of

SHORT = 0.004
"""of the size: shorter edges go"""
FAR = 0.06
"""of the size: corners that are farther apart are never joined"""
LEAST_AREA = 4e-4
"""of the size squared: triangles that are larger do not go with an edge of theirs"""


def joined(W, loops, pairs):
    """Return loops in which pairs of corners beside each other are one, where that can be.

    `W`: (n,3), where vertices were. `loops`: as of `Outlines`. `pairs`: those that come first are
    the first to be joined. Returns the loops, new ones, and whether they are others.
    """
    loops, around = _copied(loops)
    done = set()
    for kept, gone in pairs:
        if done & {kept, gone} or np.linalg.norm(W[kept] - W[gone]) > FAR:
            continue
        made = {part: _replaced(loops[part], kept, gone) for part in around[gone]}
        if any(not of and not _is_small(W, loops[part]) for part, of in made.items()):
            continue
        near = {part: loops[part] for part in around[kept]} | made
        edges = [e for of in near.values() for loop in of for e in edges_of(loop) if kept in e]
        if len(set(edges)) < len(edges):
            continue
        done |= {kept, gone}
        for part, of in made.items():
            for v in {v for loop in loops[part] for v in loop}:
                around[v].discard(part)
            for v in {v for loop in of for v in loop}:
                around[v].add(part)
            loops[part] = of
    return {part: of for part, of in loops.items() if of}, bool(done)


def crowded(W, P, loops):
    """Return pairs of corners whose edge is next to nothing or points back: these the first.

    That is what is left of an edge between corners that both have gone to where planes meet.

    `W`, `P`: (n,3), where vertices were, and where corners go. `loops`: as of `Outlines`.
    """
    edges = {(a, b) for of in loops.values() for loop in of for a, b in edges_of(loop)}
    one, other = np.array(sorted({(min(e), max(e)) for e in edges})).reshape(-1, 2).T
    before, after = W[other] - W[one], P[other] - P[one]
    length = np.linalg.norm(before, axis=1)
    forward = np.einsum("kj,kj->k", before, after) / np.where(length > 0.0, length, 1.0)
    order = np.argsort(forward, kind="stable")
    order = order[forward[order] < SHORT]
    return np.stack([one[order], other[order]], axis=1).tolist()


def tangled(P, loops, normals):
    """Return pairs of corners beside each other, on the way between edges that cross each other.

    `P`: (n,3), where corners go. `loops`: as of `Outlines`. `normals`: (k,3), of the parts.
    """
    found = []
    for part, of in loops.items():
        near = {}
        for loop in of:
            for v in loop:
                near.setdefault(v, set()).update(beside(loop, v))
        for one, other in crossings(P, of, normals[part]):
            pairs = [(a, b) for a in one for b in other if b in near[a]]
            found += pairs or [(a, v) for a in one for v in near[a] if near[v] & {*other}]
    return found


def without_needless(P, loops, off):
    """Return loops without the corners of two parts that lie on the line between their neighbors.

    `P`: (n,3), where corners go. `loops`: as of `Outlines`. `off`: float, how far from the line.
    Returns the loops, new ones, and whether they are others.
    """
    loops, around = _copied(loops)
    edges = {edge for of in loops.values() for loop in of for edge in edges_of(loop)}
    is_changed = False
    for v in sorted(around):
        pair = [loop for part in around[v] for loop in loops[part] if v in loop]
        if len(pair) != 2 or min(map(len, pair)) < 4:
            continue
        (a, b), others = (beside(loop, v) for loop in pair)
        if others != (b, a) or edges & {(a, b), (b, a)}:
            continue
        along, away = P[b] - P[a], P[v] - P[a]
        if np.linalg.norm(np.cross(along, away)) > off * np.linalg.norm(along):
            continue
        for loop in pair:
            loop.remove(v)
        edges |= {(a, b), (b, a)}
        is_changed = True
    return loops, is_changed


def straightened(P, polygons, chart_of, flatness):
    """Return polygons without the corners that only two of them have, and their numbers (k,).

    Parts that are not planar are cut into polygons, some of which then lie in the plane of a
    neighbor from another part. Where such two have more than one edge in common, the border between
    them takes a turn that nothing in the shape asks for.

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


def _copied(loops):
    around = {}
    for part, of in loops.items():
        for loop in of:
            for v in loop:
                around.setdefault(v, set()).add(part)
    return {part: [list(loop) for loop in of] for part, of in loops.items()}, around


def _replaced(loops, kept, gone):
    made = []
    for loop in loops:
        new = [kept if v == gone else v for v in loop]
        new = [v for k, v in enumerate(new) if v != new[k - 1]]
        at = [k for k, v in enumerate(new) if v == kept]
        if len(at) == 2:  # it touches itself, and is two
            made += [new[at[0] : at[1]], new[at[1] :] + new[: at[0]]]
        else:
            made.append(new)
    return [loop for loop in made if len(loop) > 2]


def _is_small(W, loops):
    return sum(np.linalg.norm(normal_of(W, loop)) for loop in loops) < 2.0 * LEAST_AREA


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
