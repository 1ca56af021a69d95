# SPDX-License-Identifier: GPL-3.0-or-later
"""Rounds in which surfaces that have come to cross are drawn apart again.

At the end of a run, triangles that cross and did not cross at rest are found. Without any, that is
all. Otherwise links are made across the gaps that are closed, the global step is factorized anew,
and the iteration goes on from where it is; up to four times. The links only add a term to the
energy, so it falls in every step of a round.
"""

import numpy as np

from ..proxy.links import no_links
from .crossings import crossings
from .gaps import Gaps
from .pairs import links_against, merged, mirrored
from .push import pushed

ROUNDS = 4
FEW = 1.0 / 2000.0
"""of the triangles: so few are pushed apart first, and only if that fails there is a round"""


class KeepApart:
    """The rounds of one run.

    Call `check` when the iteration has ended, then `renewed` if it asks for another round, else
    `finish`. All of them take the Stylization.

    Attributes
    ----------
    crossings : int
        Number of triangles of the input that cross and did not at rest.
    vertices : (k,) int array
        Their vertices in the input.
    """

    def __init__(self, rest):
        self._rest, self._shown = rest, rest.shown
        self._links, self._gaps, self._rounds = no_links(), None, 0
        self._pairs = np.empty((0, 2), np.intp)
        self._best: tuple | None = None
        self._progress, self._is_pushed = (0, 0), False
        self.crossings, self.vertices = 0, np.empty(0, np.intp)

    def check(self, stylization):
        """Find what crosses now; return whether another round is needed."""
        U = stylization.positions
        self._pairs = self._new(U)
        count = self._count(self._pairs)
        if self._best is None or count < self._best[0]:
            self._best = count, U.copy(), stylization.rotations.copy(), self._pairs
        progress = len(self._links), -count
        is_stuck = self._rounds > 0 and progress <= self._progress
        self._progress = progress
        if not count or self._rounds == ROUNDS or is_stuck:
            return False
        if count > FEW * len(self._shown):
            return True
        self._push(stylization)
        return self._best[0] > 0

    def renewed(self, stylization):
        """Return a Stylization with links against what crosses, from the same state."""
        if self._gaps is None:
            self._gaps = Gaps(self._rest.V, self._rest.normals, self._rest.F)
        U, R = stylization.positions, stylization.rotations
        is_wide = self._rounds > 0  # fewer links have not been enough
        found = links_against(self._rest, self._gaps, self._shown, self._pairs, U, R, is_wide)
        found = mirrored(found, stylization.setup.mirrors)
        self._links = merged(self._links, found)
        self._rounds += 1
        return stylization.continued(stylization.setup.linked(self._rest, self._links))

    def finish(self, stylization):
        """Go to the best state, and push apart what still crosses there."""
        assert self._best is not None
        if self._best[0]:
            self._push(stylization)
        _, U, R, pairs = self._best
        if self._rounds or self._is_pushed:
            stylization.go_to(R, U)
        crossing = self._triangles(pairs)
        self.crossings = len(np.unique(crossing))
        self.vertices = np.unique(self._rest.triangles[crossing])

    def _push(self, stylization):
        """Push apart what crosses in the best state, which becomes a better one if that helps."""
        assert self._best is not None
        count, U, R, pairs = self._best
        is_free = np.ones(len(U), dtype=bool)
        is_free[stylization.setup.pinned] = False
        V, shown, impose = self._rest.V, self._shown, stylization.impose
        U = pushed(V, U, shown, pairs, self._counts, is_free, impose)
        pairs = self._new(U)
        if self._count(pairs) < count:
            self._best, self._is_pushed = (self._count(pairs), U, R, pairs), True

    def _new(self, U):
        """Return pairs (k,2) of triangles that cross and did not both cross something at rest."""
        pairs = crossings(U, self._shown)
        return pairs[self._counts(pairs)]

    def _counts(self, pairs):
        """Return which pairs (k,2) count: not those of triangles that both crossed at rest."""
        if not len(pairs):
            return np.zeros(0, dtype=bool)
        return ~self._rest.crossing_at_rest[pairs].all(axis=1)

    def _count(self, pairs):
        return len(np.unique(self._triangles(pairs)))

    def _triangles(self, pairs):
        """Return the triangles of pairs that crossed nothing at rest."""
        triangles = pairs.ravel()
        return triangles[~self._rest.crossing_at_rest[triangles]]
