# SPDX-License-Identifier: GPL-3.0-or-later
"""How far handles reach: around themselves, and into the rest of the mesh."""

from collections.abc import Sequence

import numpy as np

from ..algebra import smoothstep
from ..aliases import FloatArray, IntArray
from .handle_pose import HandlePose

LEAST_RADIUS = 0.03
"""of the largest extent: smaller handles move their surroundings, or they would pull a spike"""
NEAR, FAR = 0.2, 0.6
"""of the largest distance from the handles: closer vertices move along, farther ones stay"""


def grown(
    handle_of: IntArray, handles: Sequence[HandlePose], V: FloatArray, F: IntArray
) -> IntArray:
    """Return the handle that holds each vertex; small handles also hold vertices around them.

    `handle_of`: (n,) int, -1 for vertices of none. `V`: (n,3), visible positions. `F`: (m,3) int.
    """
    from ..mesh.edge_distances import edge_distances

    result = handle_of.copy()
    if not len(F):
        return result
    radius = LEAST_RADIUS * float(np.ptp(V[F.ravel()], axis=0).max())
    for number, handle in enumerate(handles):
        own = np.flatnonzero(handle_of == number)
        if handle.is_cubic or not len(own):
            continue
        if np.linalg.norm(V[own] - V[own].mean(axis=0), axis=1).max() < radius:
            distance = edge_distances(V, F, own, radius)
            result[(distance <= radius) & (handle_of < 0) & (result < 0)] = number
    return result


def far_from(seeds: IntArray, V: FloatArray, F: IntArray) -> FloatArray:
    """Return the distance of each vertex from the seeds, (n,) from 0, near, to 1, far.

    It is measured along edges, because an arm is far from the hip beside it; for unconnected parts,
    it is the straight distance.
    """
    from scipy.spatial import KDTree

    from ..mesh.edge_distances import edge_distances

    if not len(seeds) or not len(F):
        return np.zeros(len(V))
    distance = edge_distances(V, F, seeds)
    is_apart = np.isinf(distance)
    largest = distance[~is_apart].max()
    if is_apart.any():
        distance[is_apart] = KDTree(V[seeds]).query(V[is_apart])[0]
    if not largest > 0.0:
        largest = float(distance.max())
    if not largest > 0.0:
        return np.zeros(len(V))
    return smoothstep(distance / largest, NEAR, FAR)


def rest_weights(
    handles: Sequence[HandlePose], handle_of: IntArray, V: FloatArray, F: IntArray
) -> FloatArray | None:
    """Return the weights (n,) of `far_from` for moved handles, None if none is moved."""
    moved = [number for number, handle in enumerate(handles) if handle.is_moved]
    if not moved:
        return None
    return far_from(np.flatnonzero(np.isin(handle_of, moved)), V, F)
