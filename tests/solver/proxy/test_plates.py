# SPDX-License-Identifier: GPL-3.0-or-later
"""Thin plates become square: lids, coins, the tops of tables."""

import numpy as np
import pytest

from solver import ProxyOptions, stylize


def disc(height, radius=1.0, around=96, rings=20):
    """Return a round plate."""
    outline = [(radius * (k + 0.5) / (rings + 0.5), 0.0) for k in range(rings + 1)]
    outline += [(r, height) for r, _ in outline[::-1]]
    angle = np.arange(around) * 2.0 * np.pi / around
    V = np.concatenate(
        [
            np.stack([r * np.cos(angle), r * np.sin(angle), 0 * angle + z], axis=1)
            for r, z in outline
        ]
    )
    ring, k = np.divmod(np.arange(len(V) - around), around)
    a, b = ring * around + k, ring * around + (k + 1) % around
    first, second = (a, b, b + around), (a, b + around, a + around)
    return V, np.concatenate([np.stack(first, axis=1), np.stack(second, axis=1)])


def squareness(V):
    """Return how much farther the corners are from the middle than the sides; sqrt(2) at most."""
    radius, angle = np.linalg.norm(V[:, :2], axis=1), np.arctan2(V[:, 1], V[:, 0])
    quarter = np.abs((angle + np.pi / 4) % (np.pi / 2) - np.pi / 4)
    return radius[quarter > np.pi / 4 - 0.1].max() / radius[quarter < 0.1].max()


@pytest.mark.parametrize("height", [0.05, 0.1, 0.3])
@pytest.mark.parametrize(("crispness", "least"), [(0.0, 1.18), (0.9, 1.24)])
def test_discs_become_square(height, crispness, least):
    """Without softer faces, those of 0.05 and 0.1 stay round: 1.02 to 1.04, and 1.04 to 1.16."""
    V, F = disc(height)
    U = stylize(V, F, 0.4, proxy=ProxyOptions(), keep_rotation=True, crispness=crispness).positions
    assert squareness(V) < 1.01
    assert squareness(U) > least
    assert np.ptp(U[:, 2]) == pytest.approx(height, rel=0.35)
