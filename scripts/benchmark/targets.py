# SPDX-License-Identifier: GPL-3.0-or-later
"""What the benchmark is to show, and whether it does, in rows as in `tables`."""

from statistics import geometric_mean, median

from .solver_alone import PAPER_SECONDS
from .summary import (
    fit,
    median_of,
    seconds_to_end_of,
    seconds_to_fitted_gap,
    seconds_to_gap,
    ticks_per_second,
    times_as_long,
    times_as_long_to,
)

MILLION = range(900_000, 1_100_001)
"""vertices of the largest mesh"""
FIFTY_THOUSAND = range(40_000, 60_001)
"""vertices of the meshes that the defaults are judged by"""
GAP_BOUNDS = {
    ("horse", 0.4): {0.05: 1.2, 0.01: 2.5},
    ("armadillo", 0.2): {0.05: 2.0, 0.01: 5.0},
    ("bunny", 0.2): {0.001: 0.3},
}
"""(mesh, cubeness): {gap: seconds}"""


def targets(results):
    """Return the rows of whatever has been measured."""
    return [
        *_to_gaps(results["race"]),
        *_beside_pymeshlab(results["race"]),
        *_beside_the_paper(results["ten"]),
        *_scaling(results["scaling"]),
        *_defaults(results["defaults"]),
    ]


def target(name, value, most=None, least=None):
    """Return the row of one bound on a value, which is None where it was never reached."""
    is_met = value is not None and (value <= most if least is None else value >= least)
    bound = f"at most {most:g}" if least is None else f"at least {least:g}"
    shown = "never" if value is None else f"{value:.2f}"
    return {"target": name, "measured": shown, "bound": bound, "met": "yes" if is_met else "**no**"}


def _to_gaps(cases):
    for case in cases:
        name = case["mesh"], case["cubeness"]
        for gap, bound in GAP_BOUNDS.get(name, {}).items():
            seconds = seconds_to_gap(case, "ours", gap)
            yield target(f"{name[0]} {name[1]}, seconds to gap {100 * gap:g} %", seconds, bound)


def _beside_pymeshlab(cases):
    for case in cases:
        name = case["mesh"], case["cubeness"]
        if case["pymeshlab"] and name == ("horse", 0.4):
            there = seconds_to_end_of(case, "pymeshlab")
            text, least = "horse 0.4, times sooner as low as PyMeshLab's end", 30
        elif case["pymeshlab"] and name == ("bunny", 0.2):
            there = seconds_to_gap(case, "ours", 0.001)
            text, least = "bunny 0.2, times sooner at gap 0.1 % than PyMeshLab ends", 10
        else:
            continue
        yield target(text, there and median_of(case, "pymeshlab", "seconds") / there, least=least)


def _beside_the_paper(results):
    for result in results:
        if result["mesh"] in PAPER_SECONDS:
            ratio = PAPER_SECONDS[result["mesh"]][0] / median(result["seconds"])
            text = f"{result['mesh']}, ten iterations, times ahead of the paper's GPU"
            yield target(text, ratio, least=10)


def _scaling(cases):
    for case in cases:
        if case["vertices"] in MILLION:
            yield target("1 M vertices, seconds to gap 1 %", seconds_to_fitted_gap(case), 60)
            yield target("1 M vertices, peak memory in GB", case["peak"] / 1e9, 4)
    if cases:
        yield target("exponent of time over size", fit(cases)[0], 1.15)


def _defaults(cases):
    judged = [case for case in cases if not case["ticks"]]
    if judged:
        name = "with the defaults, times as long as in the paper, over all meshes"
        yield target(f"{name}, to our stop", geometric_mean(map(times_as_long, judged)), 1.5)
        to_gap = [ratio for case in judged if (ratio := times_as_long_to(case, 0.01))]
        yield target(f"{name}, to gap 1 %", geometric_mean(to_gap) if to_gap else None, 1.5)
    for case in cases:
        if case["ticks"]:
            name = f"{case['mesh']}, with the defaults"
            seconds = median_of(case, "defaults", "seconds")
            yield target(f"{name}, seconds to our stop", seconds, 0.5)
            yield target(f"{name}, ticks of Live per second", ticks_per_second(case), least=10)
