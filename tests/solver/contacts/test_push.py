# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces that still cross are pushed apart step by step, and the best step counts."""

import numpy as np
import pytest
import shapes

from solver.contacts import push


@pytest.fixture
def steps(monkeypatch):
    """Return positions after each step, of which the second has fewer crossings than the others."""
    V, F = shapes.blob(1)
    pairs = np.array([[0, 40], [1, 41], [2, 42]])
    left = iter([pairs[:2], pairs[:1], *[pairs] * push.STEPS])

    class Watched:
        def __init__(self, *_):
            pass

        def crossings(self, _):
            return next(left)

    monkeypatch.setattr(push, "Watched", Watched)
    seen = []

    def impose(U):
        U += 1e-4 * (len(seen) + 1)
        seen.append(U.copy())

    counts, is_free = lambda pairs: np.ones(len(pairs), bool), np.ones(len(V), bool)
    best = push.pushed(V, V + 0.0, F, pairs, counts, is_free, impose)
    return seen, best


def test_the_best_step_counts_not_the_last(steps):
    seen, best = steps
    assert len(seen) == push.STEPS
    np.testing.assert_array_equal(best, seen[1])
    assert np.abs(best - seen[-1]).max() > 0.0
