# SPDX-License-Identifier: GPL-3.0-or-later
"""The borders of sides: straight, whatever the triangles are like."""

import numpy as np
import pytest
from facing import share_facing
from proxy_shapes import house, torus, uv_sphere
from shapes import sheet

from solver import Run, Setup, SolverOptions, Style, Stylization, rest_mesh
from solver.hardening.borders import straightening
from solver.mesh.face_graph import FaceGraph

SLANT = 0.4
"""of the border of a roof, against the edges of its triangles"""


def roof(n=24, noise=0.1):
    """Return a roof whose ridge lies aslant on its grid, and the side of each triangle.

    Vertices along the ridge are off it by up to so much of an edge.
    """
    V, F = sheet(n + 1)
    V = V * [1.0, 1.0, 0.0]
    across = V[F].mean(axis=1) @ [1.0, -SLANT, 0.0] - 0.5 + SLANT / 2
    side = (across > 0.0).astype(np.int64)
    is_ridge = np.zeros(len(V), dtype=bool)
    is_ridge[np.intersect1d(F[side == 0], F[side == 1])] = True
    height = np.abs(V @ [1.0, -SLANT, 0.0] - 0.5 + SLANT / 2)
    V[:, 2] = -np.where(is_ridge, 0.0, height)
    shift = np.random.default_rng(1).uniform(-noise, noise, (len(V), 3)) / n
    V[is_ridge] += shift[is_ridge]
    return V, F, side, is_ridge


def directions_of(side):
    lean = np.array([[-1.0, SLANT, 0.0], [1.0, -SLANT, 0.0]]) + [0.0, 0.0, 1.0]
    return (lean / np.linalg.norm(lean, axis=1, keepdims=True))[side]


def bends(V, is_ridge):
    """Return how far each vertex of the ridge is from the middle of those beside it."""
    ridge = V[is_ridge][np.argsort(V[is_ridge] @ [SLANT, 1.0, 0.0])]
    return np.linalg.norm(ridge[1:-1] - 0.5 * (ridge[2:] + ridge[:-2]), axis=1)


@pytest.mark.parametrize("fixed", [(), (300, 301)])
def test_only_the_border_moves_and_becomes_straight(fixed):
    V, F, side, is_ridge = roof()
    moves = straightening(V, F, FaceGraph(V, F), side, directions_of(side), np.array(fixed, int))
    assert not moves[~is_ridge].any() and not moves[list(fixed)].any()
    assert moves[is_ridge].any()
    before, after = bends(V, is_ridge), bends(V + moves, is_ridge)
    assert after.mean() < 0.6 * before.mean()
    areas = np.cross(*(V + moves)[F].swapaxes(0, 1)[1:] - (V + moves)[F[:, 0]])
    assert (np.einsum("mj,mj->m", areas, directions_of(side)) > 0.0).all()


def test_what_has_no_side_stays():
    V, F, side, _ = roof()
    side[side == 1] = -1
    graph = FaceGraph(V, F)
    assert not straightening(V, F, graph, side, directions_of(side), np.empty(0, int)).any()


def crisp(V, F, crispness):
    """Return a Run to flat sides, at its end."""
    made = Run(
        Stylization(
            Setup(rest_mesh(V, F)),
            Style(0.4, crispness=crispness),
            options=SolverOptions(keep_rotation=True),
        )
    )
    made.complete()
    return made


def sharpest_turn(U, F, side):
    """Return the largest angle, in degrees, by which a border of two sides of triangles turns."""
    graph = FaceGraph(U, F)
    edge = graph.edge[side[graph.one] != side[graph.other]]
    ends = np.stack([graph.edges.lower[edge], graph.edges.upper[edge]], axis=1)
    turns = []
    for vertex in np.flatnonzero(np.bincount(ends.ravel()) == 2):
        beside = ends[(ends == vertex).any(axis=1)].sum(axis=1) - vertex
        one, other = (x / np.linalg.norm(x) for x in U[beside] - U[vertex])
        turns.append(np.degrees(np.arccos(np.clip(-one @ other, -1.0, 1.0))))
    return max(turns)


def sphere(segments):
    """Return the sphere that Blender begins with: quads, and triangles around the poles."""
    V, F = uv_sphere(segments, segments // 2)
    first, second = F[segments:-segments].reshape(-1, 2, segments, 3).swapaxes(0, 1)
    quads = np.concatenate([first, second[..., 2:]], axis=2).reshape(-1, 4)
    return V, [*F[:segments].tolist(), *quads.tolist(), *F[-segments:].tolist()]


@pytest.mark.thorough(4)
@pytest.mark.parametrize("crispness", [1.0, 0.9])
@pytest.mark.parametrize(
    ("mesh", "share"),
    [(sphere(16), 0.97), (sphere(24), 0.88), (sphere(32), 0.97), (torus(), 0.75)],
    ids=["16", "24", "32", "torus"],
)
def test_what_artists_begin_with_has_no_nicks(mesh, share, crispness):
    """Borders climb from row to row, in steps that are long in the refined mesh.

    Where a tenth of the soft shape stayed, so did its steps, of 12 and 29 degrees.
    """
    made = crisp(*mesh, crispness)
    rest, hardening = made.hard.rest, made.hard.hardening
    side = np.empty(len(rest.unrefined), int)
    side[rest.pieces] = hardening.side
    result = made.result()
    U = rest.input_map.points(result.positions)
    assert sharpest_turn(U, rest.unrefined, side) < 6.0 and result.crossings == 0
    assert share_facing(U, rest.unrefined, degrees=6.0) > share


def test_the_end_of_a_ridge_is_a_corner():
    """As one of two vertices between gable and roof, it was smoothed away: 4 degrees were left."""
    U = crisp(*house(), 0.9).result().positions
    across = U[9] - U[7]
    assert np.degrees(np.arctan2(across[2], -across[0])) > 14.0
