# SPDX-License-Identifier: GPL-3.0-or-later
"""How far an energy is from the lowest known one, and when a run came how near."""

from statistics import median

GAPS = (0.05, 0.01, 0.001)
"""the gaps whose times are reported"""


def gap(energy, rest, best):
    """Return (energy - best) / (rest - best): 1 for the undeformed mesh, 0 for the best shape.

    Parameters
    ----------
    energy, rest, best : float
        Of a shape, of the undeformed mesh, and the lowest that is known.

    Raises
    ------
    ValueError
        The rest energy is not above the best one.
    """
    if not rest > best:
        raise ValueError(f"the rest energy {rest} must be above the best energy {best}")
    return (energy - best) / (rest - best)


def energy_at_gap(wanted, rest, best):
    """Return the energy at which `gap` is the wanted one."""
    return best + wanted * (rest - best)


def seconds_to_energy(curve, energy):
    """Return when a run first reached an energy, or None if it never did.

    Parameters
    ----------
    curve : sequence of (seconds, energy)
        One entry per iteration, in their order.
    energy : float
    """
    return next((seconds for seconds, reached in curve if reached <= energy), None)


def median_seconds_to_energy(curves, energy):
    """Return the median over several runs, or None if one of them never reached the energy."""
    seconds = [seconds_to_energy(curve, energy) for curve in curves]
    return None if None in seconds else median(seconds)
