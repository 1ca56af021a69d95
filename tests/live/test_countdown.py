# SPDX-License-Identifier: GPL-3.0-or-later
import pytest
from pure import load

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
