# SPDX-License-Identifier: GPL-3.0-or-later
"""Links in the matrices, and which of them there are."""

from dataclasses import replace

import numpy as np
import proxy_shapes
import pytest
import shapes
from devices import by_device

from solver import ProxyOptions, rest_mesh, stylize
from solver.mesh.components import components
from solver.mesh.edges import Triangles
from solver.mesh.rest_measures import areas_and_normals, cotangents
from solver.mesh.spokes_and_rims import spokes_and_rims
from solver.proxy.closest_point import closest_points
from solver.proxy.links import Links, links_between, links_to_triangles
from solver.proxy.neighbors import links_through, neighbor_links
from solver.proxy.thickness import outward_sign
from solver.surface.preparation import links_within


def mixed_links(V):
    rng = np.random.default_rng(5)
    one = links_between(np.array([3, 9]), np.array([40, 3]), np.array([0.7, 2.0]))
    beta = rng.dirichlet(np.ones(3), 4)
    corners = np.array([[1, 2, 3], [50, 60, 70], [3, 9, 40], [11, 12, 13]])
    return one.joined(links_to_triangles(np.array([30, 31, 32, 14]), corners, beta, np.ones(4)))


def link_energy(links, V, U, R):
    """Return the energy by its definition, in a loop."""
    total = 0.0
    for vertices, c, w in zip(links.vertices, links.coefficients, links.weights, strict=True):
        d, moved = c @ V[vertices], c @ U[vertices]
        total += sum(w[k] / 2 * np.sum((R[vertices[k]] @ d - moved) ** 2) for k in range(4))
    return total


def energy(m, V, U, R):
    L, S = m.matrix(m.laplacian), m.covariances(U)
    quadratic = 1.5 * (np.sum(V * (L @ V)) + np.sum(U * (L @ U)))
    return quadratic - np.einsum("nij,nji->", R, S)


def test_the_matrices_hold_the_energy_of_the_links():
    V, F = shapes.blob(2)
    rng = np.random.default_rng(2)
    U = V + 0.1 * rng.normal(size=V.shape)
    R = np.array([shapes.rotation(*angles) for angles in rng.uniform(-60, 60, (len(V), 3))])
    skin = spokes_and_rims(V, F, cotangents(V, F))
    links = mixed_links(V)
    linked = skin.with_links(V, links)
    expected = energy(skin, V, U, R) + link_energy(links, V, U, R)
    assert energy(linked, V, U, R) == pytest.approx(expected, rel=1e-12)
    L = linked.matrix(linked.laplacian).toarray()
    np.testing.assert_allclose(L, L.T, atol=1e-12)
    np.testing.assert_allclose(L.sum(axis=1), 0.0, atol=1e-11)
    for c in range(3):
        H, T = linked.matrix(linked.gather[:, c]), linked.matrix(linked.scatter[:, c])
        assert abs(H.T - T).max() == 0.0


def test_closest_points_are_closest():
    rng = np.random.default_rng(1)
    P, A, B, C = rng.normal(size=(4, 500, 3))
    beta = closest_points(P, A, B, C)
    assert beta.min() >= -1e-12
    np.testing.assert_allclose(beta.sum(axis=1), 1.0)
    found = np.linalg.norm(np.einsum("nk,nkx->nx", beta, np.stack([A, B, C], 1)) - P, axis=1)
    for other in rng.dirichlet(np.full(3, 0.5), 300):
        assert (
            found <= np.linalg.norm(other[0] * A + other[1] * B + other[2] * C - P, axis=1) + 1e-9
        ).all()


def neighbours_of(V, F):
    V = (V - V.min(axis=0)) / np.ptp(V, axis=0).max()
    areas, normals = areas_and_normals(V, F)
    count, part = components(F, len(V))
    return neighbor_links(V, F, normals, areas, part, count), part


def test_a_ball_is_linked_where_it_sits():
    V, F = proxy_shapes.eye_in_head()
    links, part = neighbours_of(V, F)
    assert len(links) > 20
    assert (part[links.vertices[:, 0]] != part[links.vertices[:, 1]]).all()


def test_nothing_is_linked_from_afar():
    V, F = shapes.sphere(3)
    for gap, is_linked in ((0.005, True), (0.1, False)):
        both = proxy_shapes.joined((V, F), (V + [2.0 + 2 * gap, 0, 0], F))
        assert bool(len(neighbours_of(*both)[0])) == is_linked


def test_a_part_is_not_linked_through_a_sheet_between():
    V, F = shapes.sphere(3)
    W, G = shapes.sheet(30)
    W = np.column_stack([np.full(len(W), 1.004), 3 * W[:, 0] - 1.5, 3 * W[:, 1] - 1.5])
    (links, part) = neighbours_of(*proxy_shapes.joined((V, F), (W, G), (V + [2.008, 0, 0], F)))
    ends = np.sort(np.stack([part[links.vertices[:, 0]], part[links.vertices[:, 1]]]), axis=0)
    assert {tuple(pair) for pair in ends.T.tolist()} == {(0, 1), (1, 2)}


def thickness_of(V, F):
    V = (V - V.min(axis=0)) / np.ptp(V, axis=0).max()
    areas, normals = areas_and_normals(V, F)
    _, part = components(F, len(V))
    return links_within(Triangles(V, F), normals, areas, part)[0], V


@pytest.mark.parametrize("name", ["sheet", "bowl", "mixed"])
def test_what_has_no_inside_has_no_other_side(name):
    V, F = shapes.sheet() if name == "sheet" else shapes.sphere(3)
    if name == "bowl":
        F = F[V[F].mean(axis=1)[:, 2] < 0.3]
    if name == "mixed":
        F = np.where(np.arange(len(F))[:, None] % 3 == 0, F[:, ::-1], F)
    assert not len(thickness_of(V, F)[0])


def test_a_small_hole_does_not_open_a_part():
    V, F = shapes.sphere(3)
    F = F[V[F].mean(axis=1)[:, 2] < 0.95]
    _, part = components(F, len(V))
    assert outward_sign(Triangles(V, F), part)[part[F[0, 0]]] == 1.0
    assert outward_sign(Triangles(V, F[:, ::-1]), part)[part[F[0, 0]]] == -1.0


def test_solidity_can_be_changed_without_another_search(monkeypatch):
    V, F = shapes.blob(3)
    rest = rest_mesh(V, F, ProxyOptions())
    monkeypatch.setattr("solver.surface.preparation.thickness_links", None)
    other = rest.with_options(replace(rest.options, solidity=0.5))
    assert other.links.weights.sum() == pytest.approx(0.5 / 0.3 * rest.links.weights.sum())
    hollow = rest.with_options(replace(rest.options, solidity=0.0))
    fresh = hollow.with_options(rest.options)
    np.testing.assert_array_equal(fresh.matrices.laplacian, rest.matrices.laplacian)


def test_links_are_carried_to_a_coarser_mesh():
    links = links_between(np.array([0, 1]), np.array([2, 3]), np.ones(2))
    coarse = links.mapped(np.array([0, 0, 1, 0]))
    V = np.array([[0.0, 0, 0], [1, 0, 0]])
    row, column, laplacian, _ = coarse.entries(V)
    L = np.zeros((2, 2))
    np.add.at(L, (row, column), laplacian)
    np.testing.assert_allclose(L, 2 / 3 * np.array([[1, -1], [-1, 1]]))
    assert isinstance(coarse, Links)


@pytest.mark.thorough(2)
@pytest.mark.parametrize("make", [proxy_shapes.eye_in_head, proxy_shapes.blob_with_shirt])
def test_the_energy_falls_with_links_too_and_a_second_run_has_the_same_bits(make, device):
    V, F = make()
    energies, options = (
        [],
        {"proxy": ProxyOptions(solidity=0.3), "crispness": 0.0, "device": device},
    )
    options |= {"max_iterations": 25, "tolerance": 1e-12, "is_accelerated": False}
    first = stylize(
        V,
        F,
        0.4,
        on_iteration=lambda s: energies.append(s.energy.total),
        keep_rotation=True,
        **options,
    )
    assert np.diff(energies).max() <= by_device(device, 1e-12, 1e-6)
    second = stylize(V, F, 0.4, keep_rotation=True, **options)
    assert first.positions.tobytes() == second.positions.tobytes()


def spiked(depth=0.15, height=1.0):
    """Return a ball with a stick in it, its end below the surface, and which vertices it has."""
    V, F = shapes.sphere(3)
    top = V[:, 2].max()
    x, y = 0.03 * np.array([[1, 0, -1, 0], [0, 1, 0, -1]], float)
    ends = [np.column_stack([x, y, np.full(4, z)]) for z in (top - depth, top - depth + height)]
    sides = [[i, (i + 1) % 4, 4 + i] for i in range(4)]
    sides += [[(i + 1) % 4, 4 + (i + 1) % 4, 4 + i] for i in range(4)]
    stick = np.concatenate(ends), np.array([*sides, [0, 2, 1], [0, 3, 2], [4, 5, 6], [4, 6, 7]])
    return *proxy_shapes.joined((V, F), stick), np.arange(len(V), len(V) + 8)


def test_a_stick_stays_in_what_it_goes_into():
    V, F, stick = spiked()
    links, part = neighbours_of(V, F)
    assert len(links) and (part[links.vertices[:, 0]] != part[links.vertices[:, 1]]).all()
    U = stylize(V, F, 0.6, keep_rotation=True).positions
    ball = slice(stick[0])
    is_top = (np.hypot(*V[ball, :2].T) < 0.2) & (V[ball, 2] > 0.0)
    assert U[stick[:4], 2].mean() < U[ball, 2][is_top].mean() - 0.05


def test_what_others_connect_already_is_linked_as_before():
    V, F = proxy_shapes.eye_in_head()
    links, part = neighbours_of(V, F)
    areas, _ = areas_and_normals(V, F)
    added = links_through(V, F, part, 2, links, areas, np.full(len(V), 0.01))
    assert len(added) == 0
