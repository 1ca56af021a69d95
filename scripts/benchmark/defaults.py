# SPDX-License-Identifier: GPL-3.0-or-later
"""What artists get by default beside the paper's energy, which version 0.1.0 had alone."""

import time

from solver import PAPER, ProxyOptions, Setup, Stylization, rest_mesh
from solver import Run as SlicedRun

from . import memory
from .meshes import read
from .our_solver import load_kernels, over, solve
from .phases import Stopwatch

SETTINGS = {
    "paper": {"proxy": PAPER, "keep_rotation": False},
    "defaults": {"proxy": ProxyOptions(), "keep_rotation": True},
}
LINKS = {
    "to neighbours": ("solver.rest", "neighbour_links"),
    "to the other side": ("solver.rest", "thickness_links"),
}
"""what looks for links"""
LIMIT_SECONDS = 240.0
"""after which a run is given up"""
SLICE = 0.02
"""seconds that Live computes in a tick, the last phase of the solver on top"""
DRAGGED = 0.3
"""cubeness that a slider is dragged to, from that of the case"""


def side_by_side(path, cubeness, runs):
    """Run both settings in alternation, each to its own stop.

    Parameters
    ----------
    path : str
        Of the mesh.
    cubeness : float
    runs : int
        Of each.

    Returns
    -------
    dict
        ``paper`` and ``defaults``, each a list of what `_figures` returns.
    """
    V, F = read(path)
    load_kernels()
    for settings in SETTINGS.values():  # imports, and cold caches
        solve(V, F, cubeness, max_iterations=3, **settings)
    watch = _watch()
    results = {name: [] for name in SETTINGS}
    for _ in range(runs):
        for name in SETTINGS:
            results[name].append(_figures(V, F, cubeness, name, watch))
    return results


def alone(path, cubeness, name):
    """Run one of `SETTINGS`, as the first of its process, and measure its memory too.

    Returns
    -------
    dict
        Those of `_figures`, ``peak`` bytes of the process, and ``above`` bytes more than before the
        mesh was read.
    """
    load_kernels()
    watch = _watch()
    before = memory.resident_bytes()
    memory.reset_peak()
    V, F = read(path)
    figures = _figures(V, F, cubeness, name, watch)
    peak = memory.peak_bytes()
    return figures | {"peak": peak, "above": peak - before}


def ticks(path, cubeness):
    """Return the seconds of each tick of Live with the defaults, less what Blender does in it.

    As when the slider is dragged once, before the first run has ended: that restarts it.
    """
    V, F = read(path)
    load_kernels()
    settings = SETTINGS["defaults"]
    solve(V, F, cubeness, max_iterations=3, **settings)
    setup = Setup(rest_mesh(V, F, settings["proxy"]))
    seconds = []
    for value, most in ((cubeness, 5), (DRAGGED, None)):
        begin = time.perf_counter()
        stylization = Stylization(setup, value, keep_rotation=settings["keep_rotation"])
        run = SlicedRun(stylization)
        while run.reason is None and (most is None or len(seconds) < most):
            _advance(run, begin + SLICE)
            run.positions()
            end = time.perf_counter()
            seconds.append(end - begin)
            begin = end
    return seconds


def _advance(run, deadline):
    """Advance a run until it ends, or the time has come."""
    while run.reason is None and time.perf_counter() < deadline:
        run.advance()


def _watch():
    """Return a Stopwatch on what looks for links."""
    watch = Stopwatch()
    for phase, where in LINKS.items():
        watch.replace(phase, *where)
    return watch


def _figures(V, F, cubeness, name, watch):
    """Return the figures of a run without its curve, seconds of finding ``links``, and ``solved``.

    ``solved`` is the number of vertices that are solved: more than are given where a mesh is
    refined, fewer where it is welded.
    """
    before = sum(watch.seconds.values())
    run = solve(V, F, cubeness, over(LIMIT_SECONDS), **SETTINGS[name])
    figures = run.figures()
    del figures["curve"]
    links = sum(watch.seconds.values()) - before
    return figures | {"links": links, "solved": len(run.setup.rest.V)}
