# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygons have one side each: folded along a diagonal, they would be teeth along each edge."""

import numpy as np
import shapes

from solver import Run, Setup, Style, Stylization, flip, piece_of, rest_mesh
from solver.mesh.polygons import triangulate


def ball(n=14):
    """Return a bumpy ball that is turned against the axes, of the quads of a cube's grid."""
    grid = np.stack(np.meshgrid(*3 * [np.arange(n + 1)], indexing="ij"), axis=-1).reshape(-1, 3)
    V = np.tan((2.0 * grid / n - 1.0) * np.pi / 4.0)
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
    V = V[used] / np.linalg.norm(V[used], axis=1, keepdims=True)
    V *= 1.0 + 0.05 * np.sin(7.0 * V @ [1.0, 2.0, 3.0])[:, None]  # no quad is flat
    return V @ shapes.rotation(0.6, 0.5, 0.2).T, Q.reshape(-1, 4)


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
