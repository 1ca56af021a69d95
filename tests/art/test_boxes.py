# SPDX-License-Identifier: GPL-3.0-or-later
"""Boxes of 8 vertices stay boxes as they stand askew, and so do houses of 10.

That those along the axes do not move is tested in `tests/solver/proxy`.
"""

import measures
import numpy as np
import pytest
from art_cases import outcome_of
from art_parts import box

CUBENESS = (0.2, 0.4, 1.0)


@pytest.mark.thorough(4)
@pytest.mark.parametrize("cubeness", CUBENESS)
@pytest.mark.parametrize("name", ["box_10", "box_30", "box_45", "box_skew"])
def test_a_box_that_stands_askew_is_not_skewed(name, cubeness):
    outcome = outcome_of(name, cubeness)
    assert np.abs(corner_angles(outcome.V) - 90).max() <= 0.1
    assert np.abs(corner_angles(outcome.U) - 90).max() <= 2


@pytest.mark.thorough(2)
@pytest.mark.parametrize("cubeness", CUBENESS)
@pytest.mark.parametrize("name", ["crate", "plate"])
def test_a_box_with_beveled_edges_stays_askew(name, cubeness):
    outcome = outcome_of(name, cubeness)
    assert measures.turn(outcome.V, outcome.U, outcome.F) <= 0.5


@pytest.mark.thorough(2)
@pytest.mark.parametrize("cubeness", CUBENESS)
@pytest.mark.parametrize("name", ["house", "house_30"])
def test_the_walls_of_a_house_stay_upright(name, cubeness):
    outcome = outcome_of(name, cubeness)
    walls = outcome.U[4:8] - outcome.U[:4]
    assert angles(walls, np.array([0, 0, 1.0])).max() <= 2
    assert measures.turn(outcome.V, outcome.U, outcome.F) <= 1


def corner_angles(V):
    """Return the angles in degrees at all corners of a box's 6 faces."""
    ring = V[np.array(box((1, 1, 1))[1])]
    forth = np.roll(ring, -1, axis=1) - ring
    return angles(forth.reshape(-1, 3), -np.roll(forth, 1, axis=1).reshape(-1, 3))


def angles(a, b):
    """Return the angles in degrees between vectors (k,3)."""
    cosine = np.sum(a * b, axis=1) / np.linalg.norm(a, axis=1) / np.linalg.norm(b, axis=-1)
    return np.degrees(np.arccos(np.clip(cosine, -1, 1)))
