# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of results: tables and what their columns are. What they mean is told in `EXPLAINED`."""

from statistics import geometric_mean, median

EXPLAINED = "benchmarks_explained.md"
JUDGED_FROM = 2000
"""vertices of the meshes over which the mean cost of the defaults is taken"""

PYMESHLAB = """\
PyMeshLab's filter `apply_coord_cubic_stylization` with its default stop; ours as in the paper.
"Ours as low" is when ours reaches the energy at which PyMeshLab ends; "times faster" compares both
at their own stop."""
DEFAULTS = "The artist's defaults beside the paper's settings, each to its own stop."


def page(results):
    """Return the text of the page, in Markdown; what has not been measured has no section."""
    text = f"""\
# Benchmarks

Written by `make bench`, side by side on one machine. [What the tables mean, and what bounds the
times]({EXPLAINED}) has a page of its own. Rows are *as in the paper* unless they name the
defaults. Runs of each program: {results["runs"]}, of which the median counts.

{results["machine"]}
"""
    for part, (heading, caption, row_of) in _SECTIONS.items():
        if rows := list(map(row_of, results[part])):
            end = _mean(results[part]) if part == "defaults" else ""
            text += f"\n## {heading}\n\n{caption}{end}\n\n{markdown(rows)}\n"
    return text


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


def _pymeshlab(case):
    end, energy = (median_of(case, "pymeshlab", name) for name in ("seconds", "energy"))
    stop, there = median_of(case, "ours", "seconds"), seconds_to(case["ours"], energy)
    return _head(case) | {
        "PyMeshLab ends, s": end,
        "its energy": f"{energy:.5f}",
        "ours as low, s": there,
        "times sooner": _ratio(end, there),
        "ours at its stop, s": stop,
        "our energy": f"{median_of(case, 'ours', 'energy'):.5f}",
        "times faster": _ratio(end, stop),
    }


def _defaults(case):
    row = _head(case) | {"solved with the defaults": median_of(case, "defaults", "solved")}
    for name, program in (("as in the paper", "paper"), ("defaults", "defaults")):
        row |= _end(case, program, f"{name}: to our stop")
        row[f"{name}: set-up, s"] = median_of(case, program, "setup")
    return row | {"times as long": _times_as_long(case)}


def _mean(cases):
    ratios = [_times_as_long(case) for case in cases if case["vertices"] > JUDGED_FROM]
    if not ratios:
        return ""
    mean = geometric_mean(ratios)
    return f"\nOver all meshes of more than {JUDGED_FROM:,} vertices: {mean:.2f} times as long."


_SECTIONS = {
    "pymeshlab": ("Beside PyMeshLab", PYMESHLAB, _pymeshlab),
    "defaults": ("With the defaults", DEFAULTS, _defaults),
}


def median_of(case, program, figure):
    """Return the median of a figure, such as "seconds", over the runs of a program."""
    return median(run[figure] for run in case[program])


def seconds_to(runs, energy):
    """Return the median seconds until runs first reach an energy; None if one never does."""
    found = [next((s for s, reached in run["curve"] if reached <= energy), None) for run in runs]
    return None if None in found else median(found)


def _times_as_long(case):
    return median_of(case, "defaults", "seconds") / median_of(case, "paper", "seconds")


def _head(case):
    return {"mesh": case["mesh"], "vertices": case["vertices"], "cubeness": case["cubeness"]}


def _end(case, program, what):
    iterations = f"{median_of(case, program, 'iterations'):.0f}"
    if any(run["reason"] != "converged" for run in case[program]):
        iterations += ", cut off"
    return {f"{what}, s": median_of(case, program, "seconds"), f"{what}, iterations": iterations}


def _ratio(numerator, denominator):
    return None if None in (numerator, denominator) else numerator / denominator
