# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever the mesh: the energy of the plain iteration never rises, in any of many parts."""

import numpy as np
import pytest
from budget import examples
from hostile_runs import DEVICES, NOTHING, ROUNDING, cases, check_result, prepared, run
from hypothesis import given
from pieces import PIECES

from solver import PAPER, stylize


@examples(40)
@given(case=cases())
def test_the_energy_of_the_plain_iteration_never_rises(case):
    mesh, options, device = case
    result, rounds = run(prepared(mesh, options), options, device, is_accelerated=False)
    check_result(mesh, options, result)
    for energies in rounds:
        assert np.diff(energies).max(initial=0.0) <= ROUNDING * abs(energies[0]) + NOTHING


@pytest.mark.parametrize("device", sorted(set(DEVICES)))
def test_thousands_of_parts(device):
    """Each part does as it would alone, and none moves away."""
    count = 10_000 if device == "cpu" else 2_000  # NumPy is slower
    rng = np.random.default_rng(3)
    part = PIECES["ball"](rng, 1)
    turns = np.linalg.qr(rng.normal(size=(count, 3, 3)))[0]
    sizes = 10.0 ** rng.uniform(-5, -3, (count, 1, 1))
    V = sizes * (part.V @ turns.swapaxes(1, 2)) + rng.random((count, 1, 3))
    n = len(part.V)
    F = part.triangles + n * np.arange(count)[:, None, None]
    result = stylize(
        V.reshape(-1, 3), F.reshape(-1, 3), 0.4, device=device, max_iterations=5, proxy=PAPER
    )
    moved = (result.positions.reshape(V.shape) - V) / sizes
    assert np.isfinite(moved).all()
    assert np.abs(moved).max() < 1.0
    alone = stylize(V[7], part.triangles, 0.4, device=device, max_iterations=5, proxy=PAPER)
    assert np.abs((alone.positions - V[7]) / sizes[7] - moved[7]).max() < 1e-6
