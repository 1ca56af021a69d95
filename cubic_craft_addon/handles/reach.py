# SPDX-License-Identifier: GPL-3.0-or-later
"""How far handles reach: around themselves, and into the rest of the mesh."""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

from collections.abc import Sequence

import numpy as np

from ... import solver
from .handle import Handle

LEAST_RADIUS = 0.03
"""of the largest extent: a smaller handle takes what is around it along, else it pulls a spike"""
NEAR, FAR = 0.2, 0.6
"""of the largest distance from the handles: what is nearer goes along, what is further stays"""


def grown(
    handle_of: np.ndarray, handles: Sequence[Handle], V: np.ndarray, F: np.ndarray
) -> np.ndarray:
    """Return the handle that holds each vertex, where small ones hold some around them as well.

    Parameters
    ----------
    handle_of : (n,) int array, from `handles.handle_of`
    handles
    V : (n,3) array, positions as they are seen
    F : (m,3) int array
    """
    result = handle_of.copy()
    if not len(F):
        return result
    radius = LEAST_RADIUS * float(np.ptp(V[F.ravel()], axis=0).max())
    for number, handle in enumerate(handles):
        own = np.flatnonzero(handle_of == number)
        if handle.is_cubic or not len(own):
            continue
        if np.linalg.norm(V[own] - V[own].mean(axis=0), axis=1).max() < radius:
            distance = solver.edge_distances(V, F, own, radius)
            result[(distance <= radius) & (handle_of < 0) & (result < 0)] = number
    return result


def far_from(seeds: np.ndarray, V: np.ndarray, F: np.ndarray) -> np.ndarray:
    """Return how far from the seeds each vertex is: (n,) from 0, near, to 1.

    Along edges, as an arm is far from the hip that it hangs beside; parts that no edge leads to are
    as far as they lie.
    """
    if not len(seeds) or not len(F):
        return np.zeros(len(V))
    distance = solver.edge_distances(V, F, seeds)
    is_apart = np.isinf(distance)
    largest = distance[~is_apart].max()
    if is_apart.any():
        distance[is_apart] = solver.nearest_distances(V[is_apart], V[seeds])
    if not largest > 0.0:
        largest = float(distance.max())
    if not largest > 0.0:
        return np.zeros(len(V))
    t = np.clip((distance / largest - NEAR) / (FAR - NEAR), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)
