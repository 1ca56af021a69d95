# SPDX-License-Identifier: GPL-3.0-or-later
"""Acceleration of the local-global iteration: the same minimum in a fraction of the iterations.

The iteration is a descent method with the cotangent Laplacian as its metric. Nesterov's method of
1983 starts each step not from the last positions but from a point further on; the optimized
gradient method (Kim and Fessler, "Optimized first-order methods for smooth convex minimization",
2016) also goes further along the step itself, which its proof allows for. Both forget their
momentum when the energy rises (O'Donoghue and Candes, "Adaptive Restart for Accelerated Gradient
Schemes", 2015, function scheme). It costs one pass over the positions per iteration, and gains
most from an exact local step.

To begin with the momentum of a later iteration, and to keep some of it when the energy has risen
once, saves a tenth of the iterations where many are needed and costs one or two where few are.
`docs/benchmarks_explained.md` has the numbers of iterations.
"""

import numpy as np

START = 30.0
"""the first t: that of the 59th iteration, as if the run had been going for a while"""
RESTART = 4.0
"""the t of the 7th iteration, after the energy has risen; 1 if it rises again immediately"""
OVERSHOOT = 0.65
"""share of the additional step; the larger it is, the longer the details oscillate"""


class Momentum:
    """The extrapolation of one run.

    Each component has its own momentum, so that it moves as it would alone.

    `count`: int, number of components.
    """

    def __init__(self, count):
        self._t = np.full(count, START)
        self._energies = np.full(count, np.inf)
        self._has_risen = np.zeros(count, dtype=bool)

    def observe(self, energies):
        """Take in the energies (count,) of the extrapolated point; restart what has risen."""
        has_risen = energies > self._energies
        self._t[has_risen] = np.where(self._has_risen, 1.0, RESTART)[has_risen]
        self._energies, self._has_risen = energies, has_risen

    def next(self):
        """Return how far to extrapolate from the new positions, for each component.

        Returns `momentum`: (count,), as a multiple of the last displacement; `overshoot`: (count,),
        as a multiple of the step from the extrapolated point to the new positions.
        """
        t_next = 0.5 * (1.0 + np.sqrt(1.0 + 4.0 * self._t * self._t))
        momentum, overshoot = (self._t - 1.0) / t_next, OVERSHOOT * self._t / t_next
        self._t = t_next
        return momentum, overshoot
