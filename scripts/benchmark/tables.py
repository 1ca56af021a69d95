# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables of the page: each a list of rows {heading: value}, and how they look in Markdown."""

from statistics import median

from .solver_alone import PAPER_SECONDS
from .summary import (
    GAPS,
    gap_of,
    median_of,
    milliseconds_per_iteration,
    seconds_to_end_of,
    seconds_to_fitted_gap,
    seconds_to_gap,
    ticks_per_second,
    times_as_long,
)

_SETUP_PHASES = ("rest mesh", "factorisation")
_PHASES = ("local step", "right-hand side", "solve", "remainder")


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


def ten_iterations(results):
    """Give ten iterations beside the paper's."""
    for result in results:
        ours = median(result["seconds"])
        gpu, cpu = PAPER_SECONDS.get(result["mesh"], (None, None))
        yield {
            "mesh": result["mesh"],
            "vertices": result["vertices"],
            "reading the file, s": median(result["reading"]),
            "CubicCraft, s": ours,
            "paper, GPU, s": gpu,
            "paper, CPU, s": cpu,
            "times the paper's GPU": _ratio(gpu, ours),
            "times the paper's CPU": _ratio(cpu, ours),
        }


def gaps(cases):
    """Give our times to the gaps and to our own stop."""
    for case in cases:
        row = _case(case)
        for gap in GAPS:
            seconds = seconds_to_gap(case, "ours", gap)
            beyond = seconds_to_gap(case, "long", gap)
            is_beyond = seconds is None and beyond is not None
            row[f"to gap {100 * gap:g} %, s"] = f"({beyond:.3g})" if is_beyond else seconds
        row |= _end(case, "ours", "to our stop")
        yield row | {
            "gap there, %": _end_gap(case, "ours"),
            "of it set-up, s": _setup(case, "ours"),
        }


def plain(cases):
    """Give the plain iteration beside ours."""
    for case in cases:
        row = _case(case)
        for gap in GAPS[:2]:
            theirs = seconds_to_gap(case, "plain", gap)
            row[f"plain to gap {100 * gap:g} %, s"] = theirs
            row[f"times faster to {100 * gap:g} %"] = _ratio(
                theirs, seconds_to_gap(case, "ours", gap)
            )
        end = median_of(case, "plain", "seconds")
        row |= _end(case, "plain", "plain left at")
        row["gap there, %"] = _end_gap(case, "plain")
        yield row | {"times sooner there": _ratio(end, seconds_to_end_of(case, "plain"))}


def pymeshlab(cases):
    """Give PyMeshLab beside ours."""
    for case in cases:
        end, stop = (median_of(case, name, "seconds") for name in ("pymeshlab", "ours"))
        there = seconds_to_end_of(case, "pymeshlab")
        yield _case(case) | {
            "PyMeshLab ends, s": end,
            "its energy": f"{median_of(case, 'pymeshlab', 'energy'):.5f}",
            "its gap, %": _end_gap(case, "pymeshlab"),
            "ours as low, s": there,
            "times sooner": _ratio(end, there),
            "ours at its stop, s": stop,
            "our energy": f"{median_of(case, 'ours', 'energy'):.5f}",
            "times faster": _ratio(end, stop),
        }


def phases(results):
    """Give the phases of set-up and of one iteration, and memory."""
    for result in results:
        setup, iteration = result["setup"], result["iteration"]
        other = sum(seconds for phase, seconds in setup.items() if phase not in _SETUP_PHASES)
        yield (
            _case(result)
            | {f"{phase}, s": setup[phase] for phase in _SETUP_PHASES}
            | {"other set-up, s": max(other, 0.0)}
            | {f"{phase}, ms": iteration[phase] for phase in _PHASES}
            | _memory(result)
        )


def scaling(cases):
    """Give one shape in many sizes."""
    for case in cases:
        yield (
            {"vertices": case["vertices"], "set-up, s": _setup(case, "ours")}
            | {"ms per iteration": milliseconds_per_iteration(case)}
            | {"to gap 1 %, s": seconds_to_fitted_gap(case)}
            | _end(case, "ours", "to our stop")
            | {"gap there, %": None if case["best"] is None else _end_gap(case, "ours")}
            | _memory(case)
        )


def defaults(cases):
    """Give the defaults beside the paper's settings."""
    for case in cases:
        row = _case(case) | {"solved with the defaults": median_of(case, "defaults", "solved")}
        for name, program in _BOTH.items():
            row |= _end(case, program, f"{name}: to our stop")
            row[f"{name}: set-up, s"] = _setup(case, program)
        yield row | {
            "of it finding links, s": median_of(case, "defaults", "links"),
            "times as long": times_as_long(case),
            "ticks per second": ticks_per_second(case),
        }


def memory_of_defaults(cases):
    """Give the memory of both, where it has been measured."""
    for case in cases:
        for name, program in _BOTH.items():
            if "peak" in case[program][0]:
                yield _case(case) | {"settings": name} | _memory(case[program][0])


def startup(results):
    """Give the time from the start of a process to the first result."""
    for programs in results:
        monkey, bpy, solver = (median(programs[name]) for name in ("monkey", "bpy", "solver"))
        for what, seconds in {
            "the first Cubify of the monkey in Blender, with the defaults": monkey,
            "Blender imported, and nothing else": bpy,
            "difference: what CubicCraft adds": monkey - bpy,
            "the first result of the solver without Blender, as in the paper": solver,
        }.items():
            yield {"from the start of the process to": what, "median, s": seconds}


_BOTH = {"as in the paper": "paper", "defaults": "defaults"}


def _case(case):
    return {"mesh": case["mesh"], "vertices": case["vertices"], "cubeness": case["cubeness"]}


def _end(case, program, what):
    """Return when a program ends and after how many iterations, and whether by its own stop."""
    iterations = f"{median_of(case, program, 'iterations'):.0f}"
    if any(run["reason"] != "converged" for run in case[program]):
        iterations += ", cut off"
    return {f"{what}, s": median_of(case, program, "seconds"), f"{what}, iterations": iterations}


def _end_gap(case, program):
    """Return the gap in per cent of the shape at which a program ends."""
    return 100 * gap_of(case, median_of(case, program, "energy"))


def _setup(case, program):
    return median_of(case, program, "setup")


def _memory(figures):
    names = {"peak memory, MiB": "peak", "for the run, MiB": "above"}
    return {heading: round(figures[name] / 1024**2) for heading, name in names.items()}


def _ratio(numerator, denominator):
    return None if None in (numerator, denominator) else numerator / denominator
