# SPDX-License-Identifier: GPL-3.0-or-later
"""When the iteration has converged."""

ENERGY_WINDOW = 10
"""number of iterations over which the fall of the energy is measured"""
ENERGY_SHARE = 0.1
"""limit of the fall per iteration relative to the total fall, as a fraction of the tolerance"""

SWINGING_WINDOW = 20
"""the same where parts may swing..."""
SWINGING_SHARE = 1e-3
"""...and the limit there, whatever still moves"""
SWINGING_FALL = 0.01
"""of the energy at first: the least total fall there, as in chain mail, whose rings only drift"""


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
    may_swing : bool
        Whether parts are linked. One that hangs by a corner, such as a leaf, may swing for a
        thousand iterations, and carries next to none of the energy: it is not waited for.

    Examples
    --------
    >>> from solver import StopRule
    >>> rule = StopRule(tolerance=1e-3)
    >>> [rule.is_converged(energy, 1e-6, 1.0) for energy in (2.0, 1.0, 1.0)]
    [False, False, False]
    >>> [rule.is_converged(1.0, 1e-6, 1.0) for _ in range(9)][-2:]
    [False, True]
    """

    def __init__(self, tolerance: float, resolution: float = 1e-9, may_swing: bool = False):
        self._tolerance = tolerance
        self._resolution = resolution
        self._may_swing = may_swing
        self._energies: list[float] = []

    def is_converged(self, energy: float, displacement: float, distance: float) -> bool:
        """Record one iteration and return whether it was the last.

        `energy`: the total. `displacement`, `distance`: the largest of any vertex, in this
        iteration and from rest.
        """
        self._energies.append(energy)
        if displacement > self._tolerance * distance + self._resolution:
            return self._may_swing and self._only_swings()
        if distance <= self._resolution:
            # The first iterations of the ADMM may leave all rotations at the identity.
            return len(self._energies) > 2
        window = self._energies[-ENERGY_WINDOW - 1 :]
        fall = (window[0] - energy) / max(len(window) - 1, 1)
        whole = self._energies[0] - energy
        return len(window) > 1 and fall <= ENERGY_SHARE * self._tolerance * max(whole, 0.0)

    def _only_swings(self) -> bool:
        """Return whether what moves carries next to nothing; the energy may rise in between."""
        before = self._energies[:-SWINGING_WINDOW]
        if not before:
            return False
        least = min(self._energies)
        fall = (min(before) - least) / SWINGING_WINDOW
        whole = max(self._energies[0] - least, SWINGING_FALL * self._energies[0])
        return fall <= SWINGING_SHARE * self._tolerance * whole
