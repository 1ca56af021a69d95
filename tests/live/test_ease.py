# SPDX-License-Identifier: GPL-3.0-or-later
"""How one shape takes the place of another in what is shown."""

import numpy as np
from pure import load

ease = load("ease")
OLD, NEW = np.zeros((2, 3)), np.ones((2, 3))
SECONDS = ease.SECONDS


def begun():
    found = ease.Ease()
    assert found.shown(OLD, 0.0) is OLD and not found.is_on
    found.begin(NEW, 5.0)
    return found


def test_it_begins_at_the_old_shape_and_ends_with_the_new_one_itself():
    found = begun()
    assert np.array_equal(found.shown(NEW, 5.0), OLD)
    ways = [found.shown(NEW, 5.0 + t * SECONDS).mean() for t in (0.25, 0.5, 0.75)]
    assert 0.25 < ways[0] < ways[1] < ways[2] < 1.0
    assert np.diff([0.0, *ways]).tolist() == sorted(np.diff([0.0, *ways]), reverse=True)
    assert found.is_on
    assert found.shown(NEW, 5.1 + SECONDS) is NEW
    assert not found.is_on


def test_the_new_shape_may_move_meanwhile():
    found = begun()
    middle = found.shown(NEW, 5.0 + SECONDS / 2)
    assert np.allclose(found.shown(NEW + 1.0, 5.0 + SECONDS / 2), middle + 1.0)


def test_another_begins_where_it_is():
    found = begun()
    middle = found.shown(NEW, 5.0 + SECONDS / 2)
    found.begin(OLD, 6.0)
    assert np.allclose(found.shown(OLD, 6.0), middle)


def test_a_mesh_with_other_vertices_is_shown_at_once():
    found = begun()
    other = np.ones((3, 3))
    assert found.shown(other, 5.0) is other and not found.is_on
    found.begin(NEW, 6.0)
    assert found.shown(NEW, 6.0) is NEW
