# SPDX-License-Identifier: GPL-3.0-or-later
"""The stop rule needs both a shape at rest and an energy at rest."""

from types import SimpleNamespace

import pytest

from solver import Progress, StopRule


def iterations(rule, sequence, limit=10000):
    for count, (energy, displacement) in enumerate(sequence, 1):
        if rule.is_converged(energy, displacement, 1.0):
            return count
        if count == limit:
            break
    return None


def geometric(energy_rate, displacement_rate):
    energy, displacement = 1.0, 1.0
    while True:
        yield 1.0 + energy, displacement
        energy *= energy_rate
        displacement *= displacement_rate


def test_both_at_rest_converge():
    assert iterations(StopRule(1e-3), geometric(0.9, 0.9)) == pytest.approx(80, abs=30)


def test_a_moving_shape_does_not_converge():
    assert iterations(StopRule(1e-3), geometric(0.5, 1.0)) is None


def test_a_falling_energy_does_not_converge():
    steady = ((10.0 - 1e-3 * k, 1e-6) for k in range(5000))
    assert iterations(StopRule(1e-3), steady) is None


def test_a_shape_that_never_moves_converges_after_a_few_iterations():
    rule = StopRule(1e-3)
    ends = [rule.is_converged(0.0, 0.0, 0.0) for _ in range(4)]
    assert ends == [False, False, True, True]


def test_progress_rises_to_one():
    progress = Progress(100, 1e-3)
    values = []
    for k in range(1, 101):
        state = SimpleNamespace(
            iterations=k, displacement=0.5**k, distance=1.0, is_limited=False, is_coarse=False
        )
        values.append(progress.update(state))
    assert values == sorted(values)
    assert 0.0 < values[0] < 0.2
    assert values[-1] == 1.0


def test_parts_that_only_swing_are_not_waited_for():
    swinging = geometric(0.7, 1.0)
    assert iterations(StopRule(1e-3, may_swing=True), swinging) == pytest.approx(40, abs=15)


def test_parts_that_may_swing_are_waited_for_while_the_energy_falls_or_rises():
    steady = ((10.0 - 1e-3 * k, 1.0) for k in range(5000))
    assert iterations(StopRule(1e-3, may_swing=True), steady) is None
    rising = ((10.0 - (k % 15) - 1e-2 * k, 1.0) for k in range(900))
    assert iterations(StopRule(1e-3, may_swing=True), rising) is None


def test_parts_that_drift_are_not_waited_for_where_there_is_nothing_to_gain():
    """As the rings of chain mail: all of the fall is less than a millionth of the energy."""
    drifting = ((1.0 - 1e-10 * k, 1.0) for k in range(5000))
    assert iterations(StopRule(1e-3, may_swing=True), drifting) == pytest.approx(21, abs=5)
    small_part = ((1.0 + 1e-3 * 0.9**k, 0.95**k) for k in range(5000))
    assert iterations(StopRule(1e-3, may_swing=True), small_part) > 60
