# SPDX-License-Identifier: GPL-3.0-or-later
"""The start from coarser meshes: the same shape in fewer iterations."""

import numpy as np
import pytest
import shapes
from devices import by_device
from optional_marks import needs

from solver import PAPER, Run, Setup, SolverOptions, Style, Stylization, rest_mesh, stylize
from solver.coarse_to_fine.start import _smoothed

pytestmark = needs("pyamg")


@pytest.fixture
def large(monkeypatch):
    """Let a test's meshes count as large."""

    def count_as_large(is_large=True):
        monkeypatch.setattr(
            "solver.coarse_to_fine.start.LEAST_VERTICES", 500 if is_large else 10**9
        )
        monkeypatch.setattr("solver.coarse_to_fine.start.COARSEST_VERTICES", 300)

    return count_as_large


@pytest.mark.thorough(1)
@pytest.mark.parametrize(("levels", "pins"), [(4, 0), (5, 800)])
def test_it_ends_no_higher_and_is_sooner_near_the_end(levels, pins, large, device):
    V, F = shapes.blob(levels)
    pinned = np.argsort(V[:, 2])[:pins]
    targets = V + np.where(V[:, 2:] < V[pinned, 2].max(initial=-9.0), 0.1, 0.0)

    def solved(is_large):
        large(is_large)
        energies = []
        options = {"targets": targets, "device": device, "tolerance": 1e-4}
        options["on_iteration"] = lambda state: energies.append(state.energy.total)
        return stylize(V, F, 0.5, pinned, proxy=PAPER, **options), energies

    from_rest, energies_from_rest = solved(False)
    from_coarse, energies_from_coarse = solved(True)
    assert from_coarse.converged
    assert from_coarse.energy.total <= from_rest.energy.total * (1 + 1e-3)
    near = from_rest.energy.total * (1 + 1e-3)
    sooner, later = (
        next(number for number, energy in enumerate(energies) if energy <= near)
        for energies in (energies_from_coarse, energies_from_rest)
    )
    assert sooner < by_device(device, 0.75, 0.9) * later
    np.testing.assert_array_equal(from_coarse.positions[pinned], targets[pinned])


def gaps_of_first_iterations(V, F, tolerance, large, device):
    """Return how far from the end the first iteration is from rest, and from a coarser mesh."""
    options = {"device": device, "keep_rotation": True}
    large(False)
    end = stylize(V, F, 0.5, tolerance=tolerance, proxy=PAPER, **options).energy.total
    gaps = []
    for is_large in (False, True):
        large(is_large)
        gaps.append(stylize(V, F, 0.5, max_iterations=1, proxy=PAPER, **options).energy.total - end)
    return gaps


@pytest.mark.thorough(2)
@pytest.mark.parametrize("is_ordered", [False, True])
def test_the_first_iteration_is_near_the_end(is_ordered, large, device, monkeypatch):
    if is_ordered:  # the vertices of a coarser mesh have then another order than it was made in
        monkeypatch.setattr("solver.proxy.surface.REORDERED_FROM", 300)
    from_rest, from_coarse = gaps_of_first_iterations(*shapes.blob(5), 1e-3, large, device)
    assert from_coarse < 0.5 * from_rest


def test_maps_and_orientations_per_vertex_are_carried_down(large, device):
    V, F = shapes.blob(4)
    cubeness = np.where(V[:, 0] > 0.0, 1.0, 0.0)
    Q = np.tile(shapes.rotation(0.0, 0.0, 30.0), (len(V), 1, 1))
    large()
    stylization = Stylization(
        Setup(rest_mesh(V, F, PAPER)), Style(cubeness, Q), options=SolverOptions(device=device)
    )
    coarse = stylization.coarser()
    x = stylization.rest.box.from_unit(coarse.rest.input_positions)[:, 0]
    inside = np.abs(x) > 0.2
    np.testing.assert_array_equal(coarse._style.lam[inside], np.where(x > 0.0, 1.0, 0.0)[inside])
    result = stylize(V, F, cubeness, orientation=Q, device=device, proxy=PAPER)
    from_one = stylize(V, F, cubeness, orientation=Q[0], device=device, proxy=PAPER)
    np.testing.assert_allclose(
        result.positions, from_one.positions, atol=by_device(device, 1e-9, 1e-5)
    )


def test_slicing_and_repeating_change_no_bit(large, device):
    V, F = shapes.blob(4)
    large()
    whole = stylize(V, F, 0.4, device=device, proxy=PAPER)
    run = Run(Stylization(Setup(rest_mesh(V, F, PAPER)), 0.4, options=SolverOptions(device=device)))
    phases = 0
    assert run.so_far() is None
    while run.reason is None:
        run.advance()
        phases += 1
        if phases % 7 == 0:  # asked for at any time, on coarse meshes too
            so_far = run.so_far()
            np.testing.assert_array_equal(so_far.positions, run.positions())
            assert so_far.energy.total > 0.0 and so_far.converged == (run.reason is not None)
    assert phases > 2 * run.stylization.iterations  # those of the coarse meshes, too
    np.testing.assert_array_equal(run.result().positions, whole.positions)


def test_a_run_can_be_cancelled_on_coarser_meshes(large, device):
    V, F = shapes.blob(4)
    large()
    seen = []

    def on_iteration(state):
        seen.append(state.is_coarse)
        return len(seen) == stop

    stop = 0
    run = Run(Stylization(Setup(rest_mesh(V, F, PAPER)), 0.4, options=SolverOptions(device=device)))
    run.complete(on_iteration)
    assert seen == sorted(seen, reverse=True) and len(seen) == run.iterations
    assert sum(seen) > 3 and run.reason == "converged"
    seen, stop = [], 3
    result = stylize(V, F, 0.4, device=device, proxy=PAPER, on_iteration=on_iteration)
    assert (seen, result.reason, result.iterations) == ([True] * 3, "cancelled", 0)
    moved = np.linalg.norm(result.positions - V, axis=1)
    assert 0.0 < moved.max() < 0.5 and result.energy.total > 0.0


def test_where_nothing_is_left_free_it_starts_from_rest(large, device):
    V, F = shapes.blob()
    large()
    pinned = np.delete(np.arange(len(V)), 7)
    result = stylize(V, F, 0.4, pinned, device=device, proxy=PAPER)
    np.testing.assert_array_equal(result.positions[pinned], V[pinned])


def test_small_meshes_and_the_plain_iteration_start_from_rest(large):
    setup = Setup(rest_mesh(*shapes.blob(), proxy=PAPER))
    assert Run(Stylization(setup, 0.4, options=SolverOptions(device="numpy")))._coarse is None
    large()
    assert Run(Stylization(setup, 0.4, options=SolverOptions(device="numpy")))._coarse is not None
    assert (
        Run(
            Stylization(setup, 0.4, options=SolverOptions(device="numpy", is_accelerated=False))
        )._coarse
        is None
    )


def test_what_it_has_come_to_on_coarser_meshes_can_be_seen(large, device):
    V, F = shapes.blob(4)
    large()
    setup = Setup(rest_mesh(V, F, PAPER))
    run = Run(Stylization(setup, 0.5, options=SolverOptions(device=device, keep_rotation=True)))
    end = stylize(V, F, 0.5, device=device, keep_rotation=True, proxy=PAPER).positions
    seen, counts = [], []
    while run.is_on_coarser_mesh:
        run.advance()
        positions, rotations = run.placed()
        np.testing.assert_array_equal(run.positions(), positions)
        np.testing.assert_allclose(
            np.linalg.det(rotations), 1.0, atol=by_device(device, 1e-9, 1e-6)
        )
        seen.append(np.linalg.norm(positions - end, axis=1).max())
        counts.append(run.iterations)
    assert (np.diff(counts) >= 0).all() and counts[-1] > 10
    assert run.stylization.iterations == 0
    assert min(seen) < 0.8 * np.linalg.norm(V - end, axis=1).max()


def test_rotations_are_averaged_over_the_neighbours():
    V, F = shapes.blob(4)
    rest = rest_mesh(V, F, PAPER)
    one = shapes.rotation(10.0, 20.0, 30.0)
    np.testing.assert_allclose(
        _smoothed(rest, np.tile(one, (len(rest.coarse.rest.V), 1, 1))),
        one + np.zeros((len(rest.V), 3, 3)),
    )
    angles = 20.0 * rest.coarse.rest.V[:, 0]
    R = np.stack([shapes.rotation(0.0, 0.0, angle) for angle in angles])
    smoothed = _smoothed(rest, R)
    i, j = rest.F[:, 0], rest.F[:, 1]

    def steps(R):
        return np.linalg.norm(R[i] - R[j], axis=(1, 2)).max()

    assert steps(smoothed) < 0.7 * steps(R[rest.coarse.cluster])
