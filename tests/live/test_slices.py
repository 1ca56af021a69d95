# SPDX-License-Identifier: GPL-3.0-or-later
import pytest
from pure import load

slices = load("slices")
Slices, SLICE, LONGEST = slices.Slices, slices.SLICE, slices.LONGEST


@pytest.mark.parametrize(
    ("pause", "drawing", "seconds"),
    [(0.1, 0.05, SLICE), (1.0, 0.05, 0.15), (1.0, 1.0, LONGEST), (1.0, 0.0, SLICE)],
)
def test_a_tick_takes_most_of_the_time_once_nothing_is_done(pause, drawing, seconds):
    s = Slices()
    s.touch(10.0)
    s.end(10.0 + pause - drawing)
    assert s.begin(10.0 + pause) == pytest.approx(seconds)


def test_whatever_is_done_makes_ticks_short_again():
    s = Slices()
    s.end(9.0)
    assert s.begin(10.0) == LONGEST
    s.touch(10.0)
    assert s.begin(10.1) == SLICE
