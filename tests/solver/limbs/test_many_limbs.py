# SPDX-License-Identifier: GPL-3.0-or-later
"""Hundreds of limbs at once: each as if it were alone, in memory that grows with their number."""

import tracemalloc

import limb_shapes
import numpy as np
import proxy_shapes
import shapes

from solver import ProxyOptions, rest_mesh


def bars(count):
    """Return the RestMesh of bars side by side, each turned another way."""
    z = np.linspace(-1.5, 1.5, 24)
    V, F = limb_shapes.tube(np.outer(z, [0.0, 0.0, 1.0]), 0.2, 12)
    angles = np.random.default_rng(2).uniform(-60, 60, (count, 3))
    places = [[4.0 * (k % 16), 4.0 * (k // 16), 0.0] for k in range(count)]
    turned = ((V @ shapes.rotation(*a).T + at, F) for a, at in zip(angles, places, strict=True))
    return rest_mesh(*proxy_shapes.joined(*turned), ProxyOptions())


def peak_of_limbs(rest):
    """Return the Limbs of a RestMesh, and the most bytes at once while they are found."""
    tracemalloc.start()
    limbs = rest.limbs
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return limbs, peak


def test_of_many_bars_each_lies_along_itself_in_memory_that_grows_with_their_number():
    few, peak_of_few = peak_of_limbs(bars(32))
    rest = bars(128)
    limbs, peak = peak_of_limbs(rest)
    assert peak < 6.0 * peak_of_few  # with distances between all, it was 9 times
    assert len(limbs) == 4 * len(few) == 128
    of_vertex = np.asarray(limbs.shares.argmax(axis=1)).ravel()
    for k in range(128):
        rows = np.flatnonzero(rest.topology.part == k)
        found = np.bincount(of_vertex[rows]).argmax()
        direction = np.linalg.eigh(np.cov(rest.V[rows].T))[1][:, 2]
        assert abs(limbs.directions[found] @ direction) > 0.999
