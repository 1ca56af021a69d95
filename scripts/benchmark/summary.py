# SPDX-License-Identifier: GPL-3.0-or-later
"""What tables, plots and targets say about the runs of one case.

A case is a dict as `race` or `one_size` returns it, with the ``best`` energy known so far, or None.
"""

from statistics import median

import numpy as np

GAPS = (0.05, 0.01, 0.001)
"""the gaps whose times are reported"""
FIT_FROM, FIT_TO = 10_000, 1_100_000
"""vertices of the meshes that `fit` fits to"""


def energy_at_gap(gap, rest, best):
    """Return the energy so far from the best one: at 0 that itself, at 1 that of the rest shape."""
    return best + gap * (rest - best)


def gap_of(case, energy):
    """Return how far an energy is from the lowest one, the inverse of `energy_at_gap`."""
    best = lowest(case)
    if not case["rest"] > best:
        raise ValueError(f"the rest energy {case['rest']} must be above the best energy {best}")
    return (energy - best) / (case["rest"] - best)


def lowest(case):
    """Return the lowest energy known, or seen in this case."""
    seen = [energy for run in case["ours"] for _, energy in run["curve"]]
    return min(seen if case["best"] is None else [*seen, case["best"]])


def seconds_to_energy(curve, energy):
    """Return when a run first reached an energy, or None if it never did."""
    return next((seconds for seconds, reached in curve if reached <= energy), None)


def median_seconds_to(case, program, energy):
    """Return the median over the runs of a program; None without any, or if one never did."""
    seconds = [seconds_to_energy(run["curve"], energy) for run in case[program]]
    return None if None in seconds or not seconds else median(seconds)


def seconds_to_gap(case, program, gap):
    """Return the median seconds to a gap, or None if a run ended before it."""
    return median_seconds_to(case, program, energy_at_gap(gap, case["rest"], lowest(case)))


def seconds_to_end_of(case, peer):
    """Return the median seconds until ours is as low as a peer ends, or None."""
    return median_seconds_to(case, "ours", median_of(case, peer, "energy"))


def median_of(case, program, figure):
    """Return the median of a figure, such as "seconds", over the runs of a program."""
    return median(run[figure] for run in case[program])


def times_as_long(case):
    """Return how many times as long runs with the defaults take as those of the paper."""
    return median_of(case, "defaults", "seconds") / median_of(case, "paper", "seconds")


def times_as_long_to(case, gap):
    """Return the same up to a gap, each of its own energy; None where one ends before."""
    defaults, paper = (
        median_seconds_to(case, program, energy_at_gap(gap, *case["bounds"][program]))
        for program in ("defaults", "paper")
    )
    return defaults / paper if defaults and paper else None


def ticks_per_second(case):
    """Return how often Live could show something new with the defaults; None if not measured."""
    return len(case["ticks"]) / sum(case["ticks"]) if case["ticks"] else None


def milliseconds_per_iteration(case):
    """Return the median over our runs of the time after set-up per iteration."""
    return median(
        1000 * (run["seconds"] - run["setup"]) / run["iterations"] for run in case["ours"]
    )


def seconds_to_fitted_gap(case):
    """Return the seconds of one size to gap 1 %, or None where its best energy is not known."""
    return None if case["best"] is None else seconds_to_gap(case, "ours", 0.01)


def fit(cases, value=seconds_to_fitted_gap):
    """Fit value = factor * vertices ** power by least squares of the logarithms.

    Sizes where the value is None are left out; the result is None twice if fewer than two are left.
    """
    fitted = [case for case in cases if FIT_FROM <= case["vertices"] <= FIT_TO]
    measured = [(case["vertices"], value(case)) for case in fitted]
    points = [point for point in measured if point[1] is not None]
    if len(points) < 2:
        return None, None
    sizes, values = np.log(points).T
    power, logarithm = np.polyfit(sizes, values, 1)
    return float(power), float(np.exp(logarithm))
