# SPDX-License-Identifier: GPL-3.0-or-later
"""Gaps, the times at which they are reached, and the power that is fitted to times."""

import pytest

from scripts.benchmark.fit import exponent, fit_of
from scripts.benchmark.gap import (
    energy_at_gap,
    gap,
    median_seconds_to_energy,
    seconds_to_energy,
)


def test_gap_is_one_at_rest_and_none_at_best():
    assert gap(3.0, rest=3.0, best=2.0) == 1.0
    assert gap(2.0, rest=3.0, best=2.0) == 0.0
    assert gap(2.25, rest=3.0, best=2.0) == 0.25


def test_energy_at_gap_is_the_inverse():
    assert gap(energy_at_gap(0.05, 7.0, 3.0), 7.0, 3.0) == pytest.approx(0.05)


def test_gap_without_descent():
    with pytest.raises(ValueError, match=r"2\.0 must be above .* 2\.0"):
        gap(2.0, rest=2.0, best=2.0)


def test_first_time_at_an_energy():
    curve = [(1.0, 9.0), (2.0, 5.0), (3.0, 6.0), (4.0, 4.0)]
    assert seconds_to_energy(curve, 5.5) == 2.0
    assert seconds_to_energy(curve, 4.0) == 4.0
    assert seconds_to_energy(curve, 3.9) is None


def test_median_needs_every_run():
    runs = [[(1.0, 2.0)], [(3.0, 2.0)], [(9.0, 2.0)]]
    assert median_seconds_to_energy(runs, 2.0) == 3.0
    assert median_seconds_to_energy([*runs, [(1.0, 2.5)]], 2.0) is None


def test_exponent_of_a_power():
    sizes = [10.0, 100.0, 5000.0]
    power, factor = exponent(sizes, [3.0 * size**1.2 for size in sizes])
    assert power == pytest.approx(1.2)
    assert factor == pytest.approx(3.0)


def test_exponent_of_noise_is_that_of_least_squares():
    # in logarithms to the base 10 the points are (0, 0), (1, 1), (2, 1): slope 1/2
    power, factor = exponent([1.0, 10.0, 100.0], [1.0, 10.0, 10.0])
    assert power == pytest.approx(0.5)
    assert factor == pytest.approx(10 ** (1 / 6))


@pytest.mark.parametrize(
    ("sizes", "seconds"), [([5.0], [1.0]), ([5.0, 5.0], [1.0, 2.0]), ([5.0, 6.0], [1.0, 0.0])]
)
def test_exponent_of_too_little(sizes, seconds):
    with pytest.raises(ValueError, match=r"two different sizes|positive"):
        exponent(sizes, seconds)


def size(vertices, seconds, best=1.0):
    return {
        "vertices": vertices,
        "best": best,
        "rest": 2.0,
        "ours": [{"curve": [[seconds / 2, 1.5], [seconds, 1.0]]}],
    }


def test_fit_leaves_out_small_sizes_and_those_without_a_best_energy():
    unknown = size(50_000, 77.0, best=None)
    cases = [size(1000, 50.0), size(10_000, 1.0), unknown, size(100_000, 10.0)]
    power, factor = fit_of(cases)
    assert power == pytest.approx(1.0)
    assert factor == pytest.approx(1e-4)
    assert fit_of(cases[:2]) == (None, None)
