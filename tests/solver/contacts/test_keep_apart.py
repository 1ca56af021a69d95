# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces that do not cross at rest do not cross in the result."""

from types import SimpleNamespace

import contact_shapes
import numpy as np
import pytest
import shapes
from proxy_shapes import joined
from scipy.sparse import identity

from solver import (
    PAPER,
    FrameSequence,
    Mirror,
    Pose,
    ProxyOptions,
    Run,
    Setup,
    SolverOptions,
    Stylization,
    partners,
    rest_mesh,
    run,
    stylize,
)
from solver.contacts import keep_apart, pairs
from solver.contacts.crossings import crossings
from solver.proxy import no_links
from solver.proxy.links import links_between

BARE = {"keep_pose": False, "detail": 0.0}
"""what lets limbs swing"""
COARSE = {"refine": False}
"""what makes a test fast"""


def stylization(V, F, cubeness=0.4, pinned=(), apart=True, options=None, mirrors=(), **others):
    proxy = ProxyOptions(keep_apart=apart, **(options or {}))
    setup = Setup(rest_mesh(V, F, proxy), pinned, mirrors=mirrors)
    options = SolverOptions(**{"keep_rotation": True} | others)
    return Stylization(setup, cubeness, options=options)


def new_crossings(V, U, F):
    """Return the triangles that cross and crossed nothing at rest."""
    return np.setdiff1d(crossings(U, F), crossings(V, F))


CROWDED = {
    "arms beside the body": (contact_shapes.figure, {"gap": 0.05}, {}),
    "arms that swing into each other": (contact_shapes.figure, {"degrees": 40}, BARE),
    "a coat over a body": (contact_shapes.dressed, {"gap": 0.006}, BARE | {"together": False}),
    "fingers": (contact_shapes.hand, {"count": 4}, {}),
    "fingers without their pose": (contact_shapes.hand, {}, BARE),
    "lips": (contact_shapes.lips, {"count": 16}, {}),
    "a spring": (contact_shapes.spring, {"sides": 8, "per_turn": 24}, BARE),
    "layers": (contact_shapes.layers, {}, {}),
}


@pytest.mark.thorough(3)
@pytest.mark.parametrize("cubeness", [0.4, 1.0])
@pytest.mark.parametrize("name", CROWDED)
def test_no_surface_crosses_another(name, cubeness):
    make, size, options = CROWDED[name]
    V, F = make(**size)
    result = run(stylization(V, F, cubeness, options=options))
    found = new_crossings(V, result.positions, F)
    assert result.crossings == len(found) <= (options == BARE) * len(F) / 1000
    np.testing.assert_array_equal(result.crossing_vertices, np.unique(F[found]))


@pytest.mark.thorough(1)
@pytest.mark.parametrize("name", ["lips", "a coat over a body"])
def test_they_would_cross_without_it(name):
    make, size, options = CROWDED[name]
    V, F = make(**size)
    result = run(stylization(V, F, apart=False, options=options))
    assert result.crossings is None and result.crossing_vertices is None
    assert len(new_crossings(V, result.positions, F)) > 20


def test_where_nothing_crosses_the_result_has_the_same_bits(device):
    V, F = shapes.blob(3)
    with_it, without = (
        run(stylization(V, F, apart=is_apart, options=COARSE, device=device))
        for is_apart in (True, False)
    )
    np.testing.assert_array_equal(with_it.positions, without.positions)
    np.testing.assert_array_equal(with_it.rotations, without.rotations)
    assert with_it.energy == without.energy and with_it.iterations == without.iterations
    assert with_it.crossings == 0


def test_the_energy_of_the_paper_is_left_alone():
    V, F = contact_shapes.hand(count=4)
    assert not PAPER.keep_apart
    assert stylize(V, F, max_iterations=3, device="numpy", proxy=PAPER).crossings is None


def test_it_does_on_every_device(device):
    V, F = contact_shapes.hand()
    result = run(stylization(V, F, options=COARSE, device=device))
    assert result.crossings == len(new_crossings(V, result.positions, F)) == 0


def test_twice_and_in_slices_it_has_the_same_bits():
    V, F = contact_shapes.hand()
    whole, again = (run(stylization(V, F, options=COARSE)) for _ in range(2))
    sliced = Run(stylization(V, F, options=COARSE))
    phases, seen = 0, set()
    while sliced.reason is None:
        sliced.advance()
        sliced.positions(), sliced.placed()
        phases += 1
        seen.add(sliced.stylization)
    assert len(seen) > 1 and phases > 2 * whole.iterations
    for other in (again, sliced.result()):
        np.testing.assert_array_equal(other.positions, whole.positions)
        np.testing.assert_array_equal(other.rotations, whole.rotations)
        assert other.iterations == whole.iterations and other.energy == whole.energy


def test_in_a_round_the_energy_of_the_plain_iteration_falls():
    V, F = contact_shapes.hand()
    plain = Run(stylization(V, F, options=COARSE, is_accelerated=False), max_iterations=60)
    setups, energies = [], []  # the setups are kept, or a later one could have the same identity

    def note(state):
        if not setups or setups[-1] is not state.setup:
            setups.append(state.setup)
            energies.append([])
        energies[-1].append(state.energy.total)

    plain.complete(note)
    assert len(energies) > 1
    for values in energies:
        assert len(values) > 5
        assert (np.diff(values) <= 1e-9 * values[0]).all()


@pytest.mark.parametrize("first", [8, 60])
def test_a_round_takes_up_to_a_quarter_of_the_first_iterations_or_ten(first):
    V, F = contact_shapes.hand()
    limited = Run(stylization(V, F, options=COARSE, is_accelerated=False), max_iterations=first)
    counts, state = [], limited.stylization
    while limited.reason is None:
        before = limited.stylization.iterations
        limited.advance()
        if limited.stylization is not state:
            counts.append(before)
            state = limited.stylization
    counts.append(limited.stylization.iterations)
    assert counts[0] == first and 1 < len(counts) <= 5
    assert (np.diff(counts) <= min(max(first // 4, 10), first)).all()
    result = limited.result()
    assert result.reason == "max_iterations" and result.iterations == limited.iterations


def rounds_of(state):
    """Return the Run to its end, and how many rounds there were."""
    whole, seen = Run(state), set()
    whole.complete(lambda now: seen.add(now.setup))
    return whole, len(seen) - 1


def test_a_few_are_pushed_apart_without_a_round(monkeypatch):
    V, F = contact_shapes.hand(fingers=2, count=3)
    assert len(F) / 2000 < 1
    options = {"options": BARE | COARSE}
    whole, rounds = rounds_of(stylization(V, F, 0.8, **options))
    assert rounds == 0
    monkeypatch.setattr(keep_apart, "FEWEST", 0)
    other, more_rounds = rounds_of(stylization(V, F, 0.8, **options))
    assert more_rounds > 0
    U = whole.result().positions
    assert whole.iterations < other.iterations and len(new_crossings(V, U, F)) == 0


def test_there_is_no_round_where_hardly_anything_can_be_linked(monkeypatch):
    V, F = contact_shapes.hand()
    state = stylization(V, F, options=COARSE)
    real, found = keep_apart.links_against, []
    monkeypatch.setattr(
        keep_apart, "links_against", lambda *given: found.append(real(*given)) or no_links()
    )
    whole, rounds = rounds_of(state)
    assert rounds == 0
    is_across = ~found[0].coefficients[:, 2:].any(axis=1)
    i, j = found[0].vertices[is_across, :2].T
    lengths = np.linalg.norm(state.rest.V[i] - state.rest.V[j], axis=1)
    stiffness = found[0].weights[is_across, 0] / state.rest.areas[i]
    relative = stiffness * lengths**2 / pairs.STRENGTH
    assert relative.min() > 0.45 and relative.max() < 1.05, "some share their strength"
    result = whole.result()
    # some of them inside the hand, where nobody sees them
    assert 40 < result.crossings < len(new_crossings(V, result.positions, F))
    assert result.iterations == run(stylization(V, F, apart=False, options=COARSE)).iterations


def test_a_run_that_is_cancelled_does_not_look():
    V, F = contact_shapes.hand()
    result = run(
        stylization(V, F, options=COARSE), on_iteration=lambda state: state.iterations == 5
    )
    assert result.reason == "cancelled" and result.crossings is None


def test_pinned_vertices_do_not_move():
    V, F = contact_shapes.hand()
    pinned = np.arange(0, len(V), 90)
    held = Run(stylization(V, F, options=COARSE, pinned=pinned))
    first = held.stylization
    held.complete()
    assert held.stylization is not first
    result = held.result()
    np.testing.assert_array_equal(result.positions[pinned], V[pinned])


def test_loose_vertices_do_not_move():
    V, F = contact_shapes.hand()
    loose = np.array([[0.4, 1.5, 0.1], [9.0, 9.0, 9.0]])
    result = run(stylization(np.concatenate([V, loose]), F, options=COARSE))
    np.testing.assert_array_equal(result.positions[len(V) :], loose)


def test_mirrored_halves_stay_mirror_images():
    V, F = contact_shapes.hand()
    linear, offset = np.diag([-1.0, 1, 1]), np.array([-0.5, 0, 0])
    V, F = joined((V, F), (V @ linear + offset, F[:, ::-1]))
    mirror = Mirror(partners(V, V @ linear + offset, 1e-6), linear, offset)
    assert mirror.count == len(V)
    both = Run(stylization(V, F, options=COARSE, mirrors=[mirror]))
    first = both.stylization
    both.complete()
    assert both.stylization is not first
    result = both.result()
    assert result.crossings == 0
    U = result.positions
    np.testing.assert_allclose(mirror.image(U)[mirror.partner], U, atol=1e-9)


@pytest.mark.parametrize(("is_wide", "expected"), [(False, [0]), (True, [0, 2])])
def test_once_more_the_gaps_are_linked_that_are_narrower_than_any_was_closed_by(is_wide, expected):
    ends = np.array([0, 2, 4]), np.array([1, 3, 5])
    V, R = np.zeros((6, 3)), np.tile(np.eye(3), (6, 1, 1))
    V[ends[1], 0] = 1.0, 0.5, 2.0
    U = np.where(np.arange(6)[:, None] == 1, 0.1 * V, V)  # only the first gap is closed
    rest = SimpleNamespace(V=V, topology=SimpleNamespace(part=np.zeros(6, int)))
    gaps = SimpleNamespace(graph=identity(6, format="csr"), partners=lambda chosen: ends)
    linked, _ = pairs._closed_gaps(rest, gaps, np.ones(6, bool), U, R, is_wide)
    assert linked.tolist() == expected


def test_only_links_whose_ends_both_have_images_are_mirrored():
    mirror = Mirror(np.array([1, 0, 3, 2, -1]), np.diag([-1.0, 1.0, 1.0]), np.zeros(3))
    links = links_between(np.array([0, 0]), np.array([2, 4]), np.ones(2))
    found = pairs.mirrored(links, [mirror])
    ends = [set(row[c != 0.0]) for row, c in zip(found.vertices, found.coefficients, strict=True)]
    assert ends == [{0, 2}, {0, 4}, {1, 3}]


def test_held_groups_keep_their_place():
    V, F = contact_shapes.hand()
    weights = (np.arange(len(V)) < 40).astype(float)
    setup = Setup(rest_mesh(V, F, ProxyOptions(**COARSE))).with_holds([weights])
    matrix = np.eye(4)
    matrix[:3, 3] = 0.1, 0.2, 0.0
    options = SolverOptions(device="numpy", keep_rotation=True)
    held = Run(Stylization(setup, 0.4, Pose(hold_matrices=[matrix]), options))
    first = held.stylization
    held.complete()
    assert held.stylization is not first
    moved = (held.positions() - V)[weights > 0]
    share = setup.rest.areas[setup.rest.place[1]][weights > 0]
    np.testing.assert_allclose(np.average(moved, axis=0, weights=share), matrix[:3, 3], atol=1e-3)


def test_a_pose_has_its_own_contacts():
    V, F = contact_shapes.hand()
    posed = V @ shapes.rotation(0, 30, 0).T + [0.0, 0.0, 0.1] * V[:, 1:2]
    setup = Setup(rest_mesh(V, F, ProxyOptions(**COARSE))).posed(posed)
    result = run(Stylization(setup, 0.4, options=SolverOptions(device="numpy", keep_rotation=True)))
    assert result.crossings == len(new_crossings(posed, result.positions, F)) == 0


def test_frames_of_an_animation_are_not_looked_at():
    V, F = contact_shapes.hand(count=3)
    state = stylization(V, F, options=COARSE)
    assert FrameSequence(state.rest).solve(state, max_iterations=20).crossings is None


def test_links_that_are_none_change_nothing():
    state = stylization(*shapes.blob(2))
    other = state.setup.linked(state.rest, no_links())
    assert other.rest.topology.component_count == state.rest.topology.component_count
    np.testing.assert_array_equal(other.rest.matrices.laplacian, state.rest.matrices.laplacian)


def test_what_crosses_at_rest_may_cross():
    V, F = shapes.sphere(3)
    V, F = joined((V, F), (0.4 * V + [0.0, 0.1, 1.0], F))
    assert len(crossings(V, F))
    result = run(stylization(V, F, 0.6))
    assert result.converged
    assert result.crossings == len(new_crossings(V, result.positions, F)) < len(F) / 100


HOSTILE = {
    "soup": lambda rng: (rng.random((300, 3)), np.arange(300).reshape(-1, 3)),
    "tangle": lambda rng: (rng.random((60, 3)), rng.integers(0, 60, (200, 3))),
    "each face twice": lambda rng: (shapes.blob(2)[0], np.tile(shapes.blob(2)[1], (2, 1))),
    "coincident sheets": lambda rng: joined(*[shapes.sheet()] * 3),
    "coincident blobs": lambda rng: joined(*[shapes.blob(2)] * 2),
    "broken": lambda rng: shapes.broken(),
    "noise": lambda rng: (shapes.blob(2)[0] + 0.2 * rng.normal(size=(162, 3)), shapes.blob(2)[1]),
    "flat": lambda rng: (shapes.blob(2)[0] * [1, 1, 0], shapes.blob(2)[1]),
    "a point": lambda rng: (np.zeros((6, 3)), np.arange(6).reshape(2, 3)),
    "far apart": lambda rng: joined(
        shapes.blob(1), (1e-6 * shapes.blob(1)[0] + 1.5, shapes.blob(1)[1])
    ),
}


@pytest.mark.thorough(4)
@pytest.mark.parametrize("options", [{}, {"together": False, "refine": False, **BARE}])
@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_meshes_have_a_result(name, options):
    V, F = HOSTILE[name](np.random.default_rng(0))
    result = run(stylization(V, F, 0.8, options=options), max_iterations=30)
    assert np.isfinite(result.positions).all()
    assert result.crossings is not None and result.crossings >= 0
