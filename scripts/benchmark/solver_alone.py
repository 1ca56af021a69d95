# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of the solver alone: ten iterations, as in Table 1 of the CubicCraft paper, and one size."""

import time

from .machine import peak_memory
from .meshes import read
from .our_solver import energy_of, load_kernels, solve

ITERATIONS, CUBENESS = 10, 0.4
PAPER_SECONDS = {
    "homer": (3.39, 10.03),
    "bunny": (3.55, 27.56),
    "owl": (6.69, 160.52),
    "horse": (8.25, 211.62),
    "armadillo": (7.80, 217.96),
}
"""Table 1: on a GPU (NVIDIA RTX 3050 Ti) and on a CPU (AMD R9 5900HS, the solver of Liu and
Jacobson), by mesh"""


def ten_iterations(source, runs):
    """Return the ``seconds`` of each run, and those of ``reading`` the file before it."""
    load_kernels()
    read(source)  # imports the reader, and has the file in the system's cache
    figures = {"seconds": [], "reading": []}
    for _ in range(runs):
        begin = time.perf_counter()
        V, F = read(source)
        figures["reading"].append(time.perf_counter() - begin)
        run = solve(V, F, CUBENESS, max_iterations=ITERATIONS)
        figures["seconds"].append(run.figures["seconds"])
    return figures


def one_size(path, runs):
    """Run one mesh to our own stop.

    Returns a dict: the ``rest`` energy; ``ours``, a list of runs as in `race`; and the figures of
    `peak_memory` of the first run.
    """
    load_kernels()
    with peak_memory() as memory:
        V, F = read(path)
        run = solve(V, F, CUBENESS)
    rest, ours = energy_of(run.setup, CUBENESS, V), []
    for number in range(runs):
        run = run if number == 0 else solve(V, F, CUBENESS)
        ours.append(run.figures | {"energy": energy_of(run.setup, CUBENESS, run.positions)})
    return {"rest": rest, "ours": ours, **memory}
