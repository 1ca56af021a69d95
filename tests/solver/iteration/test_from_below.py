# SPDX-License-Identifier: GPL-3.0-or-later
"""A high cubeness ends in a minimum as good as one that is reached from below."""

import numpy as np
import pytest
import shapes
from facing import share_facing
from named_forms import POLYTOPES

from solver import (
    PAPER,
    Run,
    Setup,
    SolverOptions,
    Style,
    Stylization,
    rest_mesh,
    run,
)

V, F = shapes.sphere(4)
BALL = Setup(rest_mesh(V, F, PAPER))
LEAST = {"cube": 0.86, "rhombic dodecahedron": 0.83, "prism of 6": 0.86, "tetrahedron": 0.68}


def stylization(cubeness, form=None, device="auto"):
    return Stylization(BALL, Style(cubeness, form=form), options=SolverOptions(device=device))


def ramp(cubeness, form):
    """Return the energy at the end of runs that each begin where the one before has ended."""
    before = None
    for value in [value for value in (1.0, 2.0, 4.0, 8.0) if value < cubeness] + [cubeness]:
        state = stylization(value, form)
        if before is not None:
            state.start_from(before.rotations, before.positions.copy())
        energy, before = run(state).energy.total, state
    return energy


@pytest.mark.thorough(2)
@pytest.mark.parametrize("cubeness", [3.5, 10.0, 2.0])
@pytest.mark.parametrize("name", LEAST)
def test_a_ball_ends_as_well_as_from_below(name, cubeness):
    form = None if name == "cube" else POLYTOPES[name]()
    result = run(stylization(cubeness, form))
    assert result.converged
    assert result.energy.total <= ramp(cubeness, form) * (1 + 1e-3)
    assert share_facing(result.positions, F, POLYTOPES[name]().normals) > LEAST[name]


@pytest.mark.parametrize("cubeness, is_same", [(1.0, True), (np.abs(V[:, 0]), True), (1.1, False)])
def test_up_to_1_a_run_only_iterates(cubeness, is_same, device):
    by_run, by_hand = (stylization(cubeness, device=device) for _ in range(2))
    run(by_run)
    for _ in range(by_run.iterations):
        by_hand.step()
    assert np.array_equal(by_run.positions, by_hand.positions) == is_same


@pytest.mark.parametrize("most", [1, 2, 7, 25])
def test_stages_count_and_the_energy_is_that_of_the_cubeness_itself(most, device):
    steps = Run(stylization(6.0, device=device), max_iterations=most)
    limited = []
    steps.complete(lambda state: limited.append(state.is_limited))
    assert steps.reason == "max_iterations" and len(limited) == most
    assert limited == [True] * (most // 2) + [False] * (most - most // 2)
    cancelled = run(stylization(6.0, device=device), on_iteration=lambda state: state.is_limited)
    assert cancelled.reason == "cancelled" and cancelled.energy.cubic > 6.0 * np.pi


def test_neither_a_started_nor_a_plain_iteration_has_stages():
    started = stylization(3.0)
    started.start_from(started.rotations, V.copy())
    plain = Stylization(BALL, 3.0, options=SolverOptions(device="numpy", is_accelerated=False))
    for state in (started, plain):
        Run(state).advance()
        assert not state.is_limited and state.energy is not None
