# SPDX-License-Identifier: GPL-3.0-or-later
"""What goes along as sides become flat."""

import numpy as np
from proxy_shapes import uv_sphere

from solver import rest_mesh
from solver.hardening.carrying import carried


def body_with_knob():
    """Return the RestMesh of a ball in which a small one is stuck, and which vertices are of it."""
    V, F = uv_sphere(24, 12)
    V, F = np.concatenate([V, 0.2 * V + [0.0, -1.0, 0.0]]), np.concatenate([F, F + len(V)])
    rest = rest_mesh(V, F)
    part = rest.topology.part
    return rest, part != part[np.abs(rest.V - rest.V.min(axis=0)).sum(axis=1).argmin()]


def test_the_lighter_part_goes_along_as_a_whole():
    rest, is_knob = body_with_knob()
    front = rest.V[:, 1] < rest.V[is_knob, 1].max()
    moves = np.where((front & ~is_knob)[:, None], [0.0, 0.1, 0.0], 0.0)
    along = carried(rest, moves, np.empty(0, int))
    assert np.ptp(along[is_knob], axis=0).max() == 0.0
    assert 0.08 < along[is_knob, 1].mean() < 0.11
    assert np.abs(along[~is_knob]).max() < 0.01


def test_what_is_fixed_stays_and_takes_the_other_part_along():
    rest, is_knob = body_with_knob()
    moves = np.where(is_knob[:, None], 0.0, [0.0, 0.1, 0.0])
    along = carried(rest, moves, np.flatnonzero(is_knob)[:1])
    assert np.abs(along[is_knob]).max() < 1e-3
