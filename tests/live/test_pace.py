# SPDX-License-Identifier: GPL-3.0-or-later
"""How long ticks are, when what is due, and the words for the time that is left."""

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


Countdown = load("countdown", "run").Countdown


def words(countdown, iterated, now, **state):
    return countdown.tell(iterated, now, **state)[0]


@pytest.fixture
def countdown():
    return Countdown(keeps_apart=False)


def test_short_runs_tell_only_what_is_done(countdown):
    assert words(countdown, 0.0, 10.0) == ("0 %",)
    assert words(countdown, 0.5, 11.9) == ("50 %",)


def test_the_time_left_is_told_in_steps_and_only_falls(countdown):
    words(countdown, 0.0, 0.0)
    assert words(countdown, 0.2, 30.0) == ("20 %",), "too early for an estimate"
    assert words(countdown, 0.25, 60.0)[0] == "25 %, about 3 minutes left"
    assert words(countdown, 0.5, 62.0)[0] == "50 %, about a minute left"
    assert words(countdown, 0.6, 63.0)[0] == "60 %, about 50 seconds left"
    assert words(countdown, 0.6, 80.0)[0] == "60 %, about 50 seconds left"
    long, short, shortest = words(countdown, 0.9, 100.0)
    assert (long, short, shortest) == ("90 %, about 20 seconds left", "90 %, 20 seconds", "90 %")
    assert words(countdown, 0.97, 101.0)[0] == "97 %, a few seconds left"


def test_it_rises_where_it_was_much_too_short(countdown):
    words(countdown, 0.0, 0.0)
    assert words(countdown, 0.5, 10.0)[0] == "50 %, about 10 seconds left"
    assert words(countdown, 0.51, 14.0)[0] == "51 %, about 10 seconds left"
    assert words(countdown, 0.51, 40.0)[0] == "51 %, about 40 seconds left"


def test_keep_apart_has_its_share_and_no_end_that_is_told():
    countdown = Countdown(keeps_apart=True)
    assert countdown.tell(0.0, 0.0) == (("0 %",), 0.0)
    texts, fraction = countdown.tell(0.9, 9.0)
    assert texts[0] == "45 %, about 20 seconds left" and fraction == pytest.approx(0.45)
    before = fraction
    for now in (10.0, 11.0, 15.0, 30.0, 1e3):
        texts, fraction = countdown.tell(0.99, now, is_keeping_apart=True)
        assert texts == (f"{texts[1]}, keeping surfaces apart", texts[1])
        assert before < fraction <= 1.0 and texts[1] != "100 %"
        before = fraction


def test_runs_that_are_over_at_once_have_words_too():
    countdown = Countdown(keeps_apart=True)
    (text, _), fraction = countdown.tell(0.99, 5.0, is_keeping_apart=True)
    assert text == "50 %, keeping surfaces apart" and 0.0 < fraction < 1.0
