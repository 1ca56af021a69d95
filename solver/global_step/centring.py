# SPDX-License-Identifier: GPL-3.0-or-later
"""Keep the centroid of each floating component where it is at rest."""

import numpy as np

from .tall_products import weighted_sum


class Centring:
    """The centroids of the components, weighted by area.

    `rest`: RestMesh. `is_floating`: (component_count,) bool, the components that move, at least
    one; the others stay as they are, bit for bit.
    """

    def __init__(self, rest, is_floating):
        topology = rest.topology
        self._is_whole = topology.component_count == 1
        share = topology.shares(rest.weighing)
        if self._is_whole:
            self._share = share
        else:
            share = np.where(is_floating[topology.component], share, 0.0)
            self._share = topology.by_component(share[:, None]).T
            self._spread = topology.by_component(np.ones((len(share), 1)))
        self._centroids = self._measure(rest.V)

    def _measure(self, U):
        """Return the centroids (component_count,3), zero of those that do not float."""
        return weighted_sum(self._share, U)[None] if self._is_whole else self._share @ U

    def impose(self, U):
        """Move the components of positions U (n,3), in place, to where their centroids were."""
        shift = self._centroids - self._measure(U)
        if not self._is_whole:
            U += self._spread @ shift
            return
        for column, step in zip(U.T, shift[0], strict=True):
            column += step  # adding rows of three takes NumPy ten times as long
