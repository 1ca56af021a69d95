# SPDX-License-Identifier: GPL-3.0-or-later
"""Find limbs in the shape itself.

Halfway between a vertex and the opposite side of its part lies a midpoint. Those of a limb lie
along a line, those of a sheet on a surface, and those of a head or a trunk near each other. Near
midpoints of alike thickness are one node, and nodes that meet on the surface are neighbors in a
graph, whose paths lead along a spring and not from one of its turns to the next, nor from finger to
finger. Around each node, in windows on this graph, the nodes are measured: their extent along their
main direction, beside the width of what they are the middle of, says how much of a limb they are.
What tapers, such as a horn, has no midpoints near its tip; there, the vertices say how far it goes.
Neighbors that lie the same way are one straight piece of it, as a bone is; where such a piece bends
a little, as a leg does between thigh and shank, it is cut into short ones.
"""

from typing import NamedTuple

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components, dijkstra

from ..algebra import smoothstep, sums_by_group
from ..aliases import FloatArray, IntArray
from .limbs import Limbs, no_limbs
from .rings import with_rings

CELL = 0.35
"""of the thickness: midpoints in such a cell are one node,..."""
OF_SPACING = 1.0
"""...or of the distance of neighboring links, if that is more"""
STEP = 1.0
"""longest edge of the graph, in thicknesses, or in distances of links if these are farther apart"""
OF_EDGES = 1.5
"""...or than this in edges of the surface: else the rings of a thin wall would not meet"""
ALIKE = 1.7
"""largest ratio of thicknesses along an edge"""
REACH = 1.6
"""of a window to either side, in widths"""
END = 0.5
"""thicknesses by which a limb goes on beyond the last of its midpoints"""
NONE, FULL = 1.6, 2.2
"""lengths, in widths: below is no limb, above is one in full"""
OPEN = 0.75
"""share of the surface that faces one way across a limb which the other way lacks, beyond which it
is none: the flange of a base, which is attached all along"""
STRAIGHT = np.cos(np.radians(20.0))
"""between the directions of one straight piece"""
TAPER = 0.25
"""of the thickness per length: what tapers so goes on to its tip, where no ball has an end"""
FAR = 8.0
"""thicknesses, of the thickest: beyond, distances along the graph are not asked for"""
AROUND = 0.04, 0.1
"""of the squares of the normals across a limb, the least part to the largest: a wall, whose nodes
are on lines by chance, as on its rings of vertices, has less than the first, as they face two ways;
what has more than the second faces all ways around"""
SHORT = 0.8
"""widths: a shorter piece belongs to the next one"""
WIDEST, THIN, SIDES = 0.75, 0.7, 3
"""of a trunk: its width beside the largest of its body, that of limbs beside it, their number"""
CUT = 0.8
"""thicknesses: length of the short pieces of one that bends"""
OF_NODES = 3
"""fewest in a short piece, in the mean: fewer do not say how it bends"""
BEND = np.cos(np.radians(4.0))
"""between the directions of a piece that is straight and of each short one"""
FOOT = 3, np.radians(15.0), 2.0
"""fewest turns of a piece, and the least one at an end that leads to a foot, also in others"""
BLUR = 0.35
"""of the width: how far a piece reaches into the next"""
SMOOTHINGS = 4
"""averages over neighboring vertices"""
TOGETHER = 500
"""nodes that are looked at together, if they are connected or not"""
FEWEST = 6
"""links; of fewer, nothing is found"""

_WAYS = np.array([way for way in np.ndindex(3, 3, 3) if way != (1, 1, 1)]) - 1.0
"""to the corners, edges and sides of a cube"""


class Skeleton(NamedTuple):
    """The nodes, m of them."""

    place: FloatArray
    """(m,3)"""
    thickness: FloatArray
    """(m,) mean distance of both sides"""
    node: IntArray
    """(n,) int of each vertex, -1 where a part has none"""
    graph: sp.csr_matrix
    """(m,m) lengths between neighbors"""
    reach: FloatArray
    """(m,d,3) the vertices of each that are farthest in each of `_WAYS`"""
    facing: FloatArray
    """(m,3) sums of their normals, with their areas"""
    spread: FloatArray
    """(m,3,3) sums of the squares n n' of these"""

    def part(self, nodes):
        """Return the Skeleton of some of the nodes (k,)."""
        graph = self.graph[nodes][:, nodes]
        place, thickness = self.place[nodes], self.thickness[nodes]
        own = (x[nodes] for x in (self.reach, self.facing, self.spread))
        return Skeleton(place, thickness, self.node, graph, *own)


def limbs_of_shape(V, skin, links, part, normals, areas, walls=None):
    """Return the Limbs of a shape.

    `V`: (n,3), rest positions in the unit box. `skin`: SpokesAndRims, of the surface. `links`:
    Links to opposite sides, see `proxy/thickness.py`. `part`: (n,) int. `normals`, `areas`: (n,3)
    and (n,), of the vertices. `walls`: Links, optional, across which it is not far either, if the
    links are those of one side of walls.
    """
    if len(links) < FEWEST:
        return no_limbs(len(V))
    skeleton = skeleton_of(V, skin, links, part, normals, areas, walls)
    entries, directions = [], np.empty((0, 3))
    for nodes in _bodies(skeleton.graph):
        found, of_node = _found_among(skeleton.part(nodes))
        row, number = np.nonzero(of_node)
        entries.append((of_node[row, number], nodes[row], len(directions) + number))
        directions = np.concatenate([directions, found])
    if not len(directions):
        return no_limbs(len(V))
    share, row, number = (np.concatenate(values) for values in zip(*entries, strict=True))
    size = len(skeleton.place) + 1, len(directions)  # the last one is no node
    of_node = sp.csr_matrix((share, (row, number)), shape=size)
    return Limbs(directions, _smoothed(of_node[skeleton.node], skin))


def _bodies(graph):
    """Yield the nodes (k,) of connected parts of the graph, of small ones together.

    Distances between all nodes are asked for: of thousands of rings, only within each.
    """
    _, body = connected_components(graph, directed=False)
    order, begin = np.argsort(body, kind="stable"), 0
    for end in np.cumsum(np.bincount(body)):
        if end - begin >= TOGETHER or end == len(order):
            yield np.sort(order[begin:end])
            begin = end


def _found_among(skeleton):
    """Return the directions (s,3) of the limbs of a Skeleton, and shares (m,s) of its nodes."""
    direction, confidence, width, distance = _measured(skeleton)
    piece, directions = _pieces(skeleton.graph, direction, confidence, width)
    if len(directions):
        piece, directions = _without_short(piece, directions, skeleton, width, distance)
    if len(directions):
        piece, directions = with_rings(piece, directions, skeleton.place, skeleton.graph)
        piece = _without_trunks(piece, len(directions), skeleton.graph, width)
        piece, directions = _cut(piece, directions, skeleton, confidence)
    shares = np.zeros((len(piece), len(directions)))
    if not len(directions):
        return directions, shares
    is_limb = piece >= 0
    shares[is_limb, piece[is_limb]] = confidence[is_limb]
    kernel = np.exp(-((distance / (BLUR * width[:, None])) ** 2))
    shares = kernel @ shares / kernel.sum(axis=1)[:, None]
    shares[shares < 0.01] = 0.0
    return directions, shares


def skeleton_of(V, skin, links, part, normals, areas, walls=None):
    """Return the Skeleton of links to opposite sides."""
    i, j = links.vertices[:, 0], links.vertices[:, 1]
    middle, t = 0.5 * (V[i] + V[j]), np.linalg.norm(V[i] - V[j], axis=1)
    row = np.repeat(np.arange(len(V), dtype=np.int32), np.diff(skin.indptr))
    lengths = np.linalg.norm(V[row] - V[skin.indices], axis=1) + 1e-9
    mesh = sp.csr_matrix((lengths, skin.indices, skin.indptr), shape=(len(V), len(V)))
    if walls is not None:
        mesh = mesh + _lengths(V, walls)
    ends, first = np.unique(np.concatenate([i, j]), return_index=True)
    away, _, source = dijkstra(mesh, indices=ends, min_only=True, return_predecessors=True)
    spacing = 2.0 * np.median(away[np.isfinite(away)])

    octave = np.floor(2.0 * np.log2(np.maximum(t, 1e-6))).astype(np.int64)
    size = np.maximum(CELL * 2.0 ** (0.5 * octave), OF_SPACING * spacing)
    cell = np.floor(middle / size[:, None]).astype(np.int64)
    keys = np.column_stack([part[i], octave, cell])
    _, of_link = np.unique(keys, axis=0, return_inverse=True)
    of_link = of_link.ravel()
    count = np.bincount(of_link)
    place = sums_by_group(middle, of_link) / count[:, None]
    thickness = np.bincount(of_link, t) / count

    of_end = np.full(len(V) + 1, -1)
    of_end[ends] = of_link[first % len(i)]
    node = of_end[np.where(source >= 0, source, len(V))]
    least = max(2.0 * spacing, OF_EDGES * np.median(lengths))
    graph = _graph(place, thickness, node[row], node[skin.indices], least)
    rows = np.where(node >= 0, node, len(place))
    of_node = sp.csr_matrix((areas, (rows, np.arange(len(V)))), (len(place) + 1, len(V)))
    facing = (of_node @ normals)[:-1]
    spread = of_node @ (normals[:, :, None] * normals[:, None, :]).reshape(-1, 9)
    reach = _farthest(V, node, place)
    return Skeleton(place, thickness, node, graph, reach, facing, spread[:-1].reshape(-1, 3, 3))


def _lengths(V, links):
    i, j = np.unique(np.sort(links.vertices[:, :2], axis=1), axis=0).T
    length = np.linalg.norm(V[i] - V[j], axis=1) + 1e-9
    one_way = sp.csr_matrix((length, (i, j)), shape=(len(V), len(V)))
    return one_way + one_way.T


def _farthest(V, node, place):
    """Return the vertices (m,d,3) of each node that are farthest in each of `_WAYS`, or itself."""
    used = np.flatnonzero(node >= 0)
    used = used[np.argsort(node[used], kind="stable")]
    places, of_node = V[used], node[used]
    found = np.repeat(place[:, None], len(_WAYS), axis=1)
    if not len(used):
        return found
    first = np.append(True, np.diff(of_node) > 0)
    begin, number = np.flatnonzero(first), np.cumsum(first) - 1
    for way, direction in enumerate(_WAYS):
        height = places @ direction
        last = np.flatnonzero(height == np.maximum.reduceat(height, begin)[number])
        found[of_node[last], way] = places[last]
    return found


def _graph(place, thickness, one, other, least):
    """Return the graph of nodes that meet at edges of the mesh, from one (e,) to the other (e,)."""
    m = len(place)
    is_pair = (one < other) & (one >= 0)
    one, other = np.divmod(np.unique(one[is_pair] * np.int64(m) + other[is_pair]), m)
    length = np.linalg.norm(place[one] - place[other], axis=1)
    low, high = np.sort([thickness[one], thickness[other]], axis=0)
    is_kept = (length < STEP * np.maximum(low, least)) & (high < ALIKE * low)
    one, other, length = one[is_kept], other[is_kept], length[is_kept] + 1e-9
    graph = sp.coo_matrix((length, (one, other)), shape=(m, m)).tocsr()
    return graph + graph.T


def _measured(skeleton):
    """Return direction (m,3), confidence (m,), width (m,) and distances (m,m) of the nodes.

    A node is as much of a limb as the best window that it lies in.
    """
    place, thickness = skeleton.place, skeleton.thickness
    distance = dijkstra(skeleton.graph, directed=False, limit=FAR * thickness.max())
    ratio = thickness / thickness[:, None]
    is_alike = (ratio < ALIKE) & (ratio > 1.0 / ALIKE)
    products = (place[:, :, None] * place[:, None, :]).reshape(-1, 9)
    width = thickness
    for _ in range(2):
        # of nodes, not of links: those are dense where it is thick
        window = np.where(is_alike & (distance <= REACH * width[:, None]), 1.0, 0.0)
        total = window.sum(axis=1)[:, None]
        mean = window @ place / total
        second = (window @ products / total).reshape(-1, 3, 3)
        spread, axes = np.linalg.eigh(second - mean[:, :, None] * mean[:, None, :])
        spread = np.sqrt(12.0 * np.maximum(spread, 0.0))  # of a uniform line, its length
        thick = window @ thickness / total[:, 0]
        width = thick + spread[:, 1]
    axis, length = axes[:, :, 2], spread[:, 2] + END * thick
    moment = window @ (place * thickness[:, None]) / total - mean * thick[:, None]
    slope = np.abs((moment * axis).sum(axis=1)) / np.maximum(spread[:, 2] ** 2 / 12.0, 1e-12)
    for k in np.flatnonzero(slope > TAPER):
        length[k] = max(length[k], np.ptp(skeleton.reach[window[k] > 0.0] @ axis[k]))
    own = smoothstep(length / width, NONE, FULL) * _around(skeleton, window, axes)
    return axis, (window * own[:, None]).max(axis=0), width, distance


def _around(skeleton, window, axes):
    """Return how far the surface goes all around a line along the last of axes (m,3,3), 0 to 1.

    All its normals across the line would be in balance. Those of a flange are not. And they would
    face all ways: those of a wall do not, see `AROUND`.
    """
    facing, spread = window @ skeleton.facing, window @ skeleton.spread.reshape(-1, 9)
    across = axes[:, :, :2].swapaxes(1, 2)
    spread = across @ spread.reshape(-1, 3, 3) @ across.swapaxes(1, 2)
    facing = (across @ facing[:, :, None])[:, :, 0]
    squares = np.einsum("mi,mij,mj->m", facing, spread, facing)
    is_open = np.linalg.norm(facing, axis=1) ** 3 > OPEN * squares
    least, most = np.linalg.eigvalsh(spread).T
    return np.where(is_open, 0.0, smoothstep(least / np.maximum(most, 1e-12), *AROUND))


def _pieces(graph, direction, confidence, width):
    """Return the straight piece (m,) of each node, -1 for none, and their directions (s,3).

    They grow from the clearest nodes along the graph, as long as directions and widths are alike.
    """
    piece = np.full(len(confidence), -1)
    found = []
    for seed in np.argsort(-confidence, kind="stable"):
        if confidence[seed] <= 0.0 or piece[seed] >= 0:
            continue
        front, axis = [seed], direction[seed]
        total = np.zeros(3)
        while front:
            k = front.pop(0)
            if piece[k] >= 0 or confidence[k] <= 0.0 or abs(direction[k] @ axis) < STRAIGHT:
                continue
            if not 1.0 / ALIKE < width[k] / width[seed] < ALIKE:
                continue
            piece[k] = len(found)
            total += np.copysign(confidence[k], direction[k] @ axis) * direction[k]
            axis = total / np.sqrt(total @ total)
            front += graph.indices[graph.indptr[k] : graph.indptr[k + 1]].tolist()
        found.append(axis)
    return piece, np.array(found).reshape(-1, 3)


def _without_short(piece, directions, skeleton, width, distance):
    """Give the nodes of short pieces to the next long one along the graph, or to none.

    Where limbs meet, what is around a node lies across them, and such a piece is no limb. What
    tapers has few midpoints, but long sides.
    """
    is_long = np.zeros(len(directions), dtype=bool)
    for number, direction in enumerate(directions):
        rows = np.flatnonzero(piece == number)
        lengths = [np.ptp(x[rows] @ direction) for x in (skeleton.place, skeleton.reach)]
        least = np.array([SHORT, NONE]) * width[rows].mean()
        is_long[number] = (lengths > least).any()
    is_given = (piece >= 0) & ~is_long[piece]
    is_there = (piece >= 0) & is_long[piece]
    if not is_there.any():
        return np.full(len(piece), -1), directions[:0]
    number = np.where(is_there, (np.cumsum(is_long) - 1)[piece], -1)
    for k in np.flatnonzero(is_given):
        nearest = np.where(is_there, distance[k], np.inf).argmin()
        if distance[k, nearest] < width[k]:
            number[k] = number[nearest]
    return number, directions[is_long]


def _without_trunks(piece, count, graph, width):
    """Return the pieces (m,) of the nodes without those that are trunks: -1 instead.

    A trunk is the widest of its body, and limbs that are much thinner go from it to several sides.
    However long it is, it keeps the frame of the object: aslant, it would lean.
    """
    result = piece.copy()
    widths = np.array(
        [np.median(width[piece == k]) if (piece == k).any() else 0.0 for k in range(count)]
    )
    _, body = connected_components(graph, directed=False)
    for k in np.flatnonzero(widths > 0.0):
        is_own = piece == k
        is_body = body == body[np.flatnonzero(is_own)[0]]
        if widths[k] < WIDEST * width[is_body].max():
            continue
        others = np.flatnonzero(is_body & ~is_own)
        if not len(others):
            continue
        _, side = connected_components(graph[others][:, others], directed=False)
        is_thin = (piece[others] >= 0) & (widths[piece[others]] < THIN * widths[k])
        if len(np.unique(side[is_thin])) >= SIDES:
            result[is_own] = -1
    return result


def _cut(piece, directions, skeleton, confidence):
    """Return pieces (m,) and directions (s,3) of which those that bend are cut into short ones.

    The less of a limb a node is, the more it lies like its whole piece: where a neck begins, what
    is around a node is also the trunk.
    """
    result, found = np.full(len(piece), -1), []
    for number, axis in enumerate(directions):
        rows = np.flatnonzero(piece == number)
        if not len(rows):
            continue
        along = skeleton.place[rows] @ axis
        begin, length = along.min(), np.ptp(along)
        count = max(round(length / (CUT * skeleton.thickness[rows].mean())), 1)
        place = np.minimum((along - begin) * (count / max(length, 1e-12)), count - 1).astype(int)
        share = confidence[rows]
        limb, all_of_it = (np.bincount(place, x, count)[:, None] for x in (share, None))
        own = _tangents(skeleton.place[rows], place, share, count, axis)
        sums = np.where(all_of_it > 0, limb * own + (all_of_it - limb) * axis, axis)
        pieces = sums / np.linalg.norm(sums, axis=1)[:, None]
        if len(rows) < OF_NODES * count or (pieces @ axis > BEND).all():
            pieces, place = axis[None], np.zeros(len(rows), dtype=int)
        result[rows] = len(found) + place
        found += list(pieces)
    return result, np.array(found).reshape(-1, 3)


def _tangents(places, number, share, count, axis):
    """Return the directions (count,3) of the line through the middles of short pieces, along axis.

    Of the middles, as what is around a node, in its window, also lies beyond a bend.
    """
    weight = np.bincount(number, share, count)
    known = np.flatnonzero(weight > 0.0)
    if len(known) < 2:
        return np.tile(axis, (count, 1))
    sums = sums_by_group(share[:, None] * places, number, count)
    middles = sums[known] / weight[known, None]
    steps = np.diff(middles, axis=0)
    unit = steps / np.maximum(np.linalg.norm(steps, axis=1), 1e-12)[:, None]
    turns = np.arccos(np.clip((unit[1:] * unit[:-1]).sum(axis=1), -1.0, 1.0))
    fewest, least, in_others = FOOT
    for end, before in ((0, 1), (-1, -2)) if len(turns) >= fewest else ():
        if turns[end] > max(least, in_others * np.median(np.delete(turns, end))):
            steps[end] = steps[before]  # a foot is no part of the shank
    first, last = steps[:2].mean(axis=0), steps[-2:].mean(axis=0)  # a single step is noisy
    steps = np.vstack([first, steps, last])  # before and after each of them
    ends = steps[:-1] + steps[1:]
    tangents = np.tile(axis, (count, 1))
    tangents[known] = ends / np.maximum(np.linalg.norm(ends, axis=1), 1e-12)[:, None]
    return tangents


def _smoothed(shares, skin):
    """Return shares (n,s) without steps from vertex to vertex."""
    count = np.diff(skin.indptr)
    means = skin.matrix(np.repeat(1.0 / count, count))
    for _ in range(SMOOTHINGS):
        shares = means @ shares
    return shares
