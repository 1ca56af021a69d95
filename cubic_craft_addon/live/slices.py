# SPDX-License-Identifier: GPL-3.0-or-later
"""How long a tick computes before Blender draws and handles events again. Without Blender.

While the artist does something, ticks are short. While nobody does, most of the time would go to
drawing shapes that hardly differ, so ticks are as long as leaves them most of it.
"""

SLICE = 0.02
"""seconds per tick while the artist does something, plus the last phase of the solver"""
_CALM = 0.5  # seconds without anything done
_TIMES = 3.0  # as long as showing and drawing take
LONGEST = 0.2
"""seconds per tick, after which a click is still answered at once"""


class Slices:
    """The slices of one session."""

    def __init__(self):
        self._touched_at = self._computed_at = float("-inf")

    def touch(self, now: float) -> None:
        """Record that the artist has done something, at a time in seconds."""
        self._touched_at = now

    def begin(self, now: float) -> float:
        """Return how many seconds to compute from now on."""
        if now - self._touched_at < _CALM:
            return SLICE
        return max(SLICE, min(_TIMES * (now - self._computed_at), LONGEST))

    def end(self, now: float) -> None:
        """Record when the computing of a tick has ended: what follows shows and draws it."""
        self._computed_at = now
