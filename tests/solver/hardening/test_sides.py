# SPDX-License-Identifier: GPL-3.0-or-later
"""Sides: their borders are as short as the triangles let them be."""

import numpy as np
import pytest
from shapes import rotation

from solver.hardening.sides import sides_of
from solver.mesh.face_graph import FaceGraph

N = 16


def cubed_ball():
    """Return a ball of six grids: its quads are flat, and split along one diagonal each."""
    u, v = np.meshgrid(np.linspace(-1.0, 1.0, N + 1), np.linspace(-1.0, 1.0, N + 1))
    at = np.arange((N + 1) ** 2).reshape(N + 1, N + 1)
    a, b, c, d = (x.ravel() for x in (at[:-1, :-1], at[:-1, 1:], at[1:, 1:], at[1:, :-1]))
    grid = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    V, F = [], []
    for axis in range(3):
        for sign in (-1.0, 1.0):
            sheet = np.roll(np.stack([np.full(u.size, sign), u.ravel(), v.ravel()], 1), axis, 1)
            F.append((grid if sign > 0.0 else grid[:, ::-1]) + len(V) * len(sheet))
            V.append(sheet)
    keys, place = np.unique(np.concatenate(V).round(9), axis=0, return_inverse=True)
    return keys / np.linalg.norm(keys, axis=1)[:, None], place.ravel()[np.concatenate(F)]


def teeth(graph, side):
    """Return how many triangles have two neighbors of one other side."""
    ends = np.concatenate([graph.one, graph.other]), np.concatenate([graph.other, graph.one])
    others = np.zeros((len(side), 6), dtype=int)
    is_other = side[ends[0]] != side[ends[1]]
    np.add.at(others, (ends[0][is_other], side[ends[1]][is_other]), 1)
    return int((others.max(axis=1) >= 2).sum())


@pytest.mark.parametrize("angles", [(0.0, 0.0, 0.0), (3.0, 5.0, 8.0), (20.0, -10.0, 30.0)])
def test_borders_have_no_teeth(angles):
    V, F = cubed_ball()
    V = V * [0.8, 0.95, 1.1] @ rotation(*angles).T
    graph = FaceGraph(V, F)
    frames = np.repeat(np.eye(3)[None], len(F), axis=0)
    of_one, free = np.zeros(len(F), int), np.zeros(len(F), bool)
    side, _, _ = sides_of(graph, graph.normals, frames, (), of_one, is_free=free)
    assert len(np.unique(side)) == 6
    assert teeth(graph, side) <= 8  # at the corners, where three sides meet
