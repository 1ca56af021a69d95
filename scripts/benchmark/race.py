# SPDX-License-Identifier: GPL-3.0-or-later
"""One case of mesh and cubeness: ours, the plain iteration and PyMeshLab, in alternation."""

import math
import time

from .meshes import read
from .our_solver import energy_of, load_kernels, over, solve
from .summary import GAPS, energy_at_gap, seconds_to_energy

PLAIN_SECONDS, PLAIN_ITERATIONS, PLAIN_GAP = 30.0, 400, 0.01
"""where the plain iteration is left"""
LONG_SECONDS, LONG_ITERATIONS, LONG_TOLERANCE = 30.0, 5000, 1e-6
"""of the run for gaps that lie beyond our own stop"""


def race(path, cubeness, best, runs, plain_runs, pymeshlab_runs):
    """Run everything on one mesh; `best` is the lowest energy known so far, or None.

    Returns
    -------
    dict
        The ``rest`` energy and the ``best``, now known; lists of runs with ``seconds`` and the
        judged ``energy`` of the end, those of the solver with all `TimedRun.figures`: ``ours``,
        ``plain``, ``pymeshlab``, and ``long``, our run that goes on beyond its own stop, where that
        has not come near enough.
    """
    V, F = read(path)
    load_kernels()
    setup = solve(V, F, cubeness, max_iterations=3).setup  # its time does not count: cold caches
    rest = energy_of(setup, cubeness, V)
    best = math.inf if best is None else best
    results = {"ours": [], "plain": [], "pymeshlab": [], "long": []}

    def add(name, figures, positions):
        energy = energy_of(setup, cubeness, positions)
        results[name].append(figures | {"energy": energy})
        return energy

    def add_ours(name, *until, **options):
        run = solve(V, F, cubeness, *until, **options)
        return add(name, run.figures, run.positions)

    for number in range(max(runs, plain_runs, pymeshlab_runs)):
        if number < runs:
            best = min(best, add_ours("ours"))
        if number < plain_runs:
            until = over(PLAIN_SECONDS, energy_at_gap(PLAIN_GAP, rest, best))
            add_ours("plain", until, is_accelerated=False, max_iterations=PLAIN_ITERATIONS)
        if number < pymeshlab_runs:
            add("pymeshlab", *_solve_by_pymeshlab(V, F, cubeness))
    nearest = energy_at_gap(min(GAPS), rest, best)
    if any(seconds_to_energy(run["curve"], nearest) is None for run in results["ours"]):
        stop = {"max_iterations": LONG_ITERATIONS, "tolerance": LONG_TOLERANCE}
        add_ours("long", over(LONG_SECONDS, nearest), **stop)
    ends = [run["energy"] for runs in results.values() for run in runs]
    return {"rest": rest, "best": min(best, *ends), **results}


def _solve_by_pymeshlab(V, F, cubeness):
    """Run PyMeshLab's filter for the same problem to its default stop."""
    import pymeshlab  # pyright: ignore[reportMissingImports]

    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(V, F))
    begin = time.perf_counter()
    meshes.apply_coord_cubic_stylization(lcubeness=cubeness, applyef=False, applycol=False)
    seconds = time.perf_counter() - begin
    return {"seconds": seconds}, meshes.current_mesh().vertex_matrix()
