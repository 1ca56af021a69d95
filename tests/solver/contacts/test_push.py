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


def test_many_that_do_not_come_apart_are_given_up_soon(monkeypatch):
    """Of a heap of coins, 4,000 pairs crossed after 15 steps, and after 40."""
    V, F = shapes.blob(2)
    pairs = np.array([[k, k + 160] for k in range(push.MANY + 20)])
    steps = []

    class Watched:
        def __init__(self, *_):
            pass

        def crossings(self, _):
            steps.append(len(pairs))
            return pairs

    monkeypatch.setattr(push, "Watched", Watched)
    counts, is_free = lambda pairs: np.ones(len(pairs), bool), np.ones(len(V), bool)
    push.pushed(V, V + 0.0, F, pairs, counts, is_free, lambda _: None)
    assert len(steps) == push.PATIENCE
