# SPDX-License-Identifier: GPL-3.0-or-later
"""What tables, plots and targets say about the runs of one case, from the figures of `race`.

A case is a dict as `race` or `one_size` returns it, with the ``best`` energy known so far, or None.
"""

from statistics import median

from .gap import energy_at_gap, gap, median_seconds_to_energy


def curves(case, program):
    """Return the curves of all runs of "ours" or "plain"."""
    return [run["curve"] for run in case[program]]


def lowest(case):
    """Return the lowest energy known, or seen in this case."""
    seen = [energy for curve in curves(case, "ours") for _, energy in curve]
    known = [case["best"]] if case["best"] is not None else []
    return min(seen + known)


def seconds_to_gap(case, program, wanted):
    """Return the median seconds to a gap, or None if a run ended before it."""
    energy = energy_at_gap(wanted, case["rest"], lowest(case))
    return median_seconds_to_energy(curves(case, program), energy)


def seconds_beyond_stop(case, wanted):
    """Return the seconds to a gap in the run that goes on beyond our own stop, or None."""
    energy = energy_at_gap(wanted, case["rest"], lowest(case))
    return median_seconds_to_energy([case["long"]["curve"]], energy) if case["long"] else None


def median_of(case, program, figure):
    """Return the median of a figure, such as "seconds", over the runs of a program."""
    return median(run[figure] for run in case[program])


def end_gap(case, program):
    """Return the gap of the shape at which a program ends, the median of its runs."""
    return gap(median_of(case, program, "energy"), case["rest"], lowest(case))


def ends_by_itself(case, program):
    """Return whether every run of a program came to its own stop."""
    return all(run["reason"] == "converged" for run in case[program])


def times_as_long(case):
    """Return how many times as long a run with the defaults takes as one with the paper's."""
    return median_of(case, "defaults", "seconds") / median_of(case, "paper", "seconds")


def ticks_per_second(case):
    """Return how often Live could show something new with the defaults."""
    return len(case["ticks"]) / sum(case["ticks"])


def seconds_to_end_of(case, peer):
    """Return the median seconds until ours is as low as a peer ends, or None."""
    return median_seconds_to_energy(curves(case, "ours"), median_of(case, peer, "energy"))


def milliseconds_per_iteration(case):
    """Return the median over our runs of the time after set-up per iteration."""
    return median(
        1000 * (run["seconds"] - run["setup"]) / run["iterations"] for run in case["ours"]
    )
