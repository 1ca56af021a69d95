# SPDX-License-Identifier: GPL-3.0-or-later
"""A run goes on when its rest shape moves, with the weights and the factorisation it has."""

import numpy as np
import pytest
from shapes import blob

from solver import PAPER, Pose, ProxyOptions, Run, Setup, SolverOptions, Stylization, rest_mesh, run

OPTIONS = (ProxyOptions(refine=False), ProxyOptions(refine=False, detail=0.0, keep_pose=False))


def pushed(V, by=0.1):
    """Return positions with a bump, as of one stroke."""
    near = np.exp(-np.sum((V - V[3]) ** 2, axis=1) / 0.2)
    return V + by * near[:, None] * V[3]


def ended(stylization, steps=200):
    done = Run(stylization, steps, keep_apart=False)
    done.complete()
    return done.result()


@pytest.mark.parametrize("proxy", OPTIONS)
def test_it_ends_near_a_new_run_after_fewer_steps(proxy):
    V, F = blob(3)
    setup = Setup(rest_mesh(V, F, proxy))
    before = Stylization(setup, 0.4, options=SolverOptions(device="numpy"))
    run(before)
    W = pushed(V)
    moved = ended(before.moved(setup.posed(W)))
    anew = ended(
        Stylization(Setup(rest_mesh(W, F, proxy)), 0.4, options=SolverOptions(device="numpy"))
    )
    assert moved.converged and moved.iterations < anew.iterations
    assert moved.energy.total == pytest.approx(anew.energy.total, rel=0.03)
    change = np.abs(anew.positions - W).max()
    assert np.sqrt(np.mean((moved.positions - anew.positions) ** 2)) < 0.05 * change


def test_the_run_that_it_goes_on_from_is_left_alone():
    V, F = blob(2)
    setup = Setup(rest_mesh(V, F, PAPER))
    before = Stylization(setup, 0.4, options=SolverOptions(device="numpy"))
    for _ in range(5):
        before.step()
    positions, rotations = before.positions.copy(), before.rotations.copy()
    moved = before.moved(setup.posed(pushed(V)))
    moved.step()
    assert (before.positions == positions).all() and (before.rotations == rotations).all()
    assert before.iterations == 5 and moved.iterations == 1


def test_pins_go_to_their_new_targets():
    V, F = blob(2)
    setup = Setup(rest_mesh(V, F, PAPER), [0, 5])
    before = Stylization(setup, 0.4, options=SolverOptions(device="numpy"))
    before.step()
    W = pushed(V)
    targets = W.copy()
    targets[5] += 0.1
    moved = before.moved(setup.posed(W), Pose(targets=targets))
    moved.step()
    assert (moved.placed_positions()[[0, 5]] == targets[[0, 5]]).all()


def test_weights_serve_until_the_surface_is_stretched_far():
    V, F = blob(2)
    setup = Setup(rest_mesh(V, F, PAPER))
    assert setup.serves(setup.posed(pushed(V)))
    assert not setup.serves(setup.posed(pushed(V, by=8.0)))
