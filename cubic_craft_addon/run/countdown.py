# SPDX-License-Identifier: GPL-3.0-or-later
"""How much of a run is done, and about how long the rest takes, in words. Without Blender."""

import math

_LEAST_SECONDS, _LEAST_DONE = 2.0, 0.25  # before, an estimate would jump about
_APART = 1.0
"""the time that Keep Apart is assumed to take, in that of the iterations, as nobody knows before: a
tenth where nothing crosses, and up to twice as long where much does"""
_WRONG = 1.5
"""so much longer than it was told, and the time left rises again: otherwise it only falls"""
_FEW, _STEP, _MINUTE = 5.0, 10.0, 55.0
"""seconds: fewer are "a few", more are told in such steps, and from there on in minutes"""


class Countdown:
    """The words for one run, which iterates and then may keep surfaces apart."""

    def __init__(self, *, keeps_apart: bool):
        self._rest = _APART if keeps_apart else 0.0
        self._begin: float | None = None
        self._iterated_in: float | None = None
        self._left = 0.0

    def tell(
        self, iterated: float, now: float, *, is_keeping_apart: bool = False
    ) -> tuple[tuple[str, ...], float]:
        """Return the words, from long to short, and the fraction that is done.

        `iterated`: what is done of the iterations, from 0 to 1, which never decreases. `now`: the
        time in seconds. `is_keeping_apart`: whether the iterations are over.
        """
        if self._begin is None:
            self._begin = now
        seconds = now - self._begin
        if is_keeping_apart:
            fraction = self._fraction_apart(seconds)
            done = _per_cent(fraction)
            return (f"{done}, keeping surfaces apart", done), fraction
        fraction = iterated / (1.0 + self._rest)
        done = _per_cent(fraction)
        if seconds < _LEAST_SECONDS or iterated < _LEAST_DONE:
            return (done,), fraction
        left = seconds / iterated * (1.0 - iterated + self._rest)
        if not self._left or left < self._left or left > _WRONG * self._left:
            self._left = left
        if self._left < _FEW:
            return (f"{done}, a few seconds left", done), fraction
        words = _in_words(self._left)
        return (f"{done}, about {words} left", f"{done}, {words}", done), fraction

    def _fraction_apart(self, seconds):
        """Return a fraction that rises ever more slowly, as the end is not known."""
        iterated_in = self._iterated_in = (
            seconds if self._iterated_in is None else self._iterated_in
        )
        over = (seconds - iterated_in) / max(self._rest * iterated_in, 1e-3)
        return 1.0 - self._rest / (1.0 + self._rest) * math.exp(-over)


def _per_cent(fraction):
    return f"{min(int(100 * fraction), 99)} %"


def _in_words(seconds):
    if seconds < _MINUTE:
        return f"{_STEP * math.ceil(seconds / _STEP):.0f} seconds"
    minutes = round(seconds / 60.0)
    return f"{minutes} minutes" if minutes > 1 else "a minute"
