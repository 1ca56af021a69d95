# SPDX-License-Identifier: GPL-3.0-or-later
"""Several styles on one mesh: the bodies between them, and where each is used."""

import numpy as np
import pytest
import shapes
from local_problems import active_set_beside_admm, blob, deformed
from scipy.spatial.transform import Rotation

from solver import PAPER, Setup, SolverOptions, Style, Stylization, rest_mesh
from solver.styles.blending import LEVELS, blended
from solver.styles.forms import cone, cube, cylinder, icosahedron, octahedron, prism, tetrahedron
from solver.styles.local_problem import LocalProblem
from solver.styles.polytope import minkowski_sum
from solver.styles.polytope_step import polytopes

FORMS = {
    "cube": None,
    "octahedron": octahedron(),
    "tetrahedron": tetrahedron(),
    "icosahedron": icosahedron(),
    "prism": prism(5),
    "cone": cone(),
}
PAIRS = [("cube", "cube"), ("cube", "octahedron"), ("tetrahedron", "prism"), ("cone", "cube")]


def unit_vectors(count, seed=0):
    x = np.random.default_rng(seed).normal(size=(count, 3))
    return x / np.linalg.norm(x, axis=1, keepdims=True)


def cost_of(style, x):
    return (style.form or cube()).cost(x @ style.orientation.T)


def two(pair, seed=0):
    turns = Rotation.random(2, rng=np.random.default_rng(seed)).as_matrix()
    return [Style(0.4, Q, FORMS[name]) for Q, name in zip(turns, pair, strict=True)]


@pytest.mark.parametrize("pair", PAIRS)
@pytest.mark.parametrize("level", [1, 4, 7])
def test_the_cost_between_two_forms_is_the_mean_of_their_costs(pair, level):
    styles, share = two(pair), level / LEVELS
    weights = np.array([[1.0 - share, share]])
    cubeness, Q, bodies, body_of = blended(styles, weights)
    x = unit_vectors(500)
    found = bodies[body_of[0]].cost(x @ Q[0].T)
    expected = (1.0 - share) * cost_of(styles[0], x) + share * cost_of(styles[1], x)
    np.testing.assert_allclose(found, expected, atol=1e-9)
    assert cubeness == pytest.approx([0.4])


def test_the_cubeness_counts_in_the_share():
    one, other = two(PAIRS[1])
    weak = Style(0.1, other.orientation, other.form)
    cubeness, Q, bodies, body_of = blended([one, weak], np.array([[0.5, 0.5]]))
    x = unit_vectors(200)
    expected = 0.5 * 0.4 * cost_of(one, x) + 0.5 * 0.1 * cost_of(weak, x)
    found = cubeness[0] * bodies[body_of[0]].cost(x @ Q[0].T)
    # in steps of 1/8: a share of 0.2 is that of 0.25
    np.testing.assert_allclose(found, expected, atol=0.06 * 0.25 * 0.75)


def test_where_the_cubeness_is_zero_the_other_form_remains():
    one, other = two(PAIRS[1])
    still = Style(0.0, other.orientation, other.form)
    weights = np.array([[1.0, 0.0], [0.5, 0.5], [0.0, 1.0]])
    cubeness, _, bodies, body_of = blended([one, still], weights)
    assert cubeness.tolist() == [0.4, 0.2, 0.0]
    assert body_of[0] == body_of[1] and bodies[body_of[0]] is None


def test_the_same_form_has_no_body_between():
    turn = Rotation.from_euler("z", 90, degrees=True).as_matrix()
    styles = [Style(0.4, np.eye(3), None), Style(0.2, turn, None)]
    _, _, bodies, body_of = blended(styles, np.array([[1.0, 0.0], [0.5, 0.5], [0.0, 1.0]]))
    assert bodies == [None] and not body_of.any()


def test_of_three_styles_the_two_largest_shares_count():
    styles = [*two(PAIRS[0]), Style(0.4, np.eye(3), FORMS["icosahedron"])]
    cubeness, _, _, body_of = blended(styles, np.array([[0.5, 0.1, 0.4], [0.5, 0.0, 0.5]]))
    assert body_of[0] == body_of[1] and cubeness == pytest.approx([0.4, 0.4])


def test_two_round_bodies_askew_have_none_between():
    styles = [Style(0.4, Q, cylinder()) for Q in Rotation.random(2, rng=1).as_matrix()]
    _, _, bodies, body_of = blended(styles, np.array([[0.6, 0.4], [0.4, 0.6]]))
    assert len(bodies) == 1
    assert not body_of.any()


def test_bodies_between_have_as_many_faces_as_euler_says():
    for pair in PAIRS:
        one, other = two(pair, seed=2)
        a, b = one.form or cube(), other.form or cube()
        body = minkowski_sum(a, b.turned(other.orientation @ one.orientation.T))
        assert len(body.vertices) - len(body.edges) + len(body.normals) == 2


@pytest.mark.thorough(2)
@pytest.mark.parametrize("pair", PAIRS)
def test_the_local_step_is_exact_between_forms(pair):
    rest = blob()
    n = len(rest.V)
    share = np.random.default_rng(3).random((n, 1))
    cubeness, Q, bodies, body_of = blended(two(pair), np.hstack([share, 1.0 - share]))
    form = polytopes([body or cube() for body in bodies], body_of)

    def problem_at(amount):
        S = rest.matrices.covariances(deformed(rest.V, amount)) / rest.areas[:, None, None]
        return LocalProblem(S, rest.normals, np.broadcast_to(Q, (n, 3, 3)), cubeness, form)

    _, uncertified = active_set_beside_admm(problem_at)
    assert uncertified <= 0.02 * 3 * n


def ball_of_two(device, **options):
    V, F = shapes.sphere(3)
    weights = np.clip(0.5 + V[:, :1], 0.0, 1.0)
    styles = [Style(0.8, np.eye(3), None), Style(0.8, np.eye(3), octahedron())]
    cubeness, Q, bodies, body_of = blended(styles, np.hstack([1.0 - weights, weights]))
    return Stylization(
        Setup(rest_mesh(V, F, PAPER)),
        Style(cubeness, Q[0], form=[body or cube() for body in bodies], form_of=body_of),
        options=SolverOptions(device=device, **options),
    )


def test_there_is_no_seam_between_two_forms():
    """Where one form passes into the other, the sculpture bends no more than elsewhere."""
    stylization = ball_of_two("numpy")
    for _ in range(60):
        stylization.step()
    V, F = stylization.positions, stylization.rest.F
    edges = V[F[:, [1, 2, 0]]] - V[F]
    rest = stylization.rest.V
    before = np.linalg.norm(rest[F[:, [1, 2, 0]]] - rest[F], axis=2)
    stretch = np.linalg.norm(edges, axis=2) / before
    middle = np.abs(rest[F].mean(axis=1)[:, 0] - 0.5) < 0.2
    assert stretch[middle].max() < 1.1 * stretch[~middle].max()
