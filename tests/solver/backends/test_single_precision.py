# SPDX-License-Identifier: GPL-3.0-or-later
"""32 bit, as on GPUs without 64 bit: runs to the end with a result that can be used."""

import numpy as np
import pytest
import shapes
from engine_marks import needs_engine

from solver import PAPER, stylize

pytestmark = needs_engine


def single(V, F, cubeness, **options):
    return stylize(V, F, cubeness, device="cpu", precision="f32", proxy=PAPER, **options)


@pytest.mark.thorough(6)
@pytest.mark.parametrize("name", shapes.ALL)
@pytest.mark.parametrize("cubeness", [0.0, 0.4])
def test_runs_converge_to_the_shape_of_64_bit(name, cubeness):
    V, F = shapes.ALL[name]()
    result = single(V, F, cubeness)
    exact = stylize(V, F, cubeness, device="cpu", proxy=PAPER)
    assert result.converged and exact.converged
    assert np.isfinite(result.positions).all()
    assert result.energy.total == pytest.approx(exact.energy.total, rel=1e-3, abs=1e-5)
