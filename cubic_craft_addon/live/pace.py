# SPDX-License-Identifier: GPL-3.0-or-later
"""When Live computes what, while the artist works on an original. Without Blender.

Blender stands still while a mesh is prepared. So what takes long waits for a pause that is as long,
and a stroke goes on undisturbed.
"""

from enum import Enum, auto

LEAST_PAUSE = 0.5
"""seconds without a change, after which the exact run begins"""
_SHARE = 0.25  # of the time for preparing anew that FOLLOW is expected to take the first time


class Work(Enum):
    """What to do now."""

    NOTHING = auto()
    FOLLOW = auto()
    """go on from the present solution, with the factorization that is there"""
    RENEW = auto()
    """prepare and solve the original anew, as Cubify does"""


class Pace:
    """The pace for the originals of one session."""

    def __init__(self):
        self._changed_at: float | None = None
        self._is_followed = False
        self._seconds_to_follow: float | None = None

    @property
    def is_waiting(self):
        """Whether there is something to do now or later."""
        return self._changed_at is not None

    def changed(self, now: float) -> None:
        """Record that an original has changed, at a time in seconds."""
        self._changed_at, self._is_followed = now, False

    def due(self, now: float, seconds_to_renew: float) -> Work:
        """Return what to do now, if preparing anew takes so many seconds."""
        if self._changed_at is None:
            return Work.NOTHING
        pause = now - self._changed_at
        if pause >= max(LEAST_PAUSE, seconds_to_renew):
            return Work.RENEW
        expected = self._seconds_to_follow
        if expected is None:
            expected = _SHARE * seconds_to_renew
        if not self._is_followed and pause >= expected:
            return Work.FOLLOW
        return Work.NOTHING

    def followed(self, seconds: float) -> None:
        """Record that FOLLOW was done, and how long it took."""
        self._is_followed, self._seconds_to_follow = True, seconds

    def renewed(self) -> None:
        """Record that RENEW was done, or that nothing is left to do."""
        self._changed_at = None
