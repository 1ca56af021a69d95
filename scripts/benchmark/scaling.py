# SPDX-License-Identifier: GPL-3.0-or-later
"""How time and memory grow with the size of the mesh."""

from . import memory
from .meshes import read
from .our_solver import energy_of, load_kernels, over, solve

CUBENESS = 0.4
LIMIT_SECONDS = 240.0
"""after which a run is given up"""


def one_size(path, runs):
    """Run one mesh to our own stop.

    Returns
    -------
    dict
        ``rest`` energy; ``ours``, a list of runs as in `race`; ``peak`` bytes of the process in the
        first run, and ``above`` bytes more than before the mesh was read.
    """
    load_kernels()
    before = memory.resident_bytes()
    memory.reset_peak()
    V, F = read(path)
    ours, rest, peak = [], 0.0, 0
    for number in range(runs):
        run = solve(V, F, CUBENESS, over(LIMIT_SECONDS))
        if number == 0:
            peak = memory.peak_bytes()
            rest = energy_of(run.setup, CUBENESS, V)
        ours.append(run.figures() | {"energy": energy_of(run.setup, CUBENESS, run.positions)})
    return {"rest": rest, "ours": ours, "peak": peak, "above": peak - before}
