# SPDX-License-Identifier: GPL-3.0-or-later
"""The order of the vertices in memory changes nothing but the time."""

import numpy as np
import pytest
import shapes
from devices import by_device

from solver import PAPER, rest_mesh, stylize
from solver.proxy.surface import _vertex_order


@pytest.fixture
def ordered(monkeypatch):
    """Let the meshes of a test be put in order from now on."""
    return lambda: monkeypatch.setattr("solver.proxy.surface.REORDERED_FROM", 0)


def shuffled(V, F):
    order = np.random.default_rng(5).permutation(len(V))
    number = np.argsort(order)
    return V[order], number[F]


@pytest.mark.parametrize("name", shapes.ALL)
def test_each_vertex_has_its_place_and_neighbours_are_near(name, ordered):
    V, F = shuffled(*shapes.ALL[name]())
    plain = rest_mesh(V, F, PAPER)
    assert (np.diff(plain.used) > 0).all()
    ordered()
    order = _vertex_order(plain.F, len(plain.V))
    np.testing.assert_array_equal(np.sort(order), np.arange(len(plain.V)))
    rest = rest_mesh(V, F, PAPER)
    np.testing.assert_array_equal(rest.used, plain.used[order])
    np.testing.assert_array_equal(rest.used[rest.F], plain.used[plain.F])

    def distances(mesh):
        return np.abs(mesh.F - mesh.F[:, [1, 2, 0]]).mean()

    assert distances(rest) < 0.5 * distances(plain)
    assert len(rest.topology.chunks[1]) <= len(plain.topology.chunks[1])


def test_results_are_the_same(ordered, device):
    V, F = shuffled(*shapes.two_blobs())
    pinned = np.arange(0, 60, 7)
    options = {
        "targets": V + 0.05,
        "orientation": np.tile(shapes.rotation(10, 20, 30), (len(V), 1, 1)),
        "device": device,
        "max_iterations": 10,
        "keep_rotation": True,
    }
    cubeness = 0.5 + 0.2 * V[:, 0]
    plain = stylize(V, F, cubeness, pinned, proxy=PAPER, **options)
    ordered()
    result = stylize(V, F, cubeness, pinned, proxy=PAPER, **options)
    np.testing.assert_allclose(
        result.positions, plain.positions, atol=by_device(device, 1e-9, 1e-5)
    )
    np.testing.assert_allclose(
        result.rotations, plain.rotations, atol=by_device(device, 1e-7, 1e-3)
    )
    np.testing.assert_array_equal(result.positions[pinned], V[pinned] + 0.05)


def test_chunks_are_of_one_component_each(ordered):
    ordered()
    rest = rest_mesh(*shuffled(*shapes.two_blobs()), proxy=PAPER)
    bounds, component = rest.topology.chunks
    assert bounds[0] == 0 and bounds[-1] == len(rest.V)
    assert (np.diff(bounds) > 0).all() and np.diff(bounds).max() <= 256
    for label, begin, end in zip(component, bounds, bounds[1:], strict=False):
        assert (rest.topology.component[begin:end] == label).all()


def test_groups_are_of_chunks_of_one_component_each():
    V, F = shapes.sphere(5)
    small, G = shapes.sphere(3)
    F = np.concatenate([F, F + len(V), G + 2 * len(V)])
    topology = rest_mesh(np.concatenate([V, V + 3.0, small - 3.0]), F, PAPER).topology
    _, of_chunk = topology.chunks
    starts, of_group = topology.groups
    assert starts[0] == 0 and starts[-1] == len(of_chunk)
    assert len(of_group) == 5  # of 41, 41 and 3 chunks
    for label, begin, end in zip(of_group, starts, starts[1:], strict=False):
        assert 0 < end - begin <= 32 and (of_chunk[begin:end] == label).all()
