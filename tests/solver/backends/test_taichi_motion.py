# SPDX-License-Identifier: GPL-3.0-or-later
"""The kernels of the iteration on large meshes do what NumPy and SciPy do."""

from dataclasses import astuple

import numpy as np
import pytest
import shapes
from engine_marks import needs_engine
from optional_marks import needs

from solver import PAPER, Pose, Setup, SolverOptions, Stylization, rest_mesh, stylize
from solver.global_step.motion import Motion

pytestmark = [needs("pyamg"), needs_engine]


@pytest.fixture(autouse=True)
def multigrid_with_some_levels(monkeypatch):
    monkeypatch.setattr("solver.global_step.step.FACTORIZED_VERTICES", 0)
    monkeypatch.setattr("solver.global_step.multigrid._COARSEST", 20)


def stylization(name="blob", pins=0, **options):
    V, F = shapes.ALL[name]()
    pinned = np.argsort(V[:, 2])[:pins]
    pose = Pose(targets=V + [0.0, 0.1, 0.2])
    options = SolverOptions(**{"device": "cpu"} | options)
    return Stylization(Setup(rest_mesh(V, F, PAPER), pinned), 0.5, pose, options)


@pytest.mark.parametrize("coarsest", [20, 10_000])
@pytest.mark.parametrize("name", shapes.ALL)
def test_the_cycle_is_that_of_scipy(name, coarsest, monkeypatch):
    from solver.backends.arrays import HostArrays
    from solver.backends.taichi_cycle import TaichiCycle

    monkeypatch.setattr("solver.global_step.multigrid._COARSEST", coarsest)
    state = stylization(name)
    multigrid = state.setup.global_step.multigrid
    assert bool(multigrid.levels) == (coarsest == 20)
    cycle = TaichiCycle(multigrid, HostArrays())
    B = np.random.default_rng(2).normal(size=(3, len(multigrid.scale))).astype(np.float32)
    B *= multigrid.scale > 0.0
    count = B.shape[1]
    cycle.B[:count, :3] = B.T
    cycle.run()
    expected = multigrid._cycle(B, 0)
    np.testing.assert_allclose(cycle.X[:count, :3], expected.T, atol=2e-5 * np.abs(expected).max())
    assert not cycle.X[:, 3].any()


@pytest.mark.parametrize("keep_rotation", [True, False])
@pytest.mark.parametrize("pins", [0, 12])
@pytest.mark.parametrize("name", shapes.ALL)
def test_a_step_is_that_of_numpy(name, pins, keep_rotation):
    state = stylization(name, pins)
    fast, plain = state._motion, Motion(state.setup, state._local, state.positions)
    for size in (0.0, 0.3, 0.7):
        state._local.update(plain.point)
        momentum = np.full(state.rest.topology.component_count, size)
        further = 0.7 - momentum
        measured = fast.step(momentum, further, keep_rotation)
        expected = plain.step(momentum, further, keep_rotation)
        np.testing.assert_allclose(measured, expected, rtol=1e-4)
        np.testing.assert_allclose(fast.positions, plain.positions, atol=1e-6)
        np.testing.assert_allclose(fast.point, plain.point, atol=2e-6)
        plain.put(fast.positions)  # or their ways would part where rounding decides
        plain.point = fast.point.copy()
    pinned = state.setup.pinned
    start = stylization(name, pins)
    np.testing.assert_array_equal(fast.positions[pinned], start.positions[pinned])


@pytest.mark.parametrize("name", shapes.ALL)
def test_energies_are_those_of_numpy(name):
    fast, plain = (stylization(name, device=device) for device in ("cpu", "numpy"))
    V, _ = shapes.ALL[name]()
    for amount in (0.0, 0.02, 0.05):
        energies = [state.energy_of(V + amount * np.sin(4 * V), steps=5) for state in (fast, plain)]
        np.testing.assert_allclose(*map(astuple, energies), rtol=1e-6, atol=1e-12)


def test_a_run_in_single_precision_is_not_held_up_by_the_rounding_of_its_energy():
    """It would take about 700 iterations, where it takes 100 to 500, by how processors round."""
    V, F = shapes.blob(2)
    V, F = np.concatenate([V, 0.01 * V + [3.0, 0.0, 0.0]]), np.concatenate([F, F + len(V)])
    bumpy = (V + 1e-4 * k * np.sin(5.0 * V) for k in range(5))
    options = {"device": "cpu", "precision": "f32", "tolerance": 1e-5}
    results = [stylize(V, F, 0.4, proxy=PAPER, **options) for V in bumpy]
    assert all(result.converged for result in results)
    assert np.median([result.iterations for result in results]) < 550
