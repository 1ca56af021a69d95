# SPDX-License-Identifier: GPL-3.0-or-later
"""Pieces that are solved together stay symmetric about a common plane."""

import numpy as np
import pytest
from proxy_shapes import uv_sphere

from solver import HandlePose, ProxyOptions, Style, join_pieces, piece_of, run
from solver.styles.forms import octahedron

PROXY = ProxyOptions()


def at(x, y, z, style=None, **options):
    """Return a small ball at a place, with its own origin."""
    V, F = uv_sphere(12, 6)
    matrix = np.diag([0.3, 0.3, 0.3, 1.0])
    matrix[:3, 3] = x, y, z
    return piece_of(V, F, style or Style(0.4), matrix=matrix, **options)


def head(offset=0.0, **options):
    """Return a head with a nose, which is symmetric about X only."""
    V, F = uv_sphere(32, 16)
    nose = np.exp(-8.0 * ((V - [0.0, -1.0, 0.0]) ** 2).sum(axis=1))[:, None]
    matrix = np.eye(4)
    matrix[0, 3] = offset
    return piece_of(V + nose * [0, -0.6, 0.3], F, Style(0.4), matrix=matrix, **options)


def eyes():
    return [at(0.5, -0.75, 0.4), at(-0.5, -0.75, 0.4)]


def planes_of(pieces):
    return join_pieces(pieces, PROXY, keep_symmetric=True).planes


def test_a_head_and_its_eyes_are_each_others_images():
    problem = join_pieces(pieces := [head(), *eyes()], PROXY, keep_symmetric=True)
    (_, left, right), V = _results(problem), pieces[1].V
    images = pieces[2].V * [-1, 1, 1]
    order = np.abs(V[:, None] - images[None]).sum(axis=2).argmin(axis=1)
    assert np.abs(left - V).max() > 0.01
    np.testing.assert_allclose(left, (right * [-1, 1, 1])[order], atol=1e-12)


def _results(problem):
    result = run(problem.stylization(), 20)
    ends = np.cumsum([piece.solved for piece in problem.pieces])[:-1]
    return np.split(result.positions, ends)


def test_each_figure_has_its_own_plane():
    """Two heads side by side hold on to nothing of each other."""
    first, second = planes_of([head(), head(offset=5.0)])
    half = len(first.partner) // 2
    assert (first.partner[:half] >= 0).all() and (first.partner[half:] < 0).all()
    assert (second.partner[:half] < 0).all() and (second.partner[half:] >= 0).all()


@pytest.mark.parametrize("why", ["one eye", "painted", "moved", "other form", "not asked"])
def test_it_is_not_where_something_is_not_symmetric(why):
    pieces = [head(), *eyes()]
    if why == "one eye":
        del pieces[2]
    if why == "painted":
        pieces[2] = at(-0.5, -0.75, 0.4, map_weights=np.full(pieces[2].vertices, 0.5))
    if why == "moved":
        lift = HandlePose(matrix=tuple(np.diag([1.0, 1, 2, 1]).ravel()))
        pieces[0] = head(handles=[lift], handle_of=np.where(pieces[0].V[:, 2] > 0.9, 0, -1))
    if why == "other form":
        pieces[2] = at(-0.5, -0.75, 0.4, style=Style(0.4, form=octahedron()))
    problem = join_pieces(pieces, PROXY, keep_symmetric=why != "not asked")
    assert not any(mirror.count for mirror in problem.setup.mirrors)


def test_a_ground_does_not_matter():
    V = np.array([[-1.0, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * [9, 5, 1] + [3, 1, -1.001]
    ground = piece_of(V, np.array([[0, 1, 2], [0, 2, 3]]), Style(0.4))
    (plane,) = planes_of([head(), *eyes(), ground])
    assert plane.count == len(plane.partner) - ground.solved


def test_a_problem_reuses_what_it_found():
    pieces = [head(), *eyes()]
    first = join_pieces(pieces, PROXY, keep_symmetric=True)
    again = join_pieces(pieces, PROXY, [first], keep_symmetric=True)
    assert again.setup is first.setup and again.planes is first.planes
    assert join_pieces(pieces, PROXY, [first]).setup is not first.setup
