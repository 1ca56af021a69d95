# SPDX-License-Identifier: GPL-3.0-or-later
"""When the iteration has converged."""

from __future__ import annotations

ENERGY_WINDOW = 10
"""number of iterations over which the fall of the energy is measured"""
ENERGY_SHARE = 0.1
"""limit of the fall per iteration relative to the total fall, as a fraction of the tolerance"""


class StopRule:
    """Converged when the shape no longer moves and the energy no longer falls.

    Neither alone is sufficient: the displacement may stall before the shape snaps into place, while
    the energy still falls; and the energy hardly changes while flat regions still slide.

    Parameters
    ----------
    tolerance : float
        Largest displacement in one iteration, relative to the largest distance from the rest shape.
    resolution : float
        Distance below which differences are rounding errors.

    See Also
    --------
    Progress : An estimate of the progress until then.

    Examples
    --------
    >>> from solver import StopRule
    >>> rule = StopRule(tolerance=1e-3)
    >>> [rule.is_converged(energy, 1e-6, 1.0) for energy in (2.0, 1.0, 1.0)]
    [False, False, False]
    >>> [rule.is_converged(1.0, 1e-6, 1.0) for _ in range(9)][-2:]
    [False, True]
    """

    def __init__(self, tolerance: float, resolution: float = 1e-9):
        self._tolerance = tolerance
        self._resolution = resolution
        self._energies: list[float] = []

    def is_converged(self, energy: float, displacement: float, distance: float) -> bool:
        """Record one iteration and return whether it was the last.

        Parameters
        ----------
        energy : float
            Total energy.
        displacement : float
            Largest displacement of a vertex in this iteration.
        distance : float
            Largest distance of a vertex from its rest position.
        """
        self._energies.append(energy)
        if displacement > self._tolerance * distance + self._resolution:
            return False
        if distance <= self._resolution:
            # The first iterations of the ADMM may leave all rotations at the identity.
            return len(self._energies) > 2
        window = self._energies[-ENERGY_WINDOW - 1 :]
        fall = (window[0] - energy) / max(len(window) - 1, 1)
        whole = self._energies[0] - energy
        return len(window) > 1 and fall <= ENERGY_SHARE * self._tolerance * max(whole, 0.0)
