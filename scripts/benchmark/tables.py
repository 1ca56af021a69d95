# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows {heading: value} of the tables of the page, most of one case, and their Markdown."""

from statistics import median

from .solver_alone import PAPER_SECONDS
from .summary import (
    GAPS,
    energy_at_gap,
    gap_of,
    median_of,
    median_seconds_to,
    milliseconds_per_iteration,
    seconds_to_end_of,
    seconds_to_fitted_gap,
    seconds_to_gap,
    ticks_per_second,
    times_as_long,
)


def markdown(rows):
    """Return rows as a table: three digits of what is measured, and a dash for None."""
    lines = [rows[0], ["---"] * len(rows[0]), *(map(_cell, row.values()) for row in rows)]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def _cell(value):
    if value is None:
        return "-"
    if isinstance(value, str):
        return value
    return f"{value:.3g}" if abs(value) < 1000 and isinstance(value, float) else f"{value:,.0f}"


def ten_iterations(result):
    """Return ten iterations of a mesh beside the paper's."""
    ours = median(result["seconds"])
    gpu, cpu = PAPER_SECONDS.get(result["mesh"], (None, None))
    return {
        "mesh": result["mesh"],
        "vertices": result["vertices"],
        "reading the file, s": median(result["reading"]),
        "CubicCraft, s": ours,
        "paper, GPU, s": gpu,
        "paper, CPU, s": cpu,
        "times the paper's GPU": _ratio(gpu, ours),
        "times the paper's CPU": _ratio(cpu, ours),
    }


def gaps(case):
    """Return our times to the gaps and to our own stop."""
    row = _case(case)
    for gap in GAPS:
        row[f"to gap {100 * gap:g} %, s"] = seconds_to_gap(case, "ours", gap)
    return row | _end(case, "ours", "to our stop") | {"of it set-up, s": _setup(case, "ours")}


def pymeshlab(case):
    """Return PyMeshLab beside ours."""
    end, stop = (median_of(case, name, "seconds") for name in ("pymeshlab", "ours"))
    there = seconds_to_end_of(case, "pymeshlab")
    return _case(case) | {
        "PyMeshLab ends, s": end,
        "its energy": f"{median_of(case, 'pymeshlab', 'energy'):.5f}",
        "its gap, %": _end_gap(case, "pymeshlab"),
        "ours as low, s": there,
        "times sooner": _ratio(end, there),
        "ours at its stop, s": stop,
        "our energy": f"{median_of(case, 'ours', 'energy'):.5f}",
        "times faster": _ratio(end, stop),
    }


def scaling(case):
    """Return one size of a shape."""
    return (
        {"vertices": case["vertices"], "set-up, s": _setup(case, "ours")}
        | {"ms per iteration": milliseconds_per_iteration(case)}
        | {"to gap 1 %, s": seconds_to_fitted_gap(case)}
        | _end(case, "ours", "to our stop")
        | _memory(case)
    )


def defaults(case):
    """Return the defaults beside the paper's settings."""
    row = _case(case) | {"solved with the defaults": median_of(case, "defaults", "solved")}
    for name, program in _BOTH.items():
        row |= _end(case, program, f"{name}: to our stop")
        row[f"{name}: set-up, s"] = _setup(case, program)
    return row | {"times as long": times_as_long(case), "ticks per second": ticks_per_second(case)}


def linked(case):
    """Return the times to a gap of either energy."""
    row = _case(case)
    for name, program in _BOTH.items():
        for gap in GAPS[:2]:
            level = energy_at_gap(gap, *case["bounds"][program])
            seconds = median_seconds_to(case, program, level)
            row[f"{name}: to gap {100 * gap:g} %, s"] = seconds
    return row


_BOTH = {"as in the paper": "paper", "defaults": "defaults"}


def _case(case):
    return {"mesh": case["mesh"], "vertices": case["vertices"], "cubeness": case["cubeness"]}


def _end(case, program, what):
    """Return when and how far from the best a program ends, and whether by its own stop."""
    iterations = f"{median_of(case, program, 'iterations'):.0f}"
    if any(run["reason"] != "converged" for run in case[program]):
        iterations += ", cut off"
    end = {f"{what}, s": median_of(case, program, "seconds"), f"{what}, iterations": iterations}
    is_judged = "best" in case  # the energies with the defaults are others
    return end | ({"gap there, %": _end_gap(case, program)} if is_judged else {})


def _end_gap(case, program):
    """Return the gap in per cent of the shape at which a program ends, or None if not known."""
    return None if case["best"] is None else 100 * gap_of(case, median_of(case, program, "energy"))


def _setup(case, program):
    return median_of(case, program, "setup")


def _memory(figures):
    names = {"peak memory, MiB": "peak", "for the run, MiB": "above"}
    return {heading: round(figures[name] / 1024**2) for heading, name in names.items()}


def _ratio(numerator, denominator):
    return None if None in (numerator, denominator) else numerator / denominator
