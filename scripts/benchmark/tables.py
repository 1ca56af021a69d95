# SPDX-License-Identifier: GPL-3.0-or-later
"""Rows {heading: value} of the tables of the page, most of one case, and their Markdown."""

from statistics import median

from .cores import serial_share
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

_SETUP_PHASES = ("rest mesh", "factorization")
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
        seconds, beyond = (seconds_to_gap(case, program, gap) for program in ("ours", "long"))
        is_beyond = seconds is None and beyond is not None
        row[f"to gap {100 * gap:g} %, s"] = f"({beyond:.3g})" if is_beyond else seconds
    return row | _end(case, "ours", "to our stop") | {"of it set-up, s": _setup(case, "ours")}


def plain(case):
    """Return the plain iteration beside ours."""
    row = _case(case)
    for gap in GAPS[:2]:
        theirs, ours = (seconds_to_gap(case, program, gap) for program in ("plain", "ours"))
        row[f"plain to gap {100 * gap:g} %, s"] = theirs
        row[f"times faster to {100 * gap:g} %"] = _ratio(theirs, ours)
    end = median_of(case, "plain", "seconds")
    sooner = {"times sooner there": _ratio(end, seconds_to_end_of(case, "plain"))}
    return row | _end(case, "plain", "plain left at") | sooner


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


def phases(result):
    """Return the phases of set-up and of one iteration, and memory."""
    setup, iteration = result["setup"], result["iteration"]
    other = sum(seconds for phase, seconds in setup.items() if phase not in _SETUP_PHASES)
    return (
        _case(result)
        | {f"{phase}, s": setup[phase] for phase in _SETUP_PHASES}
        | {"other set-up, s": max(other, 0.0)}
        | {f"{phase}, ms": iteration[phase] for phase in _PHASES}
        | _memory(result)
    )


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
    has_earlier = bool(case["earlier"])
    return row | {
        "of it finding links, s": median_of(case, "defaults", "links"),
        "times as long": times_as_long(case),
        "prototype: to our stop, s": median_of(case, "earlier", "seconds") if has_earlier else None,
        "times as long as the prototype": (
            times_as_long(case, beside="earlier") if has_earlier else None
        ),
        "ticks per second": ticks_per_second(case),
    }


def gaps_of_defaults(cases):
    """Give the times to a gap of either energy, where it has been measured.

    The prototype has that of the paper.
    """
    for case in cases:
        if "bounds" in case:
            row = _case(case)
            for name, program, energy in _ENERGIES:
                for gap in GAPS[:2]:
                    level = energy_at_gap(gap, *case["bounds"][energy])
                    seconds = median_seconds_to(case, program, level)
                    row[f"{name}: to gap {100 * gap:g} %, s"] = seconds
            yield row


def memory_of_defaults(cases):
    """Give the memory of both, where it has been measured."""
    for case in cases:
        for name, program in _BOTH.items():
            if "peak" in case[program][0]:
                yield _case(case) | {"settings": name} | _memory(case[program][0])


def without_taichi(case):
    """Return NumPy alone beside Taichi."""
    return _case(case) | {
        "with Taichi: to our stop, s": median_of(case, "taichi", "seconds"),
        "NumPy alone: to our stop, s": median_of(case, "numpy", "seconds"),
        "times as long": times_as_long(case, "numpy", "taichi"),
    }


def cores(case):
    """Return an iteration on one core and on all, and the shares that run on one core only."""
    one, every, count = case["one"], case["all"], case["cores"]
    total, at_all = sum(one.values()), sum(every.values())
    row = _case(case) | {"on 1 core, ms": total, f"on {count} cores, ms": at_all}
    row["not parallel, %"] = 100 * serial_share(total, at_all, count)
    for phase in _PHASES:
        row[f"{phase}, % of the time on {count} cores"] = 100 * every[phase] / at_all
        row[f"of it not parallel, % ({phase})"] = 100 * serial_share(
            one[phase], every[phase], count
        )
    return row


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


def first_clicks(results):
    """Give how long the first click takes after what is loaded while the panel is seen."""
    names = {"never": "never before on this machine", "again": "after a restart of Blender"}
    for programs in results:
        for name, runs in programs["clicks"].items():
            loaded, longest, click = (
                median(run[key] for run in runs) for key in ("ahead", "longest", "click")
            )
            yield {
                "the first Cubify of the monkey": names[name],
                "loaded ahead, s": loaded,
                "of it the longest piece, s": longest,
                "the click, s": click,
            }


_BOTH = {"as in the paper": "paper", "defaults": "defaults"}
_ENERGIES = (
    *((name, program, program) for name, program in _BOTH.items()),
    ("prototype", "earlier", "paper"),
)
"""what a program is called, which it is, and whose energy it lowers"""


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
