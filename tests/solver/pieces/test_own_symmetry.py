# SPDX-License-Identifier: GPL-3.0-or-later
"""What is symmetric at rest stays so where nothing speaks against it."""

from types import SimpleNamespace

import numpy as np
import pytest
from proxy_shapes import uv_sphere
from shapes import rotation

from solver import PAPER, HandlePose, Style, flip, join_pieces, piece_of, run
from solver.pieces.subdivided import Subdivided
from solver.pieces.symmetry import with_own_symmetry
from solver.styles.forms import tetrahedron


def ears():
    """Return a ball with two ears, at both sides of X = 0, and a nose in front."""
    V, F = uv_sphere(32, 16)
    bumps = [
        np.exp(-8.0 * ((V - place) ** 2).sum(axis=1))[:, None] * np.array(height)
        for place, height in (
            ([0.6, 0.0, 0.8], [0.5, 0.1, 0.6]),
            ([-0.6, 0.0, 0.8], [-0.5, 0.1, 0.6]),
            ([0.0, -1.0, 0.0], [0.0, -0.6, 0.0]),
        )
    ]
    return V + sum(bumps), F


def axes_of(**options):
    V, F = ears()
    piece = with_own_symmetry(piece_of(options.pop("V", V), F, **options))
    return [one.normal.tolist() for one in piece.whole.mirrored]


def test_the_halves_are_mirror_images_bit_for_bit():
    V, F = ears()
    piece = with_own_symmetry(piece_of(V.astype(np.float32), F, style=Style(0.4)))
    (mirror,) = piece.whole.own_partners
    ((U, _),) = (problem := join_pieces([piece], PAPER)).split(*_result(problem))
    np.testing.assert_array_equal(U[mirror.partner], U * np.float32([-1, 1, 1]))
    assert np.abs(U - V).max() > 0.05


def _result(problem):
    result = run(problem.stylization(), 30)
    return result.positions, result.rotations


def test_it_is_symmetric_about_the_axes_about_which_it_is():
    V, F = uv_sphere(32, 16)
    piece = with_own_symmetry(piece_of(V, F))
    assert len(piece.whole.mirrored) == 3
    assert np.abs(axes_of()).tolist() == [[1.0, 0.0, 0.0]]


EARS = ears()[0]
RIGHT = EARS[:, 0] > 0.5
NOT_SYMMETRIC = {
    "aslant": {"V": EARS @ rotation(z=0.3)},
    "sheared": {"matrix": np.array([[1, 0.6, 0, 0], [0.6, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])},
    "beside": {"V": EARS + [0.5, 0.0, 0.0]},
    "form": {"style": Style(0.4, rotation(x=0.7, z=0.3), form=tetrahedron())},
    "turned": {"style": Style(0.4, rotation(z=0.3))},
    "moved": {
        "handles": [HandlePose(matrix=tuple(np.diag([1.0, 1, 2, 1]).ravel()))],
        "handle_of": np.where(EARS[:, 2] > 0.9, 0, -1),
    },
    "pinned": {"handles": [HandlePose()], "handle_of": np.where(RIGHT, 0, -1)},
    "map": {"map_weights": np.where(RIGHT, 0.5, 1.0)},
    "detail": {"detail_weights": np.where(RIGHT, 0.5, 1.0)},
    "asked": {"symmetry": (False, True, False)},
    "one ear": {"V": np.where((EARS[:, 2:] > 0.8) & RIGHT[:, None], 0.9 * EARS, EARS)},
}


@pytest.mark.parametrize("why", NOT_SYMMETRIC)
def test_it_is_not_where_something_is_not_symmetric(why):
    asked = [[0.0, 1.0, 0.0]] if why == "asked" else []
    assert np.abs(axes_of(**NOT_SYMMETRIC[why])).tolist() == asked


def test_it_is_told_whether_it_is_symmetric_at_other_places_too():
    V, F = ears()
    whole = with_own_symmetry(piece_of(V, F)).whole
    assert whole.suits(1.1 * V)
    one_sided = V.copy()
    one_sided[V[:, 0].argmax()] += [0.2, 0.0, 0.0]
    assert not whole.suits(one_sided)


def test_what_stands_on_a_floor_is_symmetric_about_upright_planes():
    V, F = uv_sphere(32, 16)
    up = np.array([0.0, 0.0, 1.0])
    assert len(with_own_symmetry(piece_of(V, F), up).whole.mirrored) == 2


@pytest.mark.parametrize("why", ["pinned", "map", "half"])
def test_it_is_where_these_are_symmetric_too(why):
    V, _ = ears()
    outside = np.abs(V[:, 0]) > 0.5
    options = {
        "pinned": {"handles": [HandlePose()], "handle_of": np.where(outside, 0, -1)},
        "map": {"map_weights": np.where(outside, 0.5, 1.0)},
        "half": {"mirrors": [flip(1)]},
    }[why]
    assert [1.0, 0.0, 0.0] in np.abs(axes_of(**options)).tolist()


def test_what_lies_around_held_vertices_of_a_cage_goes_along():
    faces, corners = np.repeat([0, 1], 4), np.array([0, 1, 2, 3, 2, 3, 4, 5])
    cage = SimpleNamespace(faces=faces, corners=corners, sizes=np.full(2, 4))
    held = np.array([1, -1, -1, -1, -1, -1])
    around = Subdivided.beyond_handles(SimpleNamespace(_cage=cage), held)  # type: ignore[arg-type]
    assert around.tolist() == [1, 1, 1, 1, -1, -1]
