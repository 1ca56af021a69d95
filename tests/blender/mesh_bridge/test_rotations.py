# SPDX-License-Identifier: GPL-3.0-or-later
import importlib

import numpy as np
import pytest
from mathutils import Quaternion
from rich_mesh import cubic_like


@pytest.fixture
def rotations(bridge):
    return importlib.import_module(f"{bridge.__name__}.access.rotations")


def test_there_and_back(rotations):
    matrices = cubic_like(np.zeros((500, 3)))[1]
    quaternions = rotations.quaternions_from_matrices(matrices)
    assert quaternions.dtype == np.float32
    back = rotations.matrices_from_quaternions(quaternions)
    np.testing.assert_allclose(back, matrices, atol=5e-7)
    np.testing.assert_allclose(back @ back.transpose(0, 2, 1), [np.eye(3)] * 500, atol=1e-15)


def test_as_blender_reads_them(rotations):
    matrix = cubic_like(np.zeros((1, 3)))[1][0]
    quaternion = Quaternion(rotations.quaternions_from_matrices(matrix[None])[0])
    np.testing.assert_allclose(np.array(quaternion.to_matrix()), matrix, atol=1e-6)


def test_half_turns(rotations):
    """Where the real part vanishes, and with it the simple formula."""
    turns = np.array([np.diag(d) for d in ((1, -1, -1), (-1, 1, -1), (-1, -1, 1))], float)
    quaternions = rotations.quaternions_from_matrices(turns)
    assert np.array_equal(quaternions, np.eye(4)[1:])
    assert np.array_equal(rotations.matrices_from_quaternions(quaternions), turns)


def test_identity_is_exact(rotations):
    quaternions = rotations.quaternions_from_matrices(np.eye(3)[None])
    assert quaternions.tolist() == [[1, 0, 0, 0]]
    assert np.array_equal(rotations.matrices_from_quaternions(quaternions)[0], np.eye(3))
