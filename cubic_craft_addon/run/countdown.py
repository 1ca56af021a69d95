# SPDX-License-Identifier: GPL-3.0-or-later
"""How much of a run is done, and about how long the rest takes, in words. Without Blender."""

_LEAST_SECONDS, _LEAST_FRACTION = 1.0, 0.15  # before, an estimate would jump about
_FEW, _STEP = 5.0, 5.0  # seconds; longer times are told in such steps


class Countdown:
    """The words for one run; the time left never rises."""

    def __init__(self):
        self._begin: float | None = None
        self._left = float("inf")

    def texts(self, fraction: float, now: float) -> tuple[str, ...]:
        """Return the words, from long to short.

        Parameters
        ----------
        fraction : what is done, from 0 to 1
        now : the time in seconds
        """
        if self._begin is None:
            self._begin = now
        done = f"{100 * fraction:.0f} %"
        seconds = now - self._begin
        if seconds < _LEAST_SECONDS or fraction < _LEAST_FRACTION:
            return (done,)
        self._left = min(self._left, seconds * (1.0 - fraction) / fraction)
        if self._left < _FEW:
            return (f"{done}, a few seconds left", done)
        left = _STEP * -(-self._left // _STEP)
        words = f"{left:.0f} seconds" if left < 90.0 else f"{left / 60.0:.0f} minutes"
        return (f"{done}, about {words} left", f"{done}, {words}", done)
