# SPDX-License-Identifier: GPL-3.0-or-later
"""Components that float are put back to where they were; the others stay, bit for bit."""

import numpy as np
import pytest
import shapes

from solver import PAPER
from solver.global_step.centring import Centring
from solver.preparation import rest_mesh


@pytest.mark.parametrize("floats", [[True, False], [False, True], [True, True]])
def test_only_what_floats_is_moved(floats):
    rest = rest_mesh(*shapes.two_blobs(), proxy=PAPER)
    floats = np.array(floats)
    moved = rest.V + np.array([[0.1, 0.0, 0.0], [0.0, 0.2, 0.3]])[rest.topology.component]
    result = moved.copy()
    Centring(rest, floats).impose(result)
    is_back = floats[rest.topology.component]
    np.testing.assert_allclose(result[is_back], rest.V[is_back], atol=1e-12)
    np.testing.assert_array_equal(result[~is_back], moved[~is_back])
