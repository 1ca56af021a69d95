# SPDX-License-Identifier: GPL-3.0-or-later
"""How time and memory grow with the size of the mesh."""

from . import memory
from .meshes import read
from .our_solver import energy_of, load_kernels, solve
from .race import over

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
    ours, peak, setup = [], None, None
    for _ in range(runs):
        run = solve(V, F, CUBENESS, over(LIMIT_SECONDS))
        if peak is None:
            peak = memory.peak_bytes()
        setup = run.setup
        energy = energy_of(setup, CUBENESS, run.positions)
        ours.append(run.figures() | {"energy": energy})
    rest = energy_of(setup, CUBENESS, V)
    return {"rest": rest, "ours": ours, "peak": peak, "above": peak - before}
