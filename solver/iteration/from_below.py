# SPDX-License-Identifier: GPL-3.0-or-later
"""Approach a high cubeness from below.

From rest, all normals jump to the side next to them at once where the cubeness is high. They lock
there, before neighbors could agree on where the sides meet: a minimum with many small sides. At
cubeness 1 they turn with the surface, and the sides become large. So a run first goes to the end at
cubeness 1, and on from there, in stages of a few iterations, each with a somewhat higher one.
"""

import math

import numpy as np

FIRST = 1.0
"""cubeness of the first stage; what has no more is solved from rest as ever"""
GROWTH = 1.5
"""The cubeness of a stage is at most so many times that of the one before."""
ITERATIONS = 10
"""of each stage but the first, which converges; the last one, at the cubeness itself, does, too"""


class FromBelow:
    """The stages of a run before the cubeness itself.

    There are none for the plain iteration, for a Stylization that has been started from elsewhere
    than rest, and up to cubeness `FIRST`. They have at most half of the iterations.

    `stylization`: Stylization. `max_iterations`: int, of the run.
    """

    def __init__(self, stylization, max_iterations):
        is_new = not stylization.is_started and stylization.options.is_accelerated
        self._most = max_iterations // 2
        self._left = [] if not is_new or self._most < 1 else _stages(stylization.style.cubeness)
        self._end = self._most

    @property
    def is_done(self):
        """Whether the run has reached the cubeness itself."""
        return not self._left

    def is_over(self, iteration, is_converged):
        """Return whether the stage is over after so many iterations of the run."""
        return is_converged or iteration >= self._end

    def rise(self, stylization):
        """Take a Stylization to the next stage, or to the cubeness itself."""
        done = stylization.iterations
        if done >= self._most:
            self._left = [math.inf]
        self._end = min(done + ITERATIONS, self._most) if done else self._most
        stylization.limit_cubeness(self._left.pop(0))


def _stages(cubeness):
    """Return the limits of the cubeness (n,), the last one infinite, or [] if none is needed."""
    highest = float(np.max(cubeness, initial=0.0))
    if highest <= FIRST:
        return []
    count = math.ceil(math.log(highest / FIRST) / math.log(GROWTH))
    return [FIRST * (highest / FIRST) ** (k / count) for k in range(count)] + [math.inf]
