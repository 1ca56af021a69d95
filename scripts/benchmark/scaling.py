# SPDX-License-Identifier: GPL-3.0-or-later
"""How time and memory grow with the size of the mesh."""

import numpy as np

from . import memory
from .meshes import read
from .our_solver import energy_of, load_kernels, solve
from .race import over

CUBENESS = 0.4
LIMIT_SECONDS = 240.0
"""after which a run is given up"""
FIT_FROM, FIT_TO = 10_000, 1_100_000
"""vertices of the meshes that the exponent is fitted to"""


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


def exponent(sizes, seconds):
    """Fit seconds = factor * sizes ** power by least squares of the logarithms.

    Parameters
    ----------
    sizes, seconds : sequence of float
        At least two different sizes.

    Returns
    -------
    power, factor : float

    Raises
    ------
    ValueError
        There are fewer than two sizes, or a number is not positive.
    """
    if len(set(sizes)) < 2:
        raise ValueError(f"the fit needs two different sizes, not {list(sizes)}")
    if min(sizes) <= 0 or min(seconds) <= 0:
        raise ValueError("sizes and seconds must be positive")
    power, logarithm = np.polyfit(np.log(sizes), np.log(seconds), 1)
    return float(power), float(np.exp(logarithm))
