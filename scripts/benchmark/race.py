# SPDX-License-Identifier: GPL-3.0-or-later
"""One case of mesh and cubeness: ours, the plain iteration and PyMeshLab, in alternation."""

import math

from . import peer_pymeshlab
from .gap import GAPS, energy_at_gap, seconds_to_energy
from .meshes import read
from .our_solver import energy_of, load_kernels, over, solve

OUR_SECONDS = 120.0
"""after which our run is given up"""
PLAIN_SECONDS, PLAIN_ITERATIONS, PLAIN_GAP = 30.0, 400, 0.01
"""where the plain iteration is left"""
LONG_SECONDS, LONG_ITERATIONS, LONG_TOLERANCE = 30.0, 5000, 1e-6
"""of the run for gaps that lie beyond our own stop"""


def race(path, cubeness, best, runs, plain_runs, pymeshlab_runs):
    """Run everything on one mesh and return the figures.

    Parameters
    ----------
    path : str
        Of the mesh.
    cubeness : float
    best : float or None
        Lowest energy known so far.
    runs, plain_runs, pymeshlab_runs : int
        `runs`, of ours, must be at least 1.

    Returns
    -------
    dict
        The ``rest`` energy and the ``best``, now known; ``ours``, ``plain`` and ``pymeshlab``, each
        a list of runs with ``seconds`` and the judged ``energy`` of its end, and those of our
        solver also as `Run.figures`; and ``long``, our run that goes on beyond its own stop,
        or None where that had come near enough.
    """
    V, F = read(path)
    load_kernels()
    setup = solve(V, F, cubeness, max_iterations=3).setup  # its time does not count: cold caches
    rest = energy_of(setup, cubeness, V)
    best = math.inf if best is None else best
    ours, plain, pymeshlab, long = [], [], [], None

    def judged(run):
        return run.figures() | {"energy": energy_of(setup, cubeness, run.positions)}

    for number in range(max(runs, plain_runs, pymeshlab_runs)):
        if number < runs:
            ours.append(judged(solve(V, F, cubeness, over(OUR_SECONDS))))
            best = min(best, ours[-1]["energy"])
        if number < plain_runs:
            is_over = over(PLAIN_SECONDS, energy_at_gap(PLAIN_GAP, rest, best))
            options = {"is_accelerated": False, "max_iterations": PLAIN_ITERATIONS}
            plain.append(judged(solve(V, F, cubeness, is_over, **options)))
        if number < pymeshlab_runs:
            seconds, positions = peer_pymeshlab.solve(V, F, cubeness)
            energy = energy_of(setup, cubeness, positions)
            pymeshlab.append({"seconds": seconds, "energy": energy})

    nearest = energy_at_gap(min(GAPS), rest, best)
    if any(seconds_to_energy(run["curve"], nearest) is None for run in ours):
        stop = {"max_iterations": LONG_ITERATIONS, "tolerance": LONG_TOLERANCE}
        long = judged(solve(V, F, cubeness, over(LONG_SECONDS, nearest), **stop))
    ends = ours + plain + pymeshlab + ([long] if long else [])
    return {
        "rest": rest,
        "best": min(best, *(end["energy"] for end in ends)),
        "ours": ours,
        "plain": plain,
        "pymeshlab": pymeshlab,
        "long": long,
    }
