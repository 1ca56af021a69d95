# SPDX-License-Identifier: GPL-3.0-or-later
"""How far a run has come, as one number for a progress bar."""

import math


class Progress:
    """Estimate the progress of a run from 0 to 1; it never goes back.

    The displacement per iteration falls about exponentially, so its logarithm, between the start
    and the tolerance, tells more than the iteration count, whose end is not known.

    Parameters
    ----------
    max_iterations, tolerance
        As in `run`.
    """

    def __init__(self, max_iterations, tolerance):
        self._max_iterations = max_iterations
        self._tolerance = tolerance
        self._fraction = 0.0

    def update(self, stylization):
        """Take in one iteration of a Stylization and return the fraction done."""
        fraction = stylization.iteration / self._max_iterations
        if stylization.iteration > 1 and stylization.distance > 0.0:
            relative = stylization.displacement / stylization.distance
            if 0.0 < relative < 1.0 and 0.0 < self._tolerance < 1.0:
                by_size = math.log(relative) / math.log(self._tolerance)
                fraction = max(fraction, min(by_size, 0.99))
        self._fraction = max(self._fraction, min(fraction, 1.0))
        return self._fraction
