# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of results: tables and what their columns are. What they mean is told in `EXPLAINED`."""

from . import suite, tables
from .solver_alone import CUBENESS, ITERATIONS
from .summary import FIT_FROM, fit, median_of, milliseconds_per_iteration
from .targets import targets

EXPLAINED = "benchmarks_explained.md"
GAPS_IMAGE, SCALING_IMAGE = "images/benchmark_gaps.png", "images/benchmark_scaling.png"


def page(results):
    """Return the text of the page, in Markdown; what has not been measured has no section."""
    text = f"""\
# Benchmarks

Written by `make bench`, side by side on one machine. [What the tables mean, and what bounds the
times]({EXPLAINED}) has a page of its own. Rows are *as in the paper* unless they name the
defaults. Runs of each program: {results["runs"]}, of which the median counts; one of PyMeshLab
from {suite.LARGE:,} vertices on, and in the scaling run from {suite.LARGE_SCALING:,} on.

{results["machine"]}
"""
    for heading, caption, rows in _sections(results):
        if rows:
            text += f"\n{heading}\n\n{caption}\n\n{tables.markdown(rows)}\n"
    return text


def _sections(results):
    """Give heading, caption and rows of each."""
    race_results = results["race"]
    by_pymeshlab = [case for case in race_results if case["pymeshlab"]]
    made = [
        ("## Ten iterations", _TEN, map(tables.ten_iterations, results["ten"])),
        ("## To the best shape", _GAPS, map(tables.gaps, race_results)),
        ("### Beside PyMeshLab", _PYMESHLAB, map(tables.pymeshlab, by_pymeshlab)),
        ("## Time over size", _scaling_caption(results), map(tables.scaling, results["scaling"])),
        ("## With the defaults", _DEFAULTS, map(tables.defaults, results["defaults"])),
        ("### To the shape of the defaults", _LINKED, map(tables.linked, results["defaults"])),
        ("## Targets", _TARGETS, targets(results)),
    ]
    return [(heading, caption, list(rows)) for heading, caption, rows in made]


_TEN = f"""\
{ITERATIONS} outer iterations at cubeness {CUBENESS}, as in the paper, with all set-up. The columns
of the paper are its Table 1, from other hardware: an NVIDIA RTX 3050 Ti, and for the CPU the
program of Liu and Jacobson on an AMD R9 5900HS."""
_GAPS = f"""\
As in the paper. A dash: not reached before our own stop.

![Gap over time]({GAPS_IMAGE})"""
_PYMESHLAB = """\
PyMeshLab's filter `apply_coord_cubic_stylization` with its default stop; ours as in the paper.
"Ours as low" is when ours reaches the energy at which PyMeshLab ends; "times faster" compares both
at their own stop. Cases that are not listed would take it minutes."""
_DEFAULTS = """\
The artist's defaults beside the paper's settings, each to its own stop. They are judged by the
geometric mean over all meshes of more than 2,000 vertices, the large ones at three values of
cubeness: how many iterations a single case takes is to a good part luck. "Ticks per second" is how
often Live could show a coarse mesh anew, without what Blender takes to draw."""
_LINKED = """\
The defaults have an energy of their own, with links. Gaps of either energy, between rest and the
lowest that any of the runs has seen, as in the paper and with the defaults."""
_TARGETS = "What was to be reached, and whether this run has."


def _scaling_caption(results):
    cases = results["scaling"]
    setup = fit(cases, lambda case: median_of(case, "ours", "setup"))[0]
    iteration = fit(cases, milliseconds_per_iteration)[0]
    power = fit(cases)[0]
    text = "One shape, simplified or subdivided to each size, as in the paper.\n"
    if power is not None:
        text += (
            f"From {FIT_FROM:,} vertices on, the time to gap 1 % grows as vertices^{power:.2f},\n"
            f"set-up as vertices^{setup:.2f} and one iteration as vertices^{iteration:.2f}.\n"
        )
    return f"{text}\n![Time over size]({SCALING_IMAGE})"
