# SPDX-License-Identifier: GPL-3.0-or-later
from pure import load

Countdown = load("countdown", "run").Countdown


def test_short_runs_tell_only_what_is_done():
    countdown = Countdown()
    assert countdown.texts(0.0, 10.0) == ("0 %",)
    assert countdown.texts(0.5, 10.9) == ("50 %",)


def test_the_time_left_is_rounded_up_and_never_rises():
    countdown = Countdown()
    countdown.texts(0.0, 0.0)
    assert countdown.texts(0.1, 30.0) == ("10 %",), "too early for an estimate"
    assert countdown.texts(0.2, 60.0)[0] == "20 %, about 4 minutes left"
    assert countdown.texts(0.5, 61.0)[0] == "50 %, about 65 seconds left"
    assert countdown.texts(0.5, 80.0)[0] == "50 %, about 65 seconds left"
    long, short, shortest = countdown.texts(0.9, 100.0)
    assert (long, short, shortest) == ("90 %, about 15 seconds left", "90 %, 15 seconds", "90 %")
    assert countdown.texts(0.97, 101.0)[0] == "97 %, a few seconds left"
