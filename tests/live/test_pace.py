# SPDX-License-Identifier: GPL-3.0-or-later
import pytest
from pure import load

pace = load("pace")
Pace, Work, LEAST_PAUSE = pace.Pace, pace.Work, pace.LEAST_PAUSE


def test_nothing_is_due_before_anything_has_changed():
    p = Pace()
    assert not p.is_waiting and p.due(100.0, 0.0) is Work.NOTHING


def test_what_is_quick_is_done_at_once_and_only_once():
    p = Pace()
    p.changed(1.0)
    assert p.due(1.0, 0.0) is Work.FOLLOW
    p.followed(0.01)
    assert p.due(1.1, 0.1) is Work.NOTHING and p.is_waiting
    p.changed(1.1)
    assert p.due(1.2, 0.1) is Work.FOLLOW


@pytest.mark.parametrize(("seconds", "pause"), [(0.1, LEAST_PAUSE), (3.0, 3.0)])
def test_preparing_anew_waits_for_a_pause_as_long_as_it_takes(seconds, pause):
    p = Pace()
    p.changed(0.0)
    p.followed(0.01)
    assert p.due(0.99 * pause, seconds) is Work.NOTHING
    p.changed(0.99 * pause)
    assert p.due(pause, seconds) is not Work.RENEW, "a change begins the pause anew"
    assert p.due(2.0 * pause, seconds) is Work.RENEW
    p.renewed()
    assert not p.is_waiting and p.due(9.0 * pause, seconds) is Work.NOTHING


def test_how_long_the_first_step_takes_is_guessed():
    p = Pace()
    p.changed(0.0)
    assert p.due(0.1, 4.0) is Work.NOTHING
    assert p.due(1.1, 4.0) is Work.FOLLOW


def test_a_slow_step_does_not_disturb_a_stroke():
    p = Pace()
    p.changed(0.0)
    p.followed(0.3)
    for number in range(20):  # a stroke, with a change every twentieth of a second
        p.changed(0.05 * number)
        assert p.due(0.05 * number + 0.04, 5.0) is Work.NOTHING
    assert p.due(0.95 + 0.31, 5.0) is Work.FOLLOW
