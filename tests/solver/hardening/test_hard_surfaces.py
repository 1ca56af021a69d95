# SPDX-License-Identifier: GPL-3.0-or-later
"""What consists of flat sides along the axes is cubic already, and stays as it is."""

import numpy as np
import pytest
from hard_surfaces import chest, gate, wall

from solver import stylize


@pytest.mark.parametrize("shape", [chest, wall])
def test_steps_between_flat_sides_stay(shape):
    """A lid was drawn into its chest, whose ledge was too narrow to be a side of its own.

    And details were found on walls, which tilted them, and took the sills for none.
    """
    V, quads = shape()
    U = stylize(V, quads).positions
    assert np.abs(U - V).max() < 1e-4


def test_sides_that_were_upright_are():
    """The arch of a gate becomes square, by which the posts lean: their outer sides did, too."""
    V, quads = gate()
    U = stylize(V, quads).positions
    assert np.ptp(stylize(V, quads, crispness=0.0).positions[V[:, 0] == 0.0, 0]) > 0.03
    for x in (0.0, 1.0):
        assert np.ptp(U[V[:, 0] == x, 0]) < 1e-3
