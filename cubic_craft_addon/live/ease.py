# SPDX-License-Identifier: GPL-3.0-or-later
"""How one shape takes the place of another within a few frames. Without Blender.

What is shown is the new shape and a part of what the old one differs from it. That part dwindles,
first fast and then slowly, whatever the new shape does meanwhile.
"""

import numpy as np

SECONDS = 0.3
"""after which the new shape is shown as it is"""


class Ease:
    """From the shape that is seen to the one that is shown from now on."""

    def __init__(self):
        self._seen: np.ndarray | None = None
        self._difference: np.ndarray | None = None
        self._began = 0.0

    @property
    def is_on(self):
        """Whether what was shown last is not yet the shape itself."""
        return self._difference is not None

    def forget(self) -> None:
        """Show the next shape as it is."""
        self._seen = self._difference = None

    def begin(self, positions: np.ndarray, now: float) -> None:
        """Begin at a time in seconds to take the way to positions (n,3)."""
        if self._seen is not None and self._seen.shape == positions.shape:
            self._difference, self._began = self._seen - positions, now

    def shown(self, positions: np.ndarray, now: float) -> np.ndarray:
        """Return what to show of positions (n,3) at a time in seconds: in the end, themselves."""
        left = max(1.0 - (now - self._began) / SECONDS, 0.0)
        if self._difference is not None and left and self._difference.shape == positions.shape:
            positions = positions + left * left * self._difference
        else:
            self._difference = None
        self._seen = positions
        return positions
