# SPDX-License-Identifier: GPL-3.0-or-later
"""What is measured of one mesh, each in a process of its own. Times do not hold loading of kernels.

A run is a dict: seconds until the first iteration begins (``setup``) and in all, ``iterations``,
``reason``, the number of vertices that are ``solved``, and the ``curve``: [seconds since the
beginning, energy] after each iteration.
"""

import multiprocessing
import os
import platform
import re
import time
from concurrent.futures import ProcessPoolExecutor
from importlib import metadata
from importlib.util import find_spec
from pathlib import Path

from solver import PAPER, ProxyOptions, Setup, SolverOptions, Stylization, rest_mesh, run

from .meshes import blob

PACKAGES = ("numpy", "scipy", "taichi", "quadrants", "cholespy", "pymeshlab", "bpy")
SETTINGS = {"paper": (PAPER, False), "defaults": (ProxyOptions(), True)}
"""name: how the mesh is prepared, and whether parts keep their rotation"""
LIMIT_SECONDS = 240.0
"""after which a run is given up"""
EVALUATION_STEPS = 30
"""local steps that evaluate the energy of a given shape"""


def machine_line():
    """Return one line about processor, system and versions."""
    cpuinfo = Path("/proc/cpuinfo")
    model = re.search(r"model name\s*: (.*)", cpuinfo.read_text() if cpuinfo.exists() else "")
    processor = f"{model[1]} ({platform.machine()})" if model else platform.machine()
    there = [name for name in PACKAGES if find_spec(name)]
    versions = ", ".join(f"{name} {metadata.version(name)}" for name in there)
    return (
        f"{processor}, {os.cpu_count()} cores, {platform.system()},"
        f" Python {platform.python_version()}; {versions}."
    )


def isolated(function, **arguments):
    """Call a function in a process of its own, so that its caches and its start are its own too."""
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(1, mp_context=spawn) as pool:
        return pool.submit(function, **arguments).result()


def solve(V, F, cubeness, name="paper", **stop):
    """Stylize a mesh; return the run, its Setup and the positions (n,3).

    The energy noted after an iteration is that of the shape that its local step looked at, so it
    lags behind by one iteration. What is in `stop` goes to `solver.run`.
    """
    proxy, keep_rotation = SETTINGS[name]
    curve, begin = [], time.perf_counter()
    setup = Setup(rest_mesh(V, F, proxy))
    options = SolverOptions(keep_rotation=keep_rotation)
    stylization = Stylization(setup, cubeness, options=options)
    begin += stylization.compile_seconds
    figures = {"setup": time.perf_counter() - begin, "solved": len(setup.rest.V), "curve": curve}

    def note(state):
        seconds = time.perf_counter() - begin
        curve.append([seconds, state.energy.total])
        return seconds > LIMIT_SECONDS

    result = run(stylization, on_iteration=note, **stop)
    figures |= {"seconds": time.perf_counter() - begin, "iterations": result.iterations}
    return figures | {"reason": result.reason}, setup, result.positions


def energy_of(setup, cubeness, positions):
    """Return the energy of a shape (n,3) in the unit box, with the rotations that fit it best.

    Each vertex has several minima. Looked for from the rest shape and from the rotations that fit
    best without cubeness, whichever ends lower: of a million vertices, the first alone finds 1.4 %
    more energy than the run had itself.
    """
    options = SolverOptions(is_accelerated=False)
    fit = Stylization(setup, 0.0, options=options)
    fit.energy_of(positions, 1)
    from_fit = Stylization(setup, cubeness, options=options)
    from_fit.start_from(fit.rotations, fit.positions)
    from_rest = Stylization(setup, cubeness, options=options)
    return min(
        judge.energy_of(positions, EVALUATION_STEPS).total for judge in (from_fit, from_rest)
    )


def beside_pymeshlab(V, F, cubeness, runs):
    """Run ours and PyMeshLab in turn, to their own stops; return lists of runs of both.

    PyMeshLab's have ``seconds``, and both the judged ``energy`` of the end.
    """
    _load_kernels()
    setup = solve(V, F, cubeness, max_iterations=3)[1]  # its time does not count: cold caches
    results = {"ours": [], "pymeshlab": []}
    for _ in range(runs):
        figures, _, positions = solve(V, F, cubeness)
        results["ours"].append(figures | {"energy": energy_of(setup, cubeness, positions)})
        figures, positions = _solve_by_pymeshlab(V, F, cubeness)
        results["pymeshlab"].append(figures | {"energy": energy_of(setup, cubeness, positions)})
    return results


def both_settings(V, F, cubeness, runs):
    """Run the settings in turn, each to its own stop; return the runs of each, by name."""
    _load_kernels()
    for name in SETTINGS:  # imports, and cold caches
        solve(V, F, cubeness, name, max_iterations=3)
    pairs = [{name: solve(V, F, cubeness, name)[0] for name in SETTINGS} for _ in range(runs)]
    return {name: [pair[name] for pair in pairs] for name in SETTINGS}


def _load_kernels():
    """Solve something, so that nothing has to be imported, compiled or loaded in what follows."""
    solve(*blob(600), 0.4, max_iterations=3)


def _solve_by_pymeshlab(V, F, cubeness):
    import pymeshlab  # pyright: ignore[reportMissingImports]

    meshes = pymeshlab.MeshSet()
    meshes.add_mesh(pymeshlab.Mesh(V, F))
    begin = time.perf_counter()
    meshes.apply_coord_cubic_stylization(lcubeness=cubeness, applyef=False, applycol=False)
    seconds = time.perf_counter() - begin
    return {"seconds": seconds}, meshes.current_mesh().vertex_matrix()
