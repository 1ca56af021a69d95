# SPDX-License-Identifier: GPL-3.0-or-later
"""Large parts that touch others at a few places do not turn: no post of a lamp leans."""

import numpy as np
import proxy_shapes
import pytest
import shapes
from devices import by_device
from procrustes import degrees

from solver import ProxyOptions, Setup, SolverOptions, Stylization, rest_mesh, run
from solver.limbs.covering import COVERING


def solid(*outline, sides=20):
    """Return the closed solid of revolution of an outline (radius, height)."""
    V, F = proxy_shapes.revolved(outline, sides)
    i, last, n = np.arange(sides), len(V) - sides, len(V)
    j = (i + 1) % sides
    lids = [np.stack([j, i, 0 * i + n], 1), np.stack([last + i, last + j, 0 * i + n + 1], 1)]
    ends = [[0, 0, outline[0][1]], [0, 0, outline[-1][1]]]
    return np.concatenate([V, ends]), np.concatenate([F, *lids])


def lamp():
    """Return base, post, bulb and roof, which stand on each other."""
    return proxy_shapes.joined(
        solid((0.4, 0.0), (0.4, 0.15)),
        solid((0.08, 0.15), (0.08, 2.35), sides=12),
        solid((0.1, 2.32), (0.3, 2.45), (0.35, 2.65), (0.3, 2.85), (0.1, 2.98)),
        solid((0.5, 2.95), (0.1, 3.25)),
    )


def leaning(mesh, cubeness):
    """Return how far each part of a mesh turns."""
    rest = rest_mesh(*mesh, ProxyOptions())
    result = run(Stylization(Setup(rest), cubeness, options=SolverOptions(keep_rotation=True)))
    part = rest.topology.part[rest.place[1]]
    return [degrees(mesh[0][part == k], result.positions[part == k]) for k in range(part.max() + 1)]


@pytest.mark.thorough(2)
@pytest.mark.parametrize("cubeness", [0.2, 0.4, 1.0])
def test_no_part_of_a_lamp_leans(cubeness, monkeypatch):
    _, post, _, roof = leaning(lamp(), cubeness)
    assert post < 2.5 and roof < 4.0
    if cubeness == 0.4:
        monkeypatch.setattr("solver.global_step.upright_parts.LARGE", 9.0)
        assert max(leaning(lamp(), cubeness)) > 3.0, "it shows nothing"


def figure_of_parts():
    """Return a trunk with arms of a shoulder, an elbow and two rods each, which overlap."""
    rod = solid(*((0.1, z) for z in np.linspace(0.05, 0.6, 8)), sides=24)
    ball = solid(*((0.13 * np.sin(a), -0.13 * np.cos(a)) for a in np.linspace(0.1, 3.0, 13)))
    trunk = solid(*((0.35 + 0.1 * np.sin(4 * z), z) for z in np.linspace(-0.5, 0.2, 9)), sides=40)
    arms = []
    for side in (-1.0, 1.0):
        place = np.array([side * 0.52, 0.0, 0.0])
        for way in ([side * 0.75, 0.0, -0.66], [side * 0.2, -0.3, -0.93]):
            turn = np.linalg.qr(np.column_stack([way, [0, 1, 0], [1, 0, 0]]))[0][:, [1, 2, 0]]
            turn = turn * np.sign([1.0, np.linalg.det(turn) * (turn[:, 2] @ way), turn[:, 2] @ way])
            arms += [(V @ turn.T + place, F) for V, F in (ball, rod)]
            place = place + 0.6 * np.array(way)
    return proxy_shapes.joined(trunk, *arms)


def test_no_part_of_a_figure_of_parts_turns(monkeypatch):
    assert max(leaning(figure_of_parts(), 0.4)) < 1.0
    monkeypatch.setattr("solver.global_step.upright_parts.LARGE", 0.25)
    assert max(leaning(figure_of_parts(), 0.4)) > 1.5, "it shows nothing"


def test_the_energy_falls_and_nothing_turns():
    rest = rest_mesh(*lamp(), ProxyOptions(keep_apart=False))
    setup = Setup(rest)
    state = Stylization(setup, 0.4, options=SolverOptions(keep_rotation=True, is_accelerated=False))
    energies = []
    run(state, 40, 1e-12, lambda s: energies.append(s.energy.total))
    assert np.diff(energies).max() <= 1e-12
    assert setup.global_step.upright_parts.is_kept.all()
    assert asymmetry(rest, state.positions) < 1e-7


def test_nothing_turns_where_a_factorisation_would_be_too_large(device, monkeypatch):
    monkeypatch.setattr("solver.global_step.step.FACTORIZED_VERTICES", 1000)
    rest = rest_mesh(*lamp(), ProxyOptions())
    turned = []
    for is_kept in (True, False):
        state = Stylization(
            Setup(rest), 0.4, options=SolverOptions(keep_rotation=is_kept, device=device)
        )
        for _ in range(30):
            state.step()
        turned.append(asymmetry(rest, state.positions))
    assert turned[0] < by_device(device, 1e-9, 1e-5) and turned[1] > 1e-3


def asymmetry(rest, U):
    """Return how much the post, the roof and all have turned at most: the relative torque."""
    worst = 0.0
    for vertices in (rest.topology.part == 1, rest.topology.part == 3, slice(None)):
        weights = rest.standing[vertices]
        both = (X[vertices] for X in (rest.V, U))
        before, now = (X - np.average(X, axis=0, weights=weights) for X in both)
        covariance = (before * weights[:, None]).T @ now
        worst = max(worst, np.abs(covariance - covariance.T).max() / np.abs(covariance).max())
    return worst


def test_several_do_as_each_would_alone():
    V, F = lamp()
    far = V + [4.0, 0.0, 0.0]
    options = ProxyOptions(
        solidity=0.1, keep_pose=False, detail=0.0
    )  # their sample of thickness is another
    both = rest_mesh(*proxy_shapes.joined((V, F), (far, F)), options)
    one = rest_mesh(V, F, options)
    together, alone = (
        run(Stylization(Setup(rest), 0.4, options=SolverOptions(keep_rotation=True)), 400, 1e-6)
        for rest in (both, one)
    )
    assert Setup(both).global_step.upright_parts.is_kept.tolist() == [True, True]
    for moved in (together.positions[: len(V)] - V, together.positions[len(V) :] - far):
        assert np.abs(moved - (alone.positions - V)).max() < 0.04


def test_many_small_components_obey_as_each_does_alone(monkeypatch):
    V, F = lamp()
    rest = rest_mesh(*proxy_shapes.joined((V, F), (V + [4.0, 0.0, 0.0], F)), ProxyOptions())
    turned = rest.V + 0.1 * np.random.default_rng(0).normal(size=rest.V.shape)
    found = []
    for many in (3, 2):
        monkeypatch.setattr("solver.global_step.upright_parts.MANY", many)
        found.append(turned.copy())
        Setup(rest).global_step.upright_parts.impose(found[-1])
    assert np.abs(found[0] - turned).max() > 1e-3
    np.testing.assert_allclose(*found, rtol=0.0, atol=1e-12)


def test_a_shirt_follows_what_it_covers():
    rest = rest_mesh(*proxy_shapes.blob_with_shirt(), ProxyOptions())
    body, shirt = rest.linked_share
    assert body < COVERING < shirt


def test_a_part_that_is_pinned_frees_the_others():
    setup = Setup(rest_mesh(*lamp(), ProxyOptions()), pinned=[0])
    assert not setup.global_step.upright_parts.is_kept.any()


def test_another_pose_has_constraints_of_its_own():
    V, F = lamp()
    rest = rest_mesh(V, F, ProxyOptions())
    turned = V @ shapes.rotation(0, 0, 30).T
    posed = Setup(rest).posed(turned)
    result = run(Stylization(posed, 0.2, options=SolverOptions(keep_rotation=True)))
    part = rest.topology.part[rest.place[1]] == 1
    assert degrees(turned[part], result.positions[part]) < 2.5
