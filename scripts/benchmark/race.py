# SPDX-License-Identifier: GPL-3.0-or-later
"""One case of mesh and cubeness: ours and PyMeshLab, in alternation."""

import math
import time

from .meshes import read
from .our_solver import energy_of, load_kernels, solve


def race(path, cubeness, best, runs, pymeshlab_runs):
    """Run everything on one mesh; `best` is the lowest energy known so far, or None.

    Returns a dict: the ``rest`` energy and the ``best``, now known; ``ours`` and ``pymeshlab``,
    lists of runs with ``seconds`` and the judged ``energy`` of the end, ours with all
    `TimedRun.figures`.
    """
    V, F = read(path)
    load_kernels()
    setup = solve(V, F, cubeness, max_iterations=3).setup  # its time does not count: cold caches
    ours, theirs = [], []
    for number in range(max(runs, pymeshlab_runs)):
        if number < runs:
            run = solve(V, F, cubeness)
            ours.append(run.figures | {"energy": energy_of(setup, cubeness, run.positions)})
        if number < pymeshlab_runs:
            figures, positions = _solve_by_pymeshlab(V, F, cubeness)
            theirs.append(figures | {"energy": energy_of(setup, cubeness, positions)})
    ends = [run["energy"] for run in (*ours, *theirs)]
    best = min(math.inf if best is None else best, *ends)
    rest = energy_of(setup, cubeness, V)
    return {"rest": rest, "best": best, "ours": ours, "pymeshlab": theirs}


def _solve_by_pymeshlab(V, F, cubeness):
    """Run PyMeshLab's filter for the same problem to its default stop."""
    import pymeshlab  # pyright: ignore[reportMissingImports]

    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(V, F))
    begin = time.perf_counter()
    meshes.apply_coord_cubic_stylization(lcubeness=cubeness, applyef=False, applycol=False)
    seconds = time.perf_counter() - begin
    return {"seconds": seconds}, meshes.current_mesh().vertex_matrix()
