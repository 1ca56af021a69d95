# SPDX-License-Identifier: GPL-3.0-or-later
"""A crisp shape that goes on with another cubeness: what is seen while that is dragged.

A new run is crisp only at its end. Here the soft shape goes on from where it is, and after each of
its steps the hard one takes a step, beside it, with the sides that it has. Where a new run would
have others, or end in another minimum, its end is only near that of this one.
"""

from __future__ import annotations

from .hardening.hardening import ROUNDS
from .hardening.sides import NO_SIDE
from .runner import Run
from .styles.style import Style


def has_sides(run: Run) -> bool:
    """Return whether a run has come to a shape with sides, which a `RestyledRun` can keep."""
    is_begun = isinstance(run, RestyledRun) or run.reason is not None
    hard = run.hard
    return is_begun and hard is not None and bool((hard.hardening.side != NO_SIDE).any())


class RestyledRun(Run):
    """A Run that goes on from the end of another, or from anywhere in one of its own kind.

    That one cannot be continued afterwards.

    Parameters
    ----------
    run : Run
        Of `has_sides`.
    style : Style
        With another cubeness or crispness.
    """

    def __init__(self, run: Run, style: Style):
        self.__dict__.update(run.__dict__)
        self.reason, self._seconds, self._apart, self._hard_end = None, 0.0, None, None
        self._soft, self._coarse_iterations = run.soft.restyled(style), 0
        self.stylization = run.stylization.restyled(style)
        self._soft.iterations = self.stylization.iterations = self._round = 0
        self._phase = RestyledRun._soft_local_step

    @property
    def steps(self) -> int:
        """Number of steps of the hard shape."""
        return self.stylization.iterations

    def _soft_local_step(self):
        self.soft.local_step()
        self._phase = RestyledRun._soft_global_step

    def _soft_global_step(self):
        self.soft.global_step()
        self._phase = RestyledRun._follow

    def _follow(self):
        hard = self.hard
        assert hard is not None
        hard.follow(self.soft)
        hard.local_step()
        self._phase = RestyledRun._hard_step

    def _hard_step(self):
        self.stylization.global_step()
        self._phase = RestyledRun._soft_local_step
        if self.soft.iterations == ROUNDS:
            self.reason = "max_iterations"
