# SPDX-License-Identifier: GPL-3.0-or-later
"""The acceleration changes nothing but the number of iterations."""

import numpy as np
import pytest
import shapes
from devices import by_device

from solver import PAPER, Setup, Stylization, rest_mesh, stylize
from solver.iteration.acceleration import Momentum

SHAPES = {"blob": shapes.blob(2), "sphere": shapes.sphere(), "skewed_blob": shapes.skewed_blob()}


@pytest.mark.thorough(1)
@pytest.mark.parametrize("name", SHAPES)
@pytest.mark.parametrize("cubeness", [0.2, 0.8])
def test_it_ends_where_the_plain_iteration_does_in_fewer_iterations(name, cubeness, device):
    V, F = SHAPES[name]
    runs = [
        stylize(
            V,
            F,
            cubeness,
            device=device,
            is_accelerated=is_accelerated,
            tolerance=1e-5,
            proxy=PAPER,
        )
        for is_accelerated in (True, False)
    ]
    fast, plain = runs
    assert fast.converged and fast.iterations < plain.iterations
    assert fast.energy.total <= plain.energy.total * (1 + by_device(device, 1e-6, 1e-5))


def test_the_momentum_of_a_component_is_its_own():
    both, alone = Momentum(2), [Momentum(1), Momentum(1)]
    for step in range(6):
        energies = np.array([-float(step), float(step == 3)])  # the second one rises once
        both.observe(energies)
        expected = []
        for momentum, energy in zip(alone, energies, strict=True):
            momentum.observe(np.array([energy]))
            expected.append(np.concatenate(momentum.next()))
        np.testing.assert_array_equal(np.stack(both.next(), axis=1), expected)
    assert (expected[0] > expected[1]).all()


def test_momentum_grows_until_the_energy_rises():
    momentum = Momentum(1)

    def after(energy):
        momentum.observe(np.array([energy]))
        return momentum.next()[0]

    first, second, third = (after(energy) for energy in (5.0, 4.0, 3.0))
    assert 0.0 < first < second < third < 1.0
    after_a_rise = after(3.1)
    assert 0.0 < after_a_rise < first
    assert after(3.2) == 0.0
    assert 0.0 < after(3.1) < after_a_rise


@pytest.mark.parametrize("is_large", [False, True])
def test_the_next_point_lies_beyond_the_new_positions(is_large, monkeypatch):
    pytest.importorskip("pyamg")
    monkeypatch.setattr("solver.global_step.step.FACTORIZED_VERTICES", 100 if is_large else 10**9)
    V, F = shapes.blob()
    state = Stylization(Setup(rest_mesh(V, F, PAPER)), 0.4)
    state.step()
    old, start = state.positions, state._motion.point.copy()
    state.step()
    new = state.positions
    momentum = Momentum(1)
    momentum.next()
    for_way, for_step = momentum.next()
    expected = new + for_way * (new - old) + for_step * (new - start)
    np.testing.assert_allclose(state._motion.point, expected, rtol=0, atol=1e-12)
