# SPDX-License-Identifier: GPL-3.0-or-later
"""The acceleration changes nothing but the number of iterations."""

import numpy as np
import pytest
import shapes

from solver import stylize
from solver.acceleration import FURTHER, Momentum


@pytest.mark.parametrize("name", ["blob", "skewed_blob", "sphere"])
@pytest.mark.parametrize("cubeness", [0.2, 0.8])
def test_it_ends_where_the_plain_iteration_does_in_fewer_iterations(name, cubeness, device):
    V, F = shapes.ALL[name]()
    runs = [
        stylize(V, F, cubeness, device=device, is_accelerated=is_accelerated, tolerance=1e-5)
        for is_accelerated in (True, False)
    ]
    fast, plain = runs
    assert fast.converged and fast.iterations < plain.iterations
    assert fast.energy.total <= plain.energy.total * (1 + 1e-6)


def test_the_momentum_of_a_component_is_its_own():
    component = np.array([0, 0, 1])
    both = Momentum(component, 2)
    alone = [Momentum(np.zeros(2, int), 1), Momentum(np.zeros(1, int), 1)]
    random = np.random.default_rng(3)
    for step in range(6):
        new, old, start = random.normal(size=(3, 3, 3))
        energies = np.array([-float(step), float(step == 3)])  # the second one rises once
        both.see(energies)
        alone[0].see(energies[:1])
        alone[1].see(energies[1:])
        expected = [
            alone[0].extrapolate(new[:2], old[:2], start[:2]),
            alone[1].extrapolate(new[2:], old[2:], start[2:]),
        ]
        np.testing.assert_allclose(both.extrapolate(new, old, start), np.concatenate(expected))


def test_momentum_grows_until_the_energy_rises():
    momentum = Momentum(np.zeros(4, int), 1)
    new, old = np.ones((4, 3)), np.zeros((4, 3))

    def extrapolated(energy):
        momentum.see(np.array([energy]))
        return momentum.extrapolate(new, old, new).max()  # no further step

    first, second, third = (extrapolated(energy) for energy in (5.0, 4.0, 3.0))
    assert 1.0 < first < second < third < 2.0
    assert extrapolated(3.1) == 1.0
    assert 1.0 < extrapolated(3.0) < first


def test_it_goes_further_along_the_step():
    momentum = Momentum(np.zeros(4, int), 1)
    new, start = np.ones((4, 3)), np.zeros((4, 3))
    point = momentum.extrapolate(new, new, start)  # no momentum
    assert 1.0 < point.min() == point.max() < 1.0 + FURTHER
