# SPDX-License-Identifier: GPL-3.0-or-later
"""Of thousands of parts, what is near is found exactly, and in little memory."""

import tracemalloc

import numpy as np
import proxy_shapes
import shapes

from solver.algebra import dot
from solver.mesh.components import components
from solver.mesh.rest_measures import areas_and_normals
from solver.proxy.closest_point import closest_points
from solver.proxy.nearest_triangles import NearestTriangles
from solver.proxy.neighbors import neighbor_links
from solver.proxy.samples import extents

LEAF = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]), [[0, 1, 2], [0, 2, 3]]


def leaves(count, size, others=()):
    """Return leaves that lie in all directions, with other meshes: V, F, parts, their number."""
    rng = np.random.default_rng(3)
    turned = [
        (size * LEAF[0] @ shapes.rotation(*angles) + place, np.array(LEAF[1]))
        for angles, place in zip(
            rng.uniform(-90, 90, (count, 3)), rng.uniform(0, 1, (count, 3)), strict=True
        )
    ]
    V, F = proxy_shapes.joined(*others, *turned)
    V = (V - V.min(axis=0)) / np.ptp(V, axis=0).max()
    return V, F, *components(F, len(V))[::-1]


def nearest_of_all(V, F, part, i):
    """Return how far from vertices i (k,) the nearest triangle of another part is."""
    found = np.full(len(i), np.inf)
    for corners in F:
        a, b, c = (np.tile(V[corner], (len(i), 1)) for corner in corners)
        beta = closest_points(V[i], a, b, c)
        d = beta[:, :1] * a + beta[:, 1:2] * b + beta[:, 2:] * c - V[i]
        found = np.where(part[corners[0]] == part[i], found, np.minimum(found, dot(*d.T, *d.T)))
    return np.sqrt(found)


def test_the_nearest_triangle_of_many_parts_is_found():
    V, F, part, count = leaves(400, 0.03, [shapes.sphere(2)])
    assert count > 300
    i, sizes = np.arange(0, len(V), 7), extents(V, part)
    within = 0.05

    def reach(_size):
        return np.full(len(i), within)

    search = NearestTriangles(V, F.astype(np.int64), part, i, sizes, reach)
    expected = nearest_of_all(V, F, part, i)
    np.testing.assert_array_equal(search.triangle >= 0, expected < within)
    found, _, _, d = search.ways()
    assert len(found) > 50
    np.testing.assert_allclose(
        np.linalg.norm(d, axis=1), expected[search.triangle >= 0], atol=1e-12
    )


def test_many_parts_take_little_memory():
    """Of as many parts, each vertex once had 80 triangles to choose from, of which it kept all."""
    V, F, part, count = leaves(6000, 0.01, [shapes.sphere(3)])
    areas, normals = areas_and_normals(V, F)
    tracemalloc.start()
    neighbor_links(V, F, normals, areas, part, count)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 3000 * len(V)
