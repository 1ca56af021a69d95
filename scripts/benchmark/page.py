# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of results."""

from . import summary, tables
from .fit import FIT_FROM, FITTED_GAP, fit_of
from .race import PLAIN_GAP, PLAIN_ITERATIONS, PLAIN_SECONDS
from .suite import COARSE, DEFAULTS_CUBENESS, LARGE, LARGE_SCALING, PHASES_CUBENESS
from .targets import FIFTY_THOUSAND, targets
from .ten_iterations import CUBENESS, ITERATIONS

GAPS_IMAGE, SCALING_IMAGE = "benchmark_gaps.png", "benchmark_scaling.png"


def page(results, power):
    """Return the paragraphs of the page; `power` is that of the fit, or None."""
    paragraphs = _introduction(results["runs"], results["machine"])
    if results["ten"]:
        paragraphs += _ten(results["ten"])
    if results["race"]:
        paragraphs += _race(results["race"])
    if results["phases"]:
        paragraphs += _phases(results["phases"])
    if results["scaling"]:
        paragraphs += _scaling(results["scaling"], power)
    if results["defaults"]:
        paragraphs += _defaults(results["defaults"])
    if results["startup"]:
        paragraphs += _startup(results["startup"])
    if reached := targets(results):
        paragraphs += [
            "## Targets",
            """\
What was to be reached, and whether this run has. As in the paper, but for the lines that name the
defaults, and the first result on the monkey, which is with the defaults, too.""",
        ]
        paragraphs.append(tables.targets(reached))
        if not all(target.is_met for target in reached):
            paragraphs.append("""\
What bounds those that are missed is told where they are measured: the factorisation and the
arithmetic of the local step (ten iterations, and the gaps of the horse: "Where the time goes"), and
how many iterations a larger mesh needs (the exponent: "Time over size"). Some are missed by less
than what the seconds of one machine change: in two runs on one day the horse came to a gap of 1 %
after 2.5 s and after 2.8 s, and ten iterations on the owl were 8.8 and 9.7 times ahead.""")
    return paragraphs


def _introduction(runs, machine):
    how_often = (
        f"Figures are medians of {runs} runs, but of one where a run takes long: of the peers from"
        f" {LARGE:,} vertices on, in the scaling run from {LARGE_SCALING:,} on."
        if runs > 1
        else "Each figure is that of a single run."
    )
    return [
        "# Benchmarks",
        f"""\
Written by `make bench`; `make bench-quick` measures a part of it in about two minutes and writes to
`build/bench`. `CUBIC_CRAFT_MESHES=folder` tells where the meshes are; without them, bumpy spheres
take their place. All programs run in turn on the same machine. {how_often}
On another machine, or a busy one, the seconds change more than their ratios.""",
        machine,
        """\
Unless a section says otherwise, times begin with the arrays of the mesh in memory and hold all
set-up. Python, the libraries and the compiled kernels are loaded before; the last section tells how
long that takes.""",
        """\
**Which settings.** Rows are *as in the paper*: its energy on the mesh as it is given, without
solidity, links and refinement, and free to turn (the preset *As in the Paper*, `--paper`; for the
solver `proxy=PAPER, keep_rotation=False`, which is what it does unless it is told otherwise). So
did version 0.1.0, and so do the programs that it is compared with. Artists get other defaults:
solidity 0.1, parts kept together, coarse meshes refined, rotation kept. What these cost is measured
in "With the defaults", and only there and in the first Cubify of the monkey.""",
    ]


def _ten(results):
    return [
        "## Ten iterations",
        f"""\
{ITERATIONS} outer iterations from the arrays of the mesh to the result at cubeness {CUBENESS}, as
in the paper, with all set-up. Reading the file (by pymeshlab, mostly) has a column of its own: the
paper does not say whether its figures hold that. The columns of the paper are the figures published
in Table 1 of "CubicCraft: A Mesh Stylization Tool"; they were taken on other hardware (NVIDIA RTX
3050 Ti; AMD R9 5900HS with the program of Liu and Jacobson), not on this machine. The table says
how fast set-up and iterations are, not how soon a shape is done: most are not after so few.""",
        tables.ten_iterations(results),
        """\
From 40,000 vertices on, about half of the time is one sparse Cholesky factorisation ("Where the
time goes", below). Without it the table would look better, and the artist would wait longer. With
two steps of conjugate gradients in its place, each with a V-cycle of multigrid, ten iterations of
the horse took 0.69 s in place of 0.93 s, side by side, and 106 came as far as 104 with the exact
solution; but on two cores each took 10 ms more, and the gap of 1 % came after 3.9 s in place of
3.1 s (armadillo, 0.2: 2.3 s and 1.9 s; owl: 1.9 s and 1.6 s). To begin with the one and go on with
the other, both have to be set up. So meshes of up to 60,000 vertices are factorised at once.""",
    ]


def _race(cases):
    paragraphs = [
        "## To the best shape",
        """\
The gap of a shape is (E - best) / (rest - best). E is its energy in the unit box, with the
rotations that fit it best; rest is that of the undeformed mesh; best is the lowest energy that any
run of any program is known to have reached. These are kept in
`scripts/benchmark/best_energies.json`, and `python scripts/benchmark --find-best 60` looks for
lower ones. All are those of the paper's energy, with free rotation. One function judges the shapes
of all programs. A time in brackets is of a run that goes on beyond our own stop; a dash means that
the gap was not reached.""",
        tables.gaps(cases),
        f"![Gap over time](images/{GAPS_IMAGE})",
        f"""\
The plot shows one run of each program. Where a curve ends, the program stops by itself, except that
the plain iteration is left at a gap of {tables.percent(PLAIN_GAP)}, after {PLAIN_ITERATIONS}
iterations or after {PLAIN_SECONDS:g} seconds.""",
    ]
    if any(case["plain"] for case in cases):
        paragraphs += [
            "### Beside the plain iteration",
            """\
The same solver, as in the paper too, without acceleration (`is_accelerated=False`), left as said
above. "Times sooner there" is how many times sooner ours is as low as the plain one is where it is
left.""",
            tables.plain(cases),
        ]
    if any(case["pymeshlab"] for case in cases):
        paragraphs += [
            "### Beside PyMeshLab",
            """\
PyMeshLab's filter `apply_coord_cubic_stylization` with its default stop; ours as in the
paper. "Ours as low" is when ours reaches the energy at which PyMeshLab ends; "times faster"
compares both at their own stop. Cases that are not listed were not run with it, for the time that
this would take.""",
            tables.pymeshlab(cases),
        ]
    return paragraphs


def _phases(results):
    return [
        "## Where the time goes, and memory",
        f"""\
One run to our own stop at cubeness {PHASES_CUBENESS}, as in the paper, in a process of its own: the
phases of set-up in seconds, then those of an iteration in milliseconds, the mean of all iterations
but the first.
Peak memory is that of the whole process; "for the run" is what it takes above Python, the libraries
and the kernels.""",
        tables.phases(results),
        """\
What bounds an iteration on 50,000 vertices:

- The Cholesky factor of the horse has at least 1.7 million entries of 12 bytes, and a solve reads
  all of them twice. One core of the machine above reads 13 to 18 GB a second, which makes 2.5 to
  3 ms; a solve takes 5 to 9, on one core.
- The local step reads and writes about 560 bytes per vertex, 27 MB for the horse: 1 ms on both
  cores. It takes 6 to 10, since it is bound by its arithmetic: about 600 operations per vertex in
  64 bit, one after the other, with a root and divisions between them, in about 1,000 cycles of a
  core. Vector instructions for four vertices at once could do with a quarter; Taichi makes none.
- To wake both cores for a loop takes 0.14 ms, twice in an iteration.

What bounds set-up: 0.4 s of 0.6 s is the factorisation, by CHOLMOD's simplicial code as cholespy
has it. The numbers themselves are not the limit: its supernodal code needs 0.11 s, with an ordering
by minimum degree.

What has been tried to get below that, each beside the present way in one process (horse):

- That supernodal factorisation, by cvxopt: 21 ms in place of 7 ms for each solve, column by column,
  and 11 ms to 18 ms for the three columns at once. Its simplicial one: 0.2 s to 0.3 s, and 9 ms
  each.
- Its factor taken out and solved by kernels of our own on both cores, after a nested dissection:
  10 ms in 64 bit and 6.6 ms in 32 bit, and with what that takes to prepare 0.3 s. It may pay on
  more cores than two.
- Conjugate gradients with multigrid: see "Ten iterations".
- Anderson acceleration (5 and 10 steps back) in place of momentum: 134 and 138 iterations in place
  of 34 to a gap of 5 %, and no gap of 1 % within 300. L-BFGS in the metric of the Laplacian (5, 10
  and 20 steps back): 48, 52 and 49 iterations to 5 %, 250 and more to 1 %.""",
    ]


def _scaling(cases, power):
    fit = ""
    if power is not None:
        fit = (
            f"\nFrom {FIT_FROM:,} vertices on, the time to a gap of {tables.percent(FITTED_GAP)}"
            f" grows as vertices^{power:.2f} (least squares of the logarithms), set-up as"
            f" vertices^{fit_of(cases, _setup)[0]:.2f} and one iteration as"
            f" vertices^{fit_of(cases, summary.milliseconds_per_iteration)[0]:.2f}. What is left is"
            " that a larger mesh needs more iterations."
        )
    return [
        "## Time over size",
        f"""\
One shape, the {cases[0]["mesh"]}, simplified or subdivided to each size, at cubeness
{cases[0]["cubeness"]}, as in the paper; each size in a process of its own. A dash means that no
best energy is known yet, or that the gap was not reached.{fit}""",
        tables.scaling(cases),
        """\
Why more: the least energy of a finer mesh belongs to another shape, for more of it can be flat. The
shapes of the bunny with 98,722 and with 394,882 vertices, both solved to their ends, lie 2.2 % of
the unit box apart (root mean square, rotations taken out), 9 edges of the finer mesh, and no start
from a coarser mesh saves that way. To solve the coarse one to its end, to extrapolate from two of
them, to begin with up to ten times the momentum, or to solve each global step almost exactly saves
0 to 20 % of the iterations of the fine mesh, and costs more than that elsewhere.""",
        f"![Time over size](images/{SCALING_IMAGE})",
    ]


def _defaults(cases):
    paragraphs = [
        "## With the defaults",
        f"""\
The artist's defaults beside the paper's settings, in alternation in one process, at cubeness
{DEFAULTS_CUBENESS}, each to its own stop. The energies are not the same, nor are the shapes, so
neither are the iterations. Set-up holds welding, refinement, links and factorisation; the time to
our stop also holds reading back the vertices that were given. "Times as long" compares the two; it
has a bound for meshes of {FIFTY_THOUSAND[0]:,} to {FIFTY_THOUSAND[-1]:,} vertices. Meshes of up to
{COARSE:,} vertices also have ticks: how often in a second Live could show them anew, computing as
long as it does in each tick, with one restart by the slider, without what Blender takes to draw.

The meshes that are made: the character is a bumpy ball with twelve balls stuck to it, each a part
of its own; the dressed body is a bumpy ball in a shirt, a copy of a part of it moved out by 0.8 %
of the height.""",
        tables.defaults(cases),
    ]
    if measured := [case for case in cases if "peak" in case["defaults"][0]]:
        paragraphs += [
            "Memory of the largest, each run in a process of its own:",
            tables.memory_of_defaults(measured),
        ]
    return paragraphs


def _setup(case):
    return summary.median_of(case, "ours", "setup")


def _startup(programs):
    return [
        "## From start to first result",
        """\
Fresh processes, with the files in the system's cache and the compiled kernels on disk. Cubify has
the artist's defaults. The solver without Blender stylizes a sphere of about 500 vertices, as many
as the monkey has, as in the paper.""",
        tables.startup(programs),
    ]
