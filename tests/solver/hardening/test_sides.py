# SPDX-License-Identifier: GPL-3.0-or-later
"""Sides: their borders are as short as the faces let them be, and polygons have one side each.

Folded along a diagonal, polygons would be teeth along each edge.
"""

import numpy as np
import pytest
from shapes import rotation

from solver import Run, Setup, Style, Stylization, flip, piece_of, rest_mesh
from solver.hardening.sides import sides_of
from solver.mesh.face_graph import FaceGraph
from solver.mesh.polygons import triangulate


def cubed_ball(n):
    """Return a ball of six grids of n x n quads."""
    grid = np.stack(np.meshgrid(*3 * [np.arange(n + 1)], indexing="ij"), axis=-1).reshape(-1, 3)
    quads = []
    for axis in range(3):
        i, k = np.eye(3, dtype=int)[[(axis + 1) % 3, (axis + 2) % 3]]
        for end in (0, n):
            start = grid[(grid[:, axis] == end) & (grid @ i < n) & (grid @ k < n)]
            around = (i * 0, i, i + k, k) if end else (i * 0, k, i + k, i)
            quads.append(
                np.stack([(start + step) @ [(n + 1) ** 2, n + 1, 1] for step in around], 1)
            )
    used, Q = np.unique(np.concatenate(quads), return_inverse=True)
    V = np.tan((2.0 * grid[used] / n - 1.0) * np.pi / 4.0)
    return V / np.linalg.norm(V, axis=1)[:, None], Q.reshape(-1, 4)


def teeth(graph, side):
    """Return how many triangles have two neighbors of one other side."""
    ends = np.concatenate([graph.one, graph.other]), np.concatenate([graph.other, graph.one])
    others = np.zeros((len(side), 6), dtype=int)
    is_other = side[ends[0]] != side[ends[1]]
    np.add.at(others, (ends[0][is_other], side[ends[1]][is_other]), 1)
    return int((others.max(axis=1) >= 2).sum())


@pytest.mark.parametrize("angles", [(0.0, 0.0, 0.0), (3.0, 5.0, 8.0), (20.0, -10.0, 30.0)])
def test_borders_have_no_teeth(angles):
    V, Q = cubed_ball(16)
    V, F = V * [0.8, 0.95, 1.1] @ rotation(*angles).T, np.concatenate([Q[:, :3], Q[:, [0, 2, 3]]])
    graph = FaceGraph(V, F)
    frames = np.repeat(np.eye(3)[None], len(F), axis=0)
    of_one, free = np.zeros(len(F), int), np.zeros(len(F), bool)
    side, _, _ = sides_of(graph, graph.normals, frames, (), of_one, is_free=free)
    assert len(np.unique(side)) == 6
    assert teeth(graph, side) <= 8  # at the corners, where three sides meet


def ball():
    """Return a bumpy ball of quads that is turned against the axes."""
    V, Q = cubed_ball(14)
    V *= 1.0 + 0.05 * np.sin(7.0 * V @ [1.0, 2.0, 3.0])[:, None]  # no quad is flat
    return V @ rotation(0.6, 0.5, 0.2).T, Q


def cut_faces(F):
    """Return the number of quads of which some triangle belongs to another side than the rest."""
    V, Q = ball()
    state = Stylization(Setup(rest_mesh(V, F)), Style(0.4, crispness=1.0))
    run = Run(state)
    run.complete()
    assert run.hard is not None and run.hard.rest.whole is not None
    side, whole = run.hard.hardening.side, run.hard.rest.whole
    pairs = np.unique(np.stack([whole // (2 if F.shape[1] == 3 else 1), side], axis=1), axis=0)
    return len(pairs) - len(Q)


def test_a_quad_belongs_to_one_side():
    V, Q = ball()
    assert cut_faces(triangulate(V, Q)) > 0
    assert cut_faces(Q) == 0


def test_faces_are_known_for_mirror_images_and_any_number_of_corners():
    V, Q = ball()
    mixed = [Q[0, :3], Q[0, [0, 2, 3]], *Q[1:]]
    piece = piece_of(V + [1.2, 0.0, 0.0], mixed, Style(0.4), mirrors=[flip(0)])
    faces = piece.whole.faces
    assert faces is not None and len(faces) == len(piece.F) == 4 * len(Q)
    _, sizes = np.unique(faces, return_counts=True)
    assert np.bincount(sizes).tolist() == [0, 4, 2 * (len(Q) - 1)]
    for face in faces[:: len(faces) // 7]:
        assert len(np.unique(piece.F[faces == face])) <= 4, "its triangles have an edge in common"
