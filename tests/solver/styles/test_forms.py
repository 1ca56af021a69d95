# SPDX-License-Identifier: GPL-3.0-or-later
"""Other forms than the cube: exact local steps, and what becomes of a ball."""

import numpy as np
import pytest
import shapes
from devices import by_device
from engine_marks import needs_engine
from facing import share_facing
from local_problems import (
    Q,
    active_set_beside_admm,
    blob,
    check_random_starts,
    deformed,
    objective,
    problem_of,
)
from named_forms import POLYTOPES

from solver import PAPER, Setup, SolverOptions, Style, Stylization, rest_mesh, run, stylize
from solver.backends import local_step_class
from solver.mesh.rest_measures import triangle_areas_and_normals
from solver.styles.active_set import active_set_rotations
from solver.styles.admm import AdmmOptions
from solver.styles.local_problem import LocalProblem
from solver.styles.polytope_step import polytopes

# Sides that reach far beyond the ball are harmonic surfaces that droop toward their corners.
LEAST_FLAT = {"tetrahedron": 0.7, "octahedron": 0.8, "pyramid": 0.8}
forms = pytest.mark.parametrize("name", POLYTOPES)


@pytest.mark.thorough(6)
@forms
@pytest.mark.parametrize("lam", [0.1, 0.6])
def test_the_active_set_is_as_good_as_a_tight_admm(name, lam):
    rest, form = blob(), POLYTOPES[name]()
    _, uncertified = active_set_beside_admm(
        lambda amount: problem_of(deformed(rest.V, amount), rest, lam, form)
    )
    assert uncertified <= 0.02 * 3 * len(rest.V)


@pytest.mark.parametrize("name", [None, *POLYTOPES])
def test_the_subgradient_certifies_the_minimiser(name):
    rest, form = blob(), name and POLYTOPES[name]()
    problem = problem_of(deformed(rest.V, 0.05), rest, 0.4, form)
    R = np.tile(np.eye(3), (len(rest.V), 1, 1))
    R, states, is_done = active_set_rotations(problem, R, problem.starting(R))
    assert is_done.mean() > (0.97 if form else 0.999)
    done, form = np.flatnonzero(is_done), form or POLYTOPES["cube"]()
    problem, R, s = problem.part(done), R[done], states[done, :3]
    assert (s @ form.normals.T - form.offsets).max() < 1e-8  # within the body
    x = problem.form_normals(R)
    np.testing.assert_allclose((s * x).sum(axis=1), form.cost(x), atol=1e-8)
    pull = np.einsum("nji,nj->ni", problem.Q, s) * problem.lam[:, None]
    G = R @ (problem.S - problem.normals[:, :, None] * pull[:, None, :])
    np.testing.assert_allclose(G, G.swapaxes(1, 2), atol=1e-7)  # stationary


@pytest.mark.thorough(4)
@forms
def test_no_start_leads_to_less_than_the_search_from_many(name):
    """Of one problem: the best of all vertices as starts is the best of 1,000 random starts."""
    random = np.random.default_rng(5)
    form, many = POLYTOPES[name](), 1000
    S = np.tile(np.diag([1.5, 1.0, 0.8]) + 0.2 * random.normal(size=(3, 3)), (many, 1, 1))
    normals = np.tile(shapes.rotation(10, 20, 30)[0], (many, 1))
    body = polytopes([form], np.zeros(many, int))
    problem = LocalProblem(S, normals, np.tile(Q, (many, 1, 1)), np.full(many, 0.5), body)
    check_random_starts(problem, lambda R: objective(problem, R), seed=5)


@pytest.mark.thorough(2)
@forms
def test_every_device_gives_the_shape_of_numpy(name, device):
    V, F = shapes.blob(3)
    options = {"form": POLYTOPES[name](), "orientation": Q}
    one, other = (
        stylize(V, F, 0.5, device=which, proxy=PAPER, **options) for which in ("numpy", device)
    )
    tolerance = by_device(device, 1e-8, 1e-4)
    assert one.energy.total == pytest.approx(other.energy.total, rel=tolerance)
    np.testing.assert_allclose(one.positions, other.positions, atol=by_device(device, 1e-5, 0.01))


@pytest.mark.thorough(3)
@forms
def test_the_energy_never_rises(name):
    setup = Setup(rest_mesh(*shapes.blob(3), proxy=PAPER))
    state = Stylization(
        setup,
        Style(0.8, Q, form=POLYTOPES[name]()),
        options=SolverOptions(device="numpy", is_accelerated=False),
    )
    energies = []
    for _ in range(30):
        state.step()
        energies.append(state.energy.total)
    assert (np.diff(energies) <= 1e-12 * energies[0]).all()


@pytest.mark.thorough(2)
@forms
def test_a_turned_mesh_with_a_turned_form_gives_the_turned_shape(name):
    V, F = shapes.blob(2)
    turn, options = shapes.rotation(40, 50, 60), {"device": "numpy", "tolerance": 1e-5}
    form = POLYTOPES[name]()
    one = stylize(V, F, 0.5, form=form, proxy=PAPER, **options).positions
    other = stylize(
        V @ turn.T, F, 0.5, form=form, orientation=turn.T, proxy=PAPER, **options
    ).positions
    assert np.abs(other - one @ turn.T).max() < 2e-3 * np.ptp(V)


@pytest.mark.thorough(2)
@needs_engine
@pytest.mark.parametrize(
    "name", sorted(set(POLYTOPES) - {"box", "slab", "pillar", "cylinder", "cone"})
)
def test_a_ball_becomes_the_form(name):
    V, F = shapes.sphere(4)
    form = POLYTOPES[name]()
    result = stylize(V, F, 2.0, form=form, max_iterations=3000, tolerance=1e-4, proxy=PAPER)
    assert share_facing(result.positions, F, form.normals) > LEAST_FLAT.get(name, 0.85)


@needs_engine
def test_the_cube_as_a_polytope_is_the_cube():
    V, F = shapes.blob(3)
    one = stylize(V, F, 0.6, proxy=PAPER)
    other = stylize(V, F, 0.6, form=POLYTOPES["cube"](), proxy=PAPER)
    assert one.energy.total == pytest.approx(other.energy.total, rel=1e-9)
    np.testing.assert_allclose(one.positions, other.positions, atol=1e-6)


@pytest.mark.parametrize("device", ["numpy", pytest.param("cpu", marks=needs_engine)])
def test_each_vertex_may_have_a_form_of_its_own(device):
    """Two balls in one mesh become what each becomes alone."""
    V, F = shapes.sphere(3)
    two = np.concatenate([V, V + [5, 0, 0]])
    both = np.concatenate([F, F + len(V)])
    kinds = [POLYTOPES[name]() for name in ("octahedron", "prism of 6")]
    which = np.repeat([0, 1], len(V))
    run_of = Stylization(
        Setup(rest_mesh(two, both, PAPER)),
        Style(0.8, form=kinds, form_of=which),
        options=SolverOptions(device=device),
    )
    positions = run(run_of).positions
    for number, form in enumerate(kinds):
        part = positions[which == number]
        _, normals = triangle_areas_and_normals(part, F)
        areas, _ = triangle_areas_and_normals(part, F)
        own, others = (
            areas @ (normals @ kind.normals.T).max(axis=1) for kind in (form, kinds[1 - number])
        )
        assert own > others


def test_rows_that_are_left_go_to_the_admm():
    rest, form = blob(), POLYTOPES["dodecahedron"]()
    lam = np.full(len(rest.V), 0.4)
    U = rest.V * [-1, -1, 1]  # nothing that starts there is certified
    body = polytopes([form], np.zeros(len(rest.V), int))
    step = local_step_class("numpy")(rest, lam, Q[None], AdmmOptions(), body)
    first = np.sum(step.update(U))
    assert np.abs(step.R - np.eye(3)).max() > 1.0
    assert np.sum(step.update(U)) <= first * (1 + 1e-9)
