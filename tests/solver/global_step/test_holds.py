# SPDX-License-Identifier: GPL-3.0-or-later
"""Groups that keep their place and rotation while their surface becomes cubic."""

import numpy as np
import pytest
from devices import by_device
from shapes import blob, rotation, two_blobs

import solver.global_step.step as global_step
from solver import (
    PAPER,
    Pose,
    ProxyOptions,
    Setup,
    SolverOptions,
    Stylization,
    edge_distances,
    rest_mesh,
    run,
    svd_rotations,
)

PROXIES = pytest.mark.parametrize("proxy", [PAPER, ProxyOptions()], ids=["paper", "default"])


def turned_and_moved(angle=0.4, by=(0.1, -0.2, 0.3)):
    matrix = np.eye(4)
    matrix[:3, :3] = rotation(z=angle, x=0.2)
    matrix[:3, 3] = by
    return matrix


def pose_of(state, weights):
    """Return the rotation of a group and its centroids at rest and now, as they are measured."""
    rest = state.rest
    w = rest.input_map.spread(weights) * rest.standing
    w[state.setup.pinned] = 0.0
    w /= w.sum()
    V, U = rest.V, state.positions
    start, end = w @ V, w @ U
    R = svd_rotations((((V - start) * w[:, None]).T @ (U - end))[None])[0]
    return R, rest.box.from_unit(start[None])[0], rest.box.from_unit(end[None])[0]


@pytest.mark.thorough(2)
@PROXIES
def test_a_group_goes_where_it_is_asked_to_and_becomes_cubic(proxy, device):
    V, F = blob()
    rest = rest_mesh(V, F, proxy)
    weights = (V[:, 0] > 0.3).astype(float)
    matrix = turned_and_moved()
    setup = Setup(rest, np.flatnonzero(V[:, 0] < -0.5)).with_holds([weights])
    state = Stylization(setup, 0.4, Pose(hold_matrices=[matrix]), SolverOptions(device=device))
    result = run(state, 100)
    R, start, end = pose_of(state, weights)
    assert end == pytest.approx(
        matrix[:3, :3] @ start + matrix[:3, 3], abs=by_device(device, 1e-9, 1e-6)
    )
    assert pytest.approx(matrix[:3, :3], abs=by_device(device, 1e-6, 1e-4)) == R
    group = weights > 0
    rigid = V[group] @ matrix[:3, :3].T + matrix[:3, 3]
    assert np.abs(result.positions[group] - rigid).max() > 0.02


@pytest.mark.thorough(2)
@PROXIES
@pytest.mark.parametrize("pins", [False, True])
def test_the_energy_of_the_plain_iteration_falls(proxy, pins):
    V, F = blob()
    pinned = np.flatnonzero(V[:, 2] < -0.6) if pins else ()
    setup = Setup(rest_mesh(V, F, proxy), pinned).with_holds(
        [(V[:, 0] > 0.3).astype(float), (V[:, 0] < -0.3).astype(float)]
    )
    matrices = [turned_and_moved(), np.eye(4)]
    state = Stylization(
        setup,
        0.4,
        Pose(hold_matrices=matrices),
        SolverOptions(device="numpy", is_accelerated=False),
    )
    energies = []
    for _ in range(30):
        state.step()
        energies.append(state.energy.total)
    # The first step is the one that obeys the constraints.
    assert (np.diff(energies[1:]) <= 1e-12).all()


def test_only_its_component_is_concerned():
    V, F = two_blobs()
    rest = rest_mesh(V, F, PAPER)
    first = np.zeros(len(V), dtype=bool)
    first[rest.used[rest.topology.component == 0]] = True
    setup = Setup(rest).with_holds([first.astype(float)])
    alone = run(Stylization(Setup(rest), 0.4, options=SolverOptions(device="numpy")), 20, 1e-9)
    matrix = np.eye(4)
    matrix[:3, 3] = 0.5
    held = run(
        Stylization(setup, 0.4, Pose(hold_matrices=[matrix]), SolverOptions(device="numpy")),
        20,
        1e-9,
    )
    assert (held.positions[~first] == alone.positions[~first]).all()
    moved = held.positions[first].mean(axis=0) - alone.positions[first].mean(axis=0)
    assert np.linalg.norm(moved) > 0.5


def test_multigrid_obeys_them_too(monkeypatch):
    V, F = blob(4)
    weights, matrix = (V[:, 0] > 0.3).astype(float), turned_and_moved()
    pinned = np.flatnonzero(V[:, 0] < -0.5)
    exact = run(
        Stylization(
            Setup(rest_mesh(V, F, PAPER), pinned).with_holds([weights]),
            0.4,
            Pose(hold_matrices=[matrix]),
        )
    )
    monkeypatch.setattr(global_step, "FACTORIZED_VERTICES", 100)
    rest = rest_mesh(V, F, PAPER)
    setup = Setup(rest, pinned).with_holds([weights])
    assert not setup.global_step.is_factorized
    state = Stylization(setup, 0.4, Pose(hold_matrices=[matrix]))
    result = run(state)
    assert result.converged
    R, start, end = pose_of(state, weights)
    assert end == pytest.approx(matrix[:3, :3] @ start + matrix[:3, 3], abs=1e-6)
    assert pytest.approx(matrix[:3, :3], abs=1e-4) == R
    assert result.energy.total == pytest.approx(exact.energy.total, rel=0.01)


def test_distances_along_edges():
    V = np.array([[0.0, 0, 0], [3, 0, 0], [3, 4, 0], [9, 9, 9], [9, 9, 9]])
    F = np.array([[0, 1, 2]])
    assert edge_distances(V, F, [0]).tolist() == [0.0, 3.0, 5.0, np.inf, np.inf]
    assert edge_distances(V, F, [0], 4.0).tolist() == [0.0, 3.0, np.inf, np.inf, np.inf]
    assert edge_distances(V, np.array([[3, 4, 0]]), [3])[4] < 1e-9
