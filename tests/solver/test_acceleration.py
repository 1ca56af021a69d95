# SPDX-License-Identifier: GPL-3.0-or-later
"""The acceleration changes nothing but the number of iterations."""

import numpy as np
import pytest
import shapes

from solver import stylize
from solver.acceleration import Nesterov


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
    both, alone = Nesterov(2), [Nesterov(1), Nesterov(1)]
    for step in range(6):
        energies = np.array([-float(step), float(step == 3)])  # the second one rises once
        both.see(energies)
        expected = []
        for nesterov, energy in zip(alone, energies, strict=True):
            nesterov.see(np.array([energy]))
            expected.append(nesterov.momentum()[0])
        np.testing.assert_array_equal(both.momentum(), expected)
    assert expected[0] > expected[1]


def test_it_starts_without_momentum_and_restarts_when_the_energy_rises():
    nesterov = Nesterov(1)
    nesterov.see(np.array([5.0]))
    assert nesterov.momentum() == 0.0
    nesterov.see(np.array([4.0]))
    assert nesterov.momentum() > 0.2
    nesterov.see(np.array([4.1]))
    assert nesterov.momentum() == 0.0
