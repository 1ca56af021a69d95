# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes that cannot be solved are refused with the reason."""

import numpy as np
import pytest

from solver import CubicCraftError
from solver.mesh.mesh_checks import check_mesh

V = np.eye(3)
F = np.array([[0, 1, 2]])


@pytest.mark.parametrize(
    ("V", "F", "message"),
    [
        (V[:, :2], F, r"positions must have the shape \(n, 3\)"),
        (V, F[:, :2], r"triangles must have the shape \(m, 3\)"),
        (V, F[:0], "no faces"),
        (V[:2], F % 2, "only 2 vertices"),
        (V, F.astype(float), "must be integers"),
        (V, F + 1, "only 3"),
        (V, F - 1, "-1 to 1"),
        (V + [0, np.nan, 0], F, "not finite"),
        (V + [[0, 0, 0], [0, np.inf, 0], [0, 0, 0]], F, "the first is vertex 1"),
    ],
)
def test_refusals(V, F, message):
    with pytest.raises(CubicCraftError, match=message):
        check_mesh(V, F)


def test_lists_and_32_bit_arrays_are_taken():
    checked_V, checked_F = check_mesh(V.astype(np.float32).tolist(), F.tolist())
    assert checked_V.dtype == np.float64
    assert checked_F.dtype == np.int32
