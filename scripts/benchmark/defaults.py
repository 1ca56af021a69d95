# SPDX-License-Identifier: GPL-3.0-or-later
"""What artists get by default beside the paper's energy; `earlier.py` has that of the prototype."""

import time

from solver import PAPER, ProxyOptions, Setup, SolverOptions, Stylization, preparation, rest_mesh
from solver import Run as SlicedRun

from .machine import peak_memory
from .meshes import read
from .our_solver import load_kernels, over, solve
from .phases import WhileAnyRuns
from .race import LONG_ITERATIONS, LONG_SECONDS, LONG_TOLERANCE

SETTINGS = {
    "paper": {"proxy": PAPER, "keep_rotation": False},
    "defaults": {"proxy": ProxyOptions(), "keep_rotation": True},
}
LINKS = {
    "neighbours": (preparation, "neighbour_links"),
    "other side": (preparation, "links_within"),
}
"""what looks for links, side by side"""
SLICE = 0.02
"""seconds that Live computes in a tick, the last phase of the solver on top"""
DRAGGED = 0.3
"""cubeness that a slider is dragged to, from that of the case"""
FIRST_TICKS = 5
"""after which the slider is dragged"""


def side_by_side(path, cubeness, runs):
    """Run both settings in alternation, each to its own stop.

    Returns
    -------
    dict
        The runs of each, by name, and ``bounds``: by name, the energy at rest and the lowest, also
        of a run that goes on beyond the stop. Each of the settings has an energy of its own.
    """
    V, F = read(path)
    load_kernels()
    for settings in SETTINGS.values():  # imports, and cold caches
        solve(V, F, cubeness, max_iterations=3, **settings)
    finding_links = WhileAnyRuns(LINKS)
    results = {name: [] for name in SETTINGS}
    for _ in range(runs):
        for name in SETTINGS:
            results[name].append(_figures(V, F, cubeness, name, finding_links))
    bounds = {name: _bounds(V, F, cubeness, name, runs) for name, runs in results.items()}
    return results | {"bounds": bounds}


def alone(path, cubeness, name):
    """Run one of `SETTINGS`, as the first of its process; return its memory too."""
    load_kernels()
    finding_links = WhileAnyRuns(LINKS)
    with peak_memory() as memory:
        figures = _figures(*read(path), cubeness, name, finding_links)
    del figures["curve"]
    return figures | memory


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


def _figures(V, F, cubeness, name, finding_links):
    """Return the figures of a run, seconds of finding ``links``, and ``solved``.

    ``solved`` is the number of vertices that are solved: more than are given where a mesh is
    refined, fewer where it is welded.
    """
    finding_links.seconds = 0.0
    run = solve(V, F, cubeness, **SETTINGS[name])
    return run.figures | {
        "links": finding_links.seconds,
        "solved": len(run.setup.rest.V),
    }


def _bounds(V, F, cubeness, name, runs):
    """Return the energy at rest and the lowest one that these runs or a long one have seen."""
    stop = {"max_iterations": LONG_ITERATIONS, "tolerance": LONG_TOLERANCE}
    long = solve(V, F, cubeness, over(LONG_SECONDS), **SETTINGS[name], **stop).figures
    seen = [energy for run in (*runs, long) for _, energy in run["curve"]]
    return max(seen), min(seen)
