# SPDX-License-Identifier: GPL-3.0-or-later
"""Open rims that lie in a plane at rest, as those of a lampshade or a bell: they stay in one."""

import numpy as np

from ..algebra import sums_by_group

FLAT = 0.01
"""of the size of a rim: the root of the mean square of the distances from its plane at rest"""
FEWEST = 8
"""vertices: what has fewer is a hole in a mesh"""
NO_RIMS = np.empty(0, np.intp), np.empty(0, np.intp), np.empty((0, 3))
"""as of `open_rims`"""


def open_rims(V, graph, R):
    """Return the vertices (k,) of flat open rims, the number (k,) of the rim, and what each faces.

    The last is (r,3), unit vectors: the normals at rest, turned. `V`: (n,3), rest positions.
    `graph`: FaceGraph. `R`: (n,3,3), rotations.
    """
    at, rim = graph.edges.rims
    away, size = from_middles(V[at], rim)
    count = len(size)
    spread = np.zeros((count, 3, 3))
    np.add.at(spread, rim, away[:, :, None] * away[:, None, :])
    values, vectors = np.linalg.eigh(spread)
    is_flat = (values[:, 0] <= FLAT * FLAT * values[:, 2]) & (values[:, 1] > FLAT * values[:, 2])
    is_flat &= size >= FEWEST
    turned = np.zeros((count, 3))
    np.add.at(turned, rim, np.einsum("kij,kj->ki", R[at], vectors[rim, :, 0]))
    length = np.linalg.norm(turned, axis=1)
    is_flat &= length > 0.5 * size
    kept = np.flatnonzero(is_flat[rim])
    numbers = np.cumsum(is_flat) - 1
    return at[kept], numbers[rim[kept]], turned[is_flat] / length[is_flat, None]


def from_middles(places, rim):
    """Return vectors (k,3) to places from the middles of their rims (k,), and sizes (r,) of these.

    The size is the number of places.
    """
    size = np.bincount(rim)
    return places - (sums_by_group(places, rim) / size[:, None])[rim], size
