# SPDX-License-Identifier: GPL-3.0-or-later
"""Look long for the lowest energy of a case that is reached from the rest shape.

The problem has more than one minimum, so what is found is the lowest known energy and not a proven
one. Starts from other shapes, such as those of other cubeness, find lower minima on some meshes, in
which the whole shape is turned; they are no measure for a run that begins at rest.
"""

import time

from solver import PAPER, Run, Setup, SolverOptions, Stylization, rest_mesh

from .meshes import read
from .our_solver import energy_of

PATIENCE, ENOUGH = 200, 1e-8
"""iterations in which the energy has to fall by so much, relative"""


def find_best(path, cubeness, seconds):
    """Return the lowest energy found and what found it; so long in each of two descents."""
    setup = Setup(rest_mesh(*read(path), proxy=PAPER))
    state = Stylization(setup, cubeness)
    positions = _descend(state, Run(state, tolerance=1e-12, max_iterations=10**9).advance, seconds)
    accelerated = energy_of(setup, cubeness, positions)
    state = Stylization(setup, cubeness, options=SolverOptions(is_accelerated=False))
    state.energy_of(positions)
    plain = energy_of(setup, cubeness, _descend(state, state.step, seconds))
    if accelerated <= plain:
        return accelerated, "accelerated"
    return plain, "accelerated, then plain"


def _descend(state, advance, seconds):
    """Return the positions at which the energy no longer falls, or the time is over."""
    end = time.perf_counter() + seconds
    marks = []
    while time.perf_counter() < end:
        before = state.iterations
        advance()
        if state.iterations > before:
            marks.append(state.energy.total)
        if len(marks) > PATIENCE and marks[-PATIENCE] - min(marks[-10:]) < ENOUGH * marks[-1]:
            break
    return state.placed_positions()
