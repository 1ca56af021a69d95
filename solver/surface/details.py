# SPDX-License-Identifier: GPL-3.0-or-later
"""The normals of a surface without its details, so that these ride along.

The cubic term turns the normals of the rest shape toward the form. Of a bump smaller than a given
size, it would turn each side on its own and so flatten it. If it sees the normals of the surface
below instead, the bump is carried along as it is, and what was spent on flattening it is free for
the whole. The smoothed normals g of the triangles, with areas M, solve

    (M + div(k grad)) g = M n,    k = r^2 / 4

where the radius r is that of the details. A thin part has smaller ones than a head, or the bends of
an arm would count as its details, and keep it from being straight: where the surface is thinner
than `THICK` of the whole, they are smaller in proportion. Nor is r ever more than half of what it
is thick there, or a limb would average its front and its back.

What is flat stays flat: edges of the whole shape survive. In further rounds, the flow between two
triangles is divided by 1 + x^2, where the result of the round before turns by x times `EDGE`
radians over the radius (Wang and others, "Rolling guidance normal filter for geometric processing",
2015, with diffusion in place of a sum). Only where the surface bends outward: the edge of a cushion
belongs to the whole; a fold, an eye socket or a mouth is a detail.

A vertex has the mean of the triangles around it. The length l of that says how far they agree; its
cubeness counts `WEIGHT` l^2 times, so that bumpy and tightly curved places are drawn less, and the
rest more.
"""

import numpy as np

from ..aliases import FloatArray

WEIGHT = 1.75
"""of the cubeness where all normals agree"""
THICK = 0.4
"""of the largest extent of the whole, beside which details are a share of it, too"""
SMALL_PART = 2.0
"""times the size of the details: a smaller part that touches others is itself a detail"""
EDGE = 0.35
"""radians over the radius; edges that turn by more survive"""
AGREEING = 0.4, 0.7
"""length of the mean of the normals around: with less than the first it is no edge, as where they
cancel each other around an eye; across an edge of 90 degrees it is the second"""
ROUNDS = 4
"""in which edges become sharp again"""
LARGE = 100_000
"""vertices of a part: each round would take all of the iterations that it has at most"""

_TOLERANCE = 1e-2  # error of the normals, roughly
_MOST_ITERATIONS = 60
_FURTHER = 1e-2  # share of the error of the first solve, squared, that is no longer seen
_LEAST_AREA = 1e-12


def radii(share, whole, thickness, part_sizes, is_alone):
    """Return how far the normals of each vertex are averaged, (n,).

    `share`: size of the details relative to the largest extent of the whole, `whole`: (n,), in the
    unit box. `thickness`: (n,), of the surface, infinite where it has none. `part_sizes`: (n,),
    largest extent of the part of each vertex. `is_alone`: (n,) bool, whether the part touches no
    other.
    """
    size, of_limb = share * whole, min(share / THICK, 0.5) * thickness
    is_detail = ~is_alone & (part_sizes <= SMALL_PART * size)
    return np.where(is_detail, size, np.minimum(size, of_limb))


def smoothed(
    graph, radius, coupling, outward: FloatArray | float = 1.0, rounds=ROUNDS, largest_part=0
):
    """Return the normals (m,3) of triangles without their details, shorter where they disagree.

    `graph`: FaceGraph. `radius`: (m,), see `radii`. `coupling`: (k,), of the pairs of triangles of
    the graph, from 0 across the sharp creases of flat sides, where nothing is averaged, to 1.
    `outward`: (m,), optional, -1 for triangles of parts that are inside out. `rounds`: int, in
    which edges become sharp again. `largest_part`: int, its vertices: beyond `LARGE`, these are
    solved less exactly. Small parts need them exact: some are averaged as a whole.
    """
    conductance = coupling * graph.length / graph.distance
    conductance *= 0.125 * (radius[graph.one] ** 2 + radius[graph.other] ** 2)
    between = 0.5 * (radius[graph.one] + radius[graph.other])
    found, least = _diffused(graph, conductance, graph.normals)
    goal = _FURTHER * least if largest_part > LARGE else 0.0
    length = np.linalg.norm(found, axis=1)
    length = np.minimum(length[graph.one], length[graph.other])
    is_edge = np.clip((length - AGREEING[0]) / (AGREEING[1] - AGREEING[0]), 0.0, 1.0)
    for _ in range(rounds):
        guide = unit(found)
        turn = graph.distances(guide)
        x = turn * between / graph.distance / EDGE * is_edge
        x *= graph.is_convex(np.multiply(guide.T, outward).T)
        found, _ = _diffused(graph, conductance / (1.0 + x * x), found, goal)
    return np.where(graph.areas[:, None] > 0.0, found, 0.0)


def at_vertices(normals, areas, F, n):
    """Return the means of normals (m,3) of triangles at the vertices, and how far they agree.

    Returns (n,3), unit normals, or zero; (n,), l, between 0 and 1.
    """
    corners = F.ravel()
    sums = [np.bincount(corners, np.repeat(areas * x, 3), n) for x in normals.T]
    total = np.bincount(corners, np.repeat(areas, 3), n)
    means = np.stack(sums, axis=1) / np.where(total > 0.0, total, 1.0)[:, None]
    return unit(means), np.minimum(np.linalg.norm(means, axis=1), 1.0)


def unit(vectors):
    """Return vectors (n,3) with the length 1, or zero."""
    length = np.sqrt((vectors * vectors).sum(axis=1, keepdims=True))
    is_some = length > 1e-12
    return np.where(is_some, vectors, 0.0) / np.where(is_some, length, 1.0)


def _diffused(graph, conductance, near, goal=0.0):
    """Solve (M + div(k grad)) g = M n from a solution near it, as `_solved` does."""
    areas = graph.areas + _LEAST_AREA
    A = graph.matrix(-conductance, areas + graph.sums(conductance))
    return _solved(A, areas[:, None] * graph.normals, near, goal)


def _solved(A, b, near, goal):
    """Solve A x = b (n,3) from a solution near it, by conjugate gradients.

    To a hundredth of the distance, roughly, or to a `goal`, if that is farther: single precision is
    enough, and takes half of the time. Returns x and the goal.
    """
    A = A.astype(np.float32)
    x, b = (np.array(values.T, np.float32, order="C") for values in (near, b))
    scale = 1.0 / A.diagonal()
    residual = b - _image(A, x, np.empty_like(b))
    z = scale * residual
    direction, rate = z.copy(), float((residual * z).sum())
    goal = max(goal, _TOLERANCE**2 * max(rate, 1e-300))
    image, product = np.empty_like(b), np.empty_like(b)  # new ones each time are new pages
    for _ in range(_MOST_ITERATIONS):
        if rate <= goal:
            break
        _image(A, direction, image)
        step = rate / float(np.multiply(direction, image, out=product).sum())
        x += np.multiply(step, direction, out=product)
        residual -= np.multiply(step, image, out=product)
        np.multiply(scale, residual, out=z)
        rate, before = float(np.multiply(residual, z, out=product).sum()), rate
        direction *= rate / before
        direction += z
    return np.array(x.T, np.float64, order="C"), goal


def _image(A, columns, image):
    for row, column in zip(image, columns, strict=True):
        row[:] = A @ column
    return image
