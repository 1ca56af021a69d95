# SPDX-License-Identifier: GPL-3.0-or-later
"""What consists of flat sides along the axes is cubic already, and stays as it is."""

import numpy as np
import pytest
from hard_surfaces import chest, wall

from solver import stylize


@pytest.mark.parametrize("shape", [chest, wall])
def test_steps_between_flat_sides_stay(shape):
    """A lid was drawn into its chest, whose ledge was too narrow to be a side of its own.

    And details were found on walls, which tilted them, and took the sills for none.
    """
    V, quads = shape()
    U = stylize(V, quads).positions
    assert np.abs(U - V).max() < 1e-4
