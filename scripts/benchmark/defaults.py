# SPDX-License-Identifier: GPL-3.0-or-later
"""What artists get by default beside the paper's energy."""

import time

from solver import PAPER, ProxyOptions, Setup, SolverOptions, Stylization, rest_mesh
from solver import Run as SlicedRun

from .meshes import read
from .our_solver import load_kernels, solve

SETTINGS = {
    "paper": {"proxy": PAPER, "keep_rotation": False},
    "defaults": {"proxy": ProxyOptions(), "keep_rotation": True},
}
SLICE = 0.02
"""seconds that Live computes in a tick, the last phase of the solver on top"""
DRAGGED = 0.3
"""cubeness that a slider is dragged to, from that of the case"""
FIRST_TICKS = 5
"""after which the slider is dragged"""


def side_by_side(path, cubeness, runs):
    """Run both settings in alternation, each to its own stop.

    Returns a dict: the runs of each, by name, with the number of vertices that are ``solved``,
    which is not that of the mesh where it is refined or welded; and ``bounds``: by name, the energy
    at rest and the lowest. Each of the settings has an energy of its own.
    """
    V, F = read(path)
    load_kernels()
    for settings in SETTINGS.values():  # imports, and cold caches
        solve(V, F, cubeness, max_iterations=3, **settings)
    results = {name: [] for name in SETTINGS}
    for _ in range(runs):
        for name in SETTINGS:
            run = solve(V, F, cubeness, **SETTINGS[name])
            results[name].append(run.figures | {"solved": len(run.setup.rest.V)})
    return results | {"bounds": {name: _bounds(runs) for name, runs in results.items()}}


def ticks(path, cubeness):
    """Return the seconds of each tick of Live with the defaults, less what Blender does in it.

    As when the slider is dragged once, before the first run has ended: that restarts it.
    """
    V, F = read(path)
    load_kernels()
    settings = SETTINGS["defaults"]
    solve(V, F, cubeness, max_iterations=3, **settings)
    setup = Setup(rest_mesh(V, F, settings["proxy"]))
    options = SolverOptions(keep_rotation=settings["keep_rotation"])
    seconds = []
    for value in (cubeness, DRAGGED):
        begin = time.perf_counter()
        run = SlicedRun(Stylization(setup, value, options=options))
        while run.reason is None and (value == DRAGGED or len(seconds) < FIRST_TICKS):
            while run.reason is None and time.perf_counter() < begin + SLICE:
                run.advance()
            run.positions()
            end = time.perf_counter()
            seconds.append(end - begin)
            begin = end
    return seconds


def _bounds(runs):
    seen = [energy for run in runs for _, energy in run["curve"]]
    return max(seen), min(seen)
