# SPDX-License-Identifier: GPL-3.0-or-later
"""Ten outer iterations with set-up, as in Table 1 of the CubicCraft paper."""

import time

from solver import Setup, Stylization, rest_mesh, run

from .meshes import read
from .our_solver import load_kernels

ITERATIONS = 10
CUBENESS = 0.4

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
    """Time runs from the arrays of the mesh to the result; the kernels are loaded.

    Returns
    -------
    dict
        ``seconds`` of each run, and those of ``reading`` the file before it.
    """
    load_kernels()
    read(source)  # imports the reader, and has the file in the system's cache
    figures = {"seconds": [], "reading": []}
    for _ in range(runs):
        begin = time.perf_counter()
        V, F = read(source)
        figures["reading"].append(time.perf_counter() - begin)
        begin = time.perf_counter()
        stylization = Stylization(Setup(rest_mesh(V, F)), CUBENESS)
        run(stylization, max_iterations=ITERATIONS)
        figures["seconds"].append(time.perf_counter() - begin - stylization.compile_seconds)
    return figures
