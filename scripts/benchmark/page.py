# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of results."""

from . import tables
from .fit import FIT_FROM, fit_of
from .plots import plot_gaps, plot_scaling
from .suite import PHASES_CUBENESS
from .ten_iterations import CUBENESS as TEN_CUBENESS
from .ten_iterations import ITERATIONS

GAPS_IMAGE, SCALING_IMAGE = "benchmark_gaps.png", "benchmark_scaling.png"


def write_page(results, folder):
    """Write ``benchmarks.md`` and its images into a folder; return the path of the page."""
    images = folder / "images"
    power, factor = fit_of(results["scaling"])
    if results["race"]:
        plot_gaps(results["race"], images / GAPS_IMAGE)
    if results["scaling"]:
        plot_scaling(results["scaling"], power, factor, FIT_FROM, images / SCALING_IMAGE)
    path = folder / "benchmarks.md"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("\n".join(page(results, power)) + "\n", encoding="utf-8")
    return path


def page(results, power):
    """Return the lines of the page; `power` is that of the fit, or None."""
    lines = _introduction(results)
    if results["ten"]:
        lines += _ten(results["ten"])
    if results["race"]:
        lines += _race(results["race"])
    if results["phases"]:
        lines += _phases(results["phases"])
    if results["scaling"]:
        lines += _scaling(results["scaling"], power)
    if results["startup"]:
        lines += _startup(results["startup"])
    return lines


def _introduction(results):
    return f"""\
# Benchmarks

Written by `make bench`; `make bench-quick` measures a part of it in less than two minutes and
writes to `build/bench`. `CUBIC_CRAFT_MESHES=folder` tells where the meshes are; without them, bumpy
spheres take their place. All programs run in turn on the same machine; figures are medians of
{results["runs"]} runs, of one where a run takes long (peers from 10,000 vertices on, sizes from
50,000 on). On another machine or a busy one the seconds change more than their ratios.

{results["machine"]}

Unless a table says otherwise, times begin with the arrays of the mesh in memory and hold all set-up.
Python, the libraries and the compiled kernels are loaded before; see the last table for these.""".split(
        "\n"
    )


def _ten(results):
    text = f"""\

## Ten iterations

{ITERATIONS} outer iterations from the mesh file to the result: reading the file and set-up are counted,
the kernels are loaded already. Cubeness {TEN_CUBENESS}. The columns of the paper are the figures
published in Table 1 of "CubicCraft: A Mesh Stylization Tool", taken on other hardware (NVIDIA RTX
3050 Ti; AMD R9 5900HS with the program of Liu and Jacobson), not on this machine. After ten
iterations no program has converged: this says how fast iterations are, not how soon a shape is done.
"""
    return [*text.split("\n"), *tables.ten_iterations(results)]


def _race(cases):
    first = """\

## To the best shape

The gap of a shape is (E - best) / (rest - best): E is its energy in the unit box, with the rotations
that fit it best; rest is that of the undeformed mesh; best is the lowest that any run of any program
has ever reached (`scripts/benchmark/best_energies.json`; `python scripts/benchmark --find-best`
looks for lower ones). All programs are judged by the same function. A time in brackets is that of
one run that goes on beyond our own stop; a dash, that the gap was not reached.
"""
    plot = f"""\

![Gap over time](images/{GAPS_IMAGE})

The plot shows one run of each program. Where a curve ends, the program stops by itself, except that
the plain iteration is left at a gap of 1 %, after 400 iterations or after 30 seconds.

### Beside the plain iteration

The same solver without acceleration (`is_accelerated=False`), left as said above. "Times sooner
there" is how many times sooner our solver is as low as the plain one is when it is left.
"""
    peer = """\

### Beside PyMeshLab

PyMeshLab's filter `apply_coord_cubic_stylization` with its default stop. "Ours as low" is when our
solver reaches the energy that PyMeshLab ends with; "times faster" compares both at their own stop.
The meshes that are missing here take PyMeshLab many minutes.
"""
    lines = [*first.split("\n"), *tables.gaps(cases), *plot.split("\n"), *tables.plain(cases)]
    if any(case["pymeshlab"] for case in cases):
        lines += [*peer.split("\n"), *tables.pymeshlab(cases)]
    return lines


def _phases(results):
    text = f"""\

## Where the time goes, and memory

One run to our own stop at cubeness {PHASES_CUBENESS}, in a process of its own. Set-up in seconds, then milliseconds
of each phase per iteration. Peak memory is that of the whole process; of it for the run is what it
takes above Python, the libraries and the kernels.
"""
    return [*text.split("\n"), *tables.phases(results)]


def _scaling(cases, power):
    fit = "" if power is None else f" Fitted from 10,000 vertices on, it grows as vertices^{power:.2f}."
    text = f"""\

## Time over size

The {cases[0]["mesh"]}, simplified or subdivided, at cubeness {cases[0]["cubeness"]}; each size in a process of its own.
{fit}

![Time over size](images/{SCALING_IMAGE})
"""
    return [*text.split("\n"), *tables.scaling(cases)]


def _startup(programs):
    text = """\

## From start to first result

Fresh processes, with the files in the system's cache and the compiled kernels on disk.
"""
    return [*text.split("\n"), *tables.startup(programs)]
