# SPDX-License-Identifier: GPL-3.0-or-later
"""Normal captures: what a ball says between its vertices, and what becomes of a mesh."""

import numpy as np
import pytest
import shapes
from devices import by_device
from engine_marks import needs_engine
from facing import AXES, share_facing
from local_problems import Q, check_random_starts

from solver import (
    PAPER,
    CubicCraftError,
    NormalCapture,
    Setup,
    SolverOptions,
    Style,
    Stylization,
    rest_mesh,
    run,
    stylize,
)
from solver.mesh.rest_measures import areas_and_normals
from solver.styles.cube import CUBE
from solver.styles.forms import dodecahedron
from solver.styles.local_problem import LocalProblem
from solver.styles.normal_capture import MOST, targets_for
from solver.styles.polytope_step import polytopes


def directions(count, seed=0):
    found = np.random.default_rng(seed).normal(size=(count, 3))
    return found / np.linalg.norm(found, axis=1)[:, None]


def to_cube(d):
    """Return the axes (n,3) nearest to directions."""
    axes = np.zeros_like(d)
    rows, nearest = np.arange(len(d)), np.abs(d).argmax(axis=1)
    axes[rows, nearest] = np.sign(d[rows, nearest])
    return axes


def like_a_cube(count=3000):
    return NormalCapture(d := directions(count), to_cube(d))


@pytest.mark.parametrize("count", [4, 12, 500, MOST + 5000])
def test_a_ball_as_it_was_asks_for_what_is_there(count):
    corners = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]])
    d = corners if count == 4 else directions(count)
    x = directions(2000, seed=1)
    np.testing.assert_allclose(NormalCapture(2.0 * d, d).at(x), x, atol=1e-12)


def test_what_lies_between_is_smooth_on_a_coarse_ball():
    V, _ = shapes.sphere(3)
    bent = V * [1.0, 2.0, 0.5]
    capture = NormalCapture(V, bent)
    x = directions(4000, seed=2)
    expected = x * [1.0, 2.0, 0.5]
    expected /= np.linalg.norm(expected, axis=1)[:, None]
    np.testing.assert_allclose(capture.at(x), expected, atol=0.03)
    step = 1e-3 * directions(4000, seed=3)
    jump = np.linalg.norm(like_a_cube(500).at(x + step) - like_a_cube(500).at(x), axis=1)
    assert jump.max() < 0.1  # from side to side within a triangle, 10 degrees wide


def test_sides_of_the_ball_are_flat_between_their_vertices():
    capture = like_a_cube(3000)
    x = directions(5000, seed=4)
    sizes = np.sort(np.abs(x), axis=1)
    inside = sizes[:, 2] - sizes[:, 1] > 0.2
    np.testing.assert_allclose(capture.at(x)[inside], to_cube(x)[inside], atol=1e-12)


def test_nothing_has_no_normal():
    capture = like_a_cube(100)
    assert not capture.at(np.zeros((2, 3))).any()
    opposite = np.tile([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]], (3, 1))
    axes = np.concatenate([np.eye(3), -np.eye(3)])
    middle = 0.5 * (axes[0] + axes[1])
    assert np.isfinite(NormalCapture(axes, opposite).at(middle[None])).all()


def test_vertices_that_face_nowhere_are_left_out():
    d = np.concatenate([directions(50), [[0, 0, 0], [1, 0, 0], [np.nan, 0, 0]]])
    n = np.concatenate([directions(50), [[0, 0, 1], [0, 0, 0], [0, 0, 1]]])
    x = directions(10, seed=1)
    np.testing.assert_array_equal(NormalCapture(d, n).at(x), NormalCapture(d[:50], n[:50]).at(x))


@pytest.mark.parametrize(
    ("d", "words"),
    [
        (directions(3), "fewer than four"),
        (np.zeros((9, 3)), "fewer than four"),
        (directions(50) * [1, 1, 0], "do not surround"),
        (np.abs(directions(50)), "do not surround"),
        (directions(50) + [3, 0, 0], "do not surround"),
    ],
)
def test_what_is_no_ball_is_refused(d, words):
    with pytest.raises(CubicCraftError, match=words):
        NormalCapture(d, d)


def random_problem(many, lam, mu, form_of_name, seed):
    random = np.random.default_rng(seed)
    S = np.tile(np.diag([1.5, 1.0, 0.8]) + 0.2 * random.normal(size=(3, 3)), (many, 1, 1))
    normal, target = random.normal(size=(2, 3))
    normals = np.tile(normal / np.linalg.norm(normal), (many, 1))
    captured = np.tile([*(target / np.linalg.norm(target)), mu], (many, 1))
    turns = np.tile(Q, (many, 1, 1))
    body = polytopes([form_of_name()], np.zeros(many, int)) if form_of_name else CUBE
    nothing = np.zeros((many, 3, 3))
    problem = LocalProblem(nothing, normals, turns, np.full(many, lam), body, captured)
    return problem.with_covariances(S), S


@pytest.mark.thorough(3)
@pytest.mark.parametrize("form", [None, dodecahedron])
@pytest.mark.parametrize(("lam", "mu"), [(0.0, 1.0), (0.5, 0.7), (0.3, 4.0)])
def test_no_start_leads_to_less_than_the_search_from_many(lam, mu, form):
    """Of two problems: the step is no worse than the best of 1,000 random starts."""
    for seed in range(2):
        problem, S = random_problem(1000, lam, mu, form, seed)

        def energy(R, problem=problem, S=S, seed=seed):
            y = np.einsum("nij,nj->ni", R, problem.normals)
            cost = problem.form.cost(problem.form_normals(R))
            off = 1.0 - (y * problem.captured[:, :3]).sum(axis=1)
            return lam * cost + mu * off - np.einsum("nij,nji->n", R, S)

        R = check_random_starts(problem, energy, seed)
        fit, cost = problem.energy_terms(R)
        np.testing.assert_allclose(cost - fit, energy(R), atol=1e-12)
        assert (cost >= 0.0).all()


def test_a_ball_as_it_was_changes_nothing(device):
    V, F = shapes.blob(3)
    same = NormalCapture(d := directions(500), d)
    options = {"capture": same, "capture_strength": 2.0, "orientation": Q, "device": device}
    result = stylize(V, F, 0.0, proxy=PAPER, **options)
    np.testing.assert_allclose(result.positions, V, atol=by_device(device, 1e-9, 1e-4))
    assert result.energy.total == pytest.approx(0.0, abs=by_device(device, 1e-12, 1e-6))


@pytest.mark.thorough(2)
@pytest.mark.parametrize("lam", [0.0, 0.3])
@pytest.mark.parametrize("form", [None, dodecahedron])
def test_every_device_gives_the_shape_of_numpy(device, lam, form):
    V, F = shapes.blob(3)
    options = {
        "capture": like_a_cube(),
        "capture_strength": np.linspace(0.0, 2.0, len(V)),
        "orientation": Q,
        "form": form and form(),
    }
    one, other = (
        stylize(V, F, lam, device=which, proxy=PAPER, **options) for which in ("numpy", device)
    )
    tolerance = by_device(device, 1e-7, 1e-3)
    assert one.energy.total == pytest.approx(other.energy.total, rel=tolerance)
    np.testing.assert_allclose(one.positions, other.positions, atol=by_device(device, 1e-5, 0.02))


@needs_engine
def test_a_large_mesh_has_it_on_coarser_levels_too(monkeypatch):
    """Multigrid, coarser meshes and sums by kernels, on a mesh that would not need them."""
    V, F = shapes.sphere(5)
    options = {"capture": like_a_cube(), "capture_strength": 3.0, "keep_rotation": True}
    plain = stylize(V, F, 0.0, proxy=PAPER, **options)
    monkeypatch.setattr("solver.coarse_to_fine.start.LEAST_VERTICES", 2000)
    monkeypatch.setattr("solver.global_step.step.FACTORIZED_VERTICES", 0)
    large = stylize(V, F, 0.0, proxy=PAPER, **options)
    assert large.energy.total == pytest.approx(plain.energy.total, rel=1e-2)
    assert share_facing(large.positions, F, AXES, 12.0) > 0.55


@pytest.mark.parametrize("lam", [0.0, 0.8])
def test_the_energy_never_rises(lam):
    setup = Setup(rest_mesh(*shapes.blob(3), proxy=PAPER))
    style = Style(lam, Q, capture=like_a_cube(), capture_strength=1.5)
    options = SolverOptions(device="numpy", is_accelerated=False)
    state = Stylization(setup, style, options=options)
    energies = []
    for _ in range(30):
        state.step()
        energies.append(state.energy.total)
    assert energies[-1] < 0.9 * energies[0]
    assert (np.diff(energies) <= 1e-12 * energies[0]).all()


def test_a_turned_mesh_with_a_turned_ball_gives_the_turned_shape():
    V, F = shapes.blob(2)
    turn = shapes.rotation(40, 50, 60)
    capture = like_a_cube()
    options = {"capture": capture, "capture_strength": 1.0, "device": "numpy", "tolerance": 1e-6}
    one = stylize(V, F, 0.0, proxy=PAPER, **options).positions
    by_frame = stylize(V @ turn.T, F, 0.0, orientation=turn.T, proxy=PAPER, **options).positions
    d = directions(3000)
    options["capture"] = NormalCapture(d @ turn.T, to_cube(d) @ turn.T)
    by_ball = stylize(V @ turn.T, F, 0.0, proxy=PAPER, **options).positions
    for other in (by_frame, by_ball):
        assert np.abs(other - one @ turn.T).max() < 1e-3 * np.ptp(V)


def test_beyond_a_mirror_it_is_mirrored():
    V, F = shapes.blob(2)
    flip = np.diag([-1.0, 1.0, 1.0])
    tilt = NormalCapture(d := directions(500), d + [0.5, 0.2, 0.1])
    options = {"capture": tilt, "capture_strength": 1.0, "device": "numpy", "tolerance": 1e-6}
    one = stylize(V, F, 0.2, proxy=PAPER, **options).positions
    other = stylize(V @ flip, F[:, ::-1], 0.2, orientation=flip, proxy=PAPER, **options).positions
    assert np.abs(other @ flip - one).max() < 1e-3 * np.ptp(V)


@needs_engine
def test_a_ball_becomes_like_the_ball_that_was_captured():
    V, F = shapes.sphere(4)
    cubic = stylize(V, F, 2.0, max_iterations=2000, proxy=PAPER).positions
    capture = NormalCapture(areas_and_normals(V, F)[1], areas_and_normals(cubic, F)[1])
    result = stylize(V, F, 0.0, capture=capture, capture_strength=4.0, proxy=PAPER).positions
    assert share_facing(V, F, AXES, 12.0) < 0.3
    assert share_facing(result, F, AXES, 12.0) > 0.8 * share_facing(cubic, F, AXES, 12.0) > 0.7


def test_a_part_that_is_inside_out_faces_as_it_is_seen():
    V, F = shapes.sphere(3)
    tilt = NormalCapture(d := directions(500), d * [1, 1, 3])
    options = {"capture": tilt, "capture_strength": 1.0, "device": "numpy"}
    one, other = (
        stylize(V, faces, 0.0, proxy=PAPER, **options).positions for faces in (F, F[:, ::-1])
    )
    np.testing.assert_allclose(one, other, atol=1e-6)


def test_each_vertex_may_have_its_own_capture_or_none():
    V, F = shapes.sphere(3)
    three = np.concatenate([V, V + [5, 0, 0], V + [10, 0, 0]])
    faces = np.concatenate([F, F + len(V), F + 2 * len(V)])
    which = np.repeat([0, 1, 0], len(V))
    tall = NormalCapture(d := directions(800), d * [1, 1, 3])
    strength = np.repeat([3.0, 3.0, 0.0], len(V))
    captures = [like_a_cube(), tall]
    style = Style(0.0, capture=captures, capture_strength=strength, capture_of=which)
    options = SolverOptions(keep_rotation=True, device="numpy")
    state = Stylization(Setup(rest_mesh(three, faces, PAPER)), style, options=options)
    result = run(state).positions.reshape(3, -1, 3)
    assert share_facing(result[0], F, AXES, 12.0) > share_facing(result[1], F, AXES, 12.0) + 0.2
    assert np.abs(result[2] - V - [10, 0, 0]).max() < 0.02


def test_where_the_strength_is_nothing_nothing_is_asked_for():
    x = directions(20)
    captured = targets_for([like_a_cube(100)], np.zeros(20, int), np.zeros(20), Q[None], x)
    assert captured.shape == (20, 4) and not captured.any()


@pytest.mark.parametrize("strength", [-1.0, np.nan, np.ones(3)])
def test_strengths_that_are_none_are_refused(strength):
    V, F = shapes.sphere(1)
    with pytest.raises(CubicCraftError, match="capture_strength"):
        stylize(
            V,
            F,
            0.4,
            capture=like_a_cube(100),
            capture_strength=strength,
            device="numpy",
            proxy=PAPER,
        )


def test_as_many_normals_as_directions_are_needed():
    with pytest.raises(CubicCraftError, match="one normal for each"):
        NormalCapture(directions(5), directions(6))
