# SPDX-License-Identifier: GPL-3.0-or-later
"""The symmetries of forms against what is known of them, and against a search of all rotations."""

import numpy as np
import pytest
import shapes
from named_forms import POLYTOPES
from scipy.spatial.transform import Rotation

from solver.styles import forms
from solver.styles.polytope import Polytope, from_directions, from_points
from solver.styles.symmetries import nearest_to_identity, symmetries

COUNTS = {
    "cube": 24,
    "box": 4,
    "slab": 8,
    "pillar": 8,
    "rounded cube": 24,
    "octahedron": 24,
    "tetrahedron": 12,
    "dodecahedron": 60,
    "icosahedron": 60,
    "rhombic dodecahedron": 24,
    "prism of 3": 6,
    "prism of 5": 10,
    "prism of 6": 12,
    "prism of 8": 16,
    "pyramid": 4,
    "cylinder": 128,
    "cone": 64,
}
TWIST = np.radians(25.0)
each_form = pytest.mark.parametrize("name", POLYTOPES)


def hull(seed, count=20):
    return from_points(np.random.default_rng(seed).normal(size=(count, 3)))


def turned(body, turn):
    """Return a body that is turned, with its facets in another order."""
    order = np.random.default_rng(3).permutation(len(body.normals))
    return Polytope(body.normals[order] @ turn.T, body.offsets[order], body.vertices @ turn.T)


def twisted():
    """Return a form with three slopes above and three below, turned by less than half a step."""
    angles = 2.0 * np.pi * np.arange(3) / 3.0
    above = np.column_stack([np.cos(angles), np.sin(angles), np.ones(3)])
    below = np.column_stack([np.cos(angles + TWIST), np.sin(angles + TWIST), -np.ones(3)])
    return from_directions(np.concatenate([above, below]))


def assert_maps_to_itself(body, maps):
    """Vertices go to vertices, which does not follow from how the maps are found."""
    images = body.vertices @ np.swapaxes(maps, 1, 2)
    away = np.linalg.norm(images[:, :, None] - body.vertices, axis=3).min(axis=2)
    assert away.max() < 1e-6 * body.radius


@each_form
@pytest.mark.parametrize("angles", [(0, 0, 0), (40, 50, 60)])
def test_all_rotations_are_found(name, angles):
    body = turned(POLYTOPES[name](), shapes.rotation(*angles))
    found = symmetries(body)
    assert len(found) == COUNTS[name]
    np.testing.assert_array_equal(found[0], np.eye(3))
    np.testing.assert_allclose(np.linalg.det(found), 1.0)
    np.testing.assert_allclose(
        found @ found.swapaxes(1, 2), np.tile(np.eye(3), (len(found), 1, 1)), atol=1e-12
    )
    gaps = np.abs(found[:, None] - found).max(axis=(2, 3))
    assert (gaps + np.eye(len(found))).min() > 0.01  # none twice
    assert_maps_to_itself(body, found)


@pytest.mark.parametrize("sides", [3, 5, 7, 12, 31])
def test_prisms_and_pyramids_have_as_many_as_their_sides_say(sides):
    assert len(symmetries(forms.prism(sides))) == 2 * sides
    assert len(symmetries(forms.pyramid(sides))) == sides


@pytest.mark.parametrize("seed", range(4))
def test_most_hulls_have_none(seed):
    body = hull(seed)
    np.testing.assert_array_equal(symmetries(body), np.eye(3)[None])


@pytest.mark.parametrize(
    ("offsets", "count"),
    [
        ((1, 1, 1, 1, 1, 1), 24),
        ((1, 1, 1, 1, 1, 1.2), 4),
        ((1, 1, 1, 1, 1.2, 1.2), 2),
        ((1, 1, 1, 1.2, 1.2, 1.2), 3),
        ((1, 1, 1.1, 1, 1, 1.2), 4),
        ((1, 1.1, 1.2, 1.3, 1.4, 1.5), 1),
    ],
)
def test_the_distances_of_the_sides_count(offsets, count):
    """Their directions alone are those of a cube."""
    body = from_directions(np.concatenate([np.eye(3), -np.eye(3)]), offsets)
    assert len(symmetries(body)) == count
    assert_maps_to_itself(body, symmetries(body))


def test_the_rounding_of_single_precision_is_ignored_but_no_more():
    body = forms.dodecahedron()
    rounded = body.normals.astype(np.float32).astype(np.float64)
    assert len(symmetries(Polytope(rounded, body.offsets, body.vertices))) == 60
    offsets = body.offsets * np.where(np.arange(12) == 3, 1.001, 1.0)
    assert len(symmetries(from_directions(body.normals, offsets))) == 5
    directions = body.normals + 1e-3 * (np.arange(12) == 3)[:, None] * body.normals[4]
    assert len(symmetries(from_directions(directions))) < 5


def test_what_is_remembered_is_neither_written_to_nor_mistaken():
    body = forms.prism(5)
    with pytest.raises(ValueError, match="read-only"):
        symmetries(body)[0, 0, 0] = 2.0
    assert symmetries(body) is symmetries(forms.prism(5))
    longer = from_directions(body.normals, np.where(np.arange(7) == 6, 2.0, 1.0))
    assert len(symmetries(longer)) == 5


def test_a_twisted_form_has_rotations():
    assert len(symmetries(twisted())) == 6


@each_form
def test_equivalent_rotations_have_the_same_nearest_one(name):
    body = POLYTOPES[name]()
    Q = shapes.rotation(33, -58, 120)
    nearest = nearest_to_identity(Q, body)
    x = np.random.default_rng(0).normal(size=(50, 3))
    np.testing.assert_allclose(body.cost(x @ nearest.T), body.cost(x @ Q.T))
    angle = Rotation.from_matrix(nearest).magnitude()
    for same in symmetries(body) @ Q:
        assert Rotation.from_matrix(same).magnitude() >= angle - 1e-9
        np.testing.assert_allclose(nearest_to_identity(same, body), nearest, atol=1e-9)
