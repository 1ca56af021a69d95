# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables of the page, in Markdown."""

from statistics import median

from . import summary
from .gap import GAPS
from .ten_iterations import PAPER_SECONDS

NONE = "-"
"""where there is nothing to show"""
MEBIBYTE = 1024.0**2


def table(headings, rows):
    """Return a table in Markdown."""
    lines = [headings, ["---"] * len(headings), *rows]
    return "\n".join(f"| {' | '.join(map(str, line))} |" for line in lines)


def seconds(value):
    """Return seconds with as many digits as mean something."""
    if value is None:
        return NONE
    return f"{value:.2f} s" if value < 10 else f"{value:.1f} s" if value < 100 else f"{value:.0f} s"


def percent(value):
    """Return a gap as per cent, of two digits."""
    return f"{100 * value:.2g} %"


def times(numerator, denominator):
    """Return how many times one is the other, or the dash if either is unknown."""
    if numerator is None or denominator is None:
        return NONE
    ratio = numerator / denominator
    return f"{ratio:.1f}" if ratio < 10 else f"{ratio:,.0f}"


def ten_iterations(results):
    """Return the table of ten iterations beside the paper's."""
    rows = []
    for result in results:
        ours = median(result["seconds"])
        gpu, cpu = PAPER_SECONDS.get(result["mesh"], (None, None))
        rows.append(
            [result["mesh"], f"{result['vertices']:,}", seconds(median(result["reading"]))]
            + [seconds(ours), seconds(gpu), seconds(cpu), times(gpu, ours), times(cpu, ours)]
        )
    return table(
        ["mesh", "vertices", "reading the file", "CubicCraft", "paper, GPU", "paper, CPU"]
        + ["times the paper's GPU", "times the paper's CPU"],
        rows,
    )


def gaps(cases):
    """Return the table of our times to the gaps and to our own stop."""
    rows = []
    for case in cases:
        cells = []
        for wanted in GAPS:
            reached = summary.seconds_to_gap(case, "ours", wanted)
            beyond = summary.seconds_beyond_stop(case, wanted)
            is_beyond = reached is None and beyond is not None
            cells.append(f"({seconds(beyond)})" if is_beyond else seconds(reached))
        stop = seconds(summary.median_of(case, "ours", "seconds"))
        iterations = round(summary.median_of(case, "ours", "iterations"))
        cells.append(f"{stop} ({iterations}{_unless_own_stop(case, 'ours')})")
        cells.append(percent(summary.end_gap(case, "ours")))
        cells.append(seconds(summary.median_of(case, "ours", "setup")))
        rows.append(_case_cells(case) + cells)
    headings = [f"to gap {percent(wanted)}" for wanted in GAPS]
    return table(
        [*_CASE_HEADINGS, *headings, "to our stop (iterations)", "gap there", "of it set-up"], rows
    )


def plain(cases):
    """Return the table of the plain iteration beside ours."""
    rows = []
    for case in cases:
        if not case["plain"]:
            continue
        cells = []
        for wanted in GAPS[:2]:
            theirs = summary.seconds_to_gap(case, "plain", wanted)
            cells.append(seconds(theirs))
            cells.append(times(theirs, summary.seconds_to_gap(case, "ours", wanted)))
        end = seconds(summary.median_of(case, "plain", "seconds"))
        iterations = round(summary.median_of(case, "plain", "iterations"))
        cells.append(f"{end} ({iterations}{_unless_own_stop(case, 'plain')})")
        cells.append(percent(summary.end_gap(case, "plain")))
        sooner = summary.seconds_to_end_of(case, "plain")
        cells.append(times(summary.median_of(case, "plain", "seconds"), sooner))
        rows.append(_case_cells(case) + cells)
    headings = []
    for wanted in GAPS[:2]:
        headings += [f"plain to gap {percent(wanted)}", "times faster"]
    return table(
        [
            *_CASE_HEADINGS,
            *headings,
            "plain left at (iterations)",
            "gap there",
            "times sooner there",
        ],
        rows,
    )


def pymeshlab(cases):
    """Return the table of PyMeshLab beside ours."""
    rows = []
    for case in cases:
        if not case["pymeshlab"]:
            continue
        end = summary.median_of(case, "pymeshlab", "seconds")
        there = summary.seconds_to_end_of(case, "pymeshlab")
        stop = summary.median_of(case, "ours", "seconds")
        rows.append(
            _case_cells(case)
            + [seconds(end), f"{summary.median_of(case, 'pymeshlab', 'energy'):.5f}"]
            + [percent(summary.end_gap(case, "pymeshlab")), seconds(there), times(end, there)]
            + [seconds(stop), f"{summary.median_of(case, 'ours', 'energy'):.5f}"]
            + [times(end, stop)]
        )
    return table(
        [*_CASE_HEADINGS, "PyMeshLab ends", "energy", "gap", "ours as low", "times sooner"]
        + ["ours at its stop", "energy", "times faster"],
        rows,
    )


def phases(results):
    """Return the table of the phases of set-up and of one iteration, and of memory."""
    rows = []
    for result in results:
        setup, iteration = result["setup"], result["iteration"]
        other = sum(s for phase, s in setup.items() if phase not in _SETUP_PHASES)
        rows.append(
            _case_cells(result)
            + [seconds(setup.get(phase)) for phase in _SETUP_PHASES]
            + [seconds(max(other, 0.0))]
            + [f"{iteration[phase]:.1f}" if phase in iteration else NONE for phase in _PHASES]
            + _memory_cells(result)
        )
    headings = [*_SETUP_PHASES, "other set-up", *(f"{phase}, ms" for phase in _PHASES)]
    return table([*_CASE_HEADINGS, *headings, *_MEMORY_HEADINGS], rows)


def scaling(cases):
    """Return the table of sizes."""
    rows = []
    for case in cases:
        iterations = round(summary.median_of(case, "ours", "iterations"))
        rows.append(
            [f"{case['vertices']:,}", seconds(summary.median_of(case, "ours", "setup"))]
            + [f"{summary.milliseconds_per_iteration(case):.1f}"]
            + [seconds(summary.seconds_to_gap(case, "ours", 0.01)) if case["best"] else NONE]
            + [seconds(summary.median_of(case, "ours", "seconds"))]
            + [f"{iterations}{_unless_own_stop(case, 'ours')}"]
            + [percent(summary.end_gap(case, "ours")) if case["best"] else NONE]
            + _memory_cells(case)
        )
    return table(
        ["vertices", "set-up", "ms per iteration", "to gap 1 %", "to our stop", "iterations"]
        + ["gap there", *_MEMORY_HEADINGS],
        rows,
    )


def defaults(cases):
    """Return the table of the defaults beside the paper's settings."""
    rows = []
    for case in cases:
        cells = [f"{round(summary.median_of(case, 'defaults', 'solved')):,}"]
        for program in ("paper", "defaults"):
            stop = seconds(summary.median_of(case, program, "seconds"))
            iterations = round(summary.median_of(case, program, "iterations"))
            cells.append(f"{stop} ({iterations}{_unless_own_stop(case, program)})")
            cells.append(seconds(summary.median_of(case, program, "setup")))
        cells.append(seconds(summary.median_of(case, "defaults", "links")))
        cells.append(f"{summary.times_as_long(case):.2f}")
        cells.append(f"{summary.ticks_per_second(case):.0f}" if case["ticks"] else NONE)
        rows.append(_case_cells(case) + cells)
    both = []
    for name in ("as in the paper", "defaults"):
        both += [f"{name}: to our stop (iterations)", "of it set-up"]
    return table(
        [*_CASE_HEADINGS, "solved with the defaults", *both, "of it finding links"]
        + ["times as long", "ticks per second"],
        rows,
    )


def memory_of_defaults(cases):
    """Return the table of the memory with the defaults beside the paper's settings."""
    rows = [
        _case_cells(case)
        + [cell for name in ("paper", "defaults") for cell in _memory_cells(case[name][0])]
        for case in cases
    ]
    headings = [
        f"{name}: {heading}"
        for name in ("as in the paper", "defaults")
        for heading in _MEMORY_HEADINGS
    ]
    return table([*_CASE_HEADINGS, *headings], rows)


def startup(programs):
    """Return the table of the time to the first result."""
    monkey, bpy, solver = (median(programs[name]) for name in ("monkey", "bpy", "solver"))
    return table(
        ["from the start of the process to", "median"],
        [
            ["the first Cubify of the monkey in Blender, with the defaults", seconds(monkey)],
            ["Blender imported, and nothing else", seconds(bpy)],
            ["difference: what CubicCraft adds", seconds(monkey - bpy)],
            ["the first result of the solver without Blender, as in the paper", seconds(solver)],
        ],
    )


_CASE_HEADINGS = ["mesh", "vertices", "cubeness"]
_MEMORY_HEADINGS = ["peak memory", "for the run"]
_SETUP_PHASES = ("rest mesh", "factorisation")
_PHASES = ("local step", "right-hand side", "solve", "remainder")


def _case_cells(case):
    return [case["mesh"], f"{case['vertices']:,}", case["cubeness"]]


def _memory_cells(case):
    return [f"{case[name] / MEBIBYTE:,.0f} MiB" for name in ("peak", "above")]


def _unless_own_stop(case, program):
    return "" if summary.ends_by_itself(case, program) else ", cut off"


def targets(reached):
    """Return the table of a list of Target."""
    rows = [
        [target.text, target.shown_value, target.shown_bound, "yes" if target.is_met else "**no**"]
        for target in reached
    ]
    return table(["target", "measured", "bound", "met"], rows)
