# SPDX-License-Identifier: GPL-3.0-or-later
"""The defaults with NumPy alone, as where no engine is installed, beside those with Taichi."""

from .defaults import SETTINGS
from .meshes import read
from .our_solver import load_kernels, solve

DEVICES = {"taichi": "cpu", "numpy": "numpy"}


def side_by_side(path, cubeness, runs):
    """Run both in alternation, each to its own stop; return {name: runs}."""
    V, F = read(path)
    load_kernels()
    results = {name: [] for name in DEVICES}
    for _ in range(runs):
        for name, device in DEVICES.items():
            run = solve(V, F, cubeness, device=device, **SETTINGS["defaults"])
            results[name].append(run.figures_without_curve())
    return results
