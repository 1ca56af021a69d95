# SPDX-License-Identifier: GPL-3.0-or-later
"""A crisp shape that goes on with other settings: what is seen while one of them is dragged.

A new run is crisp only at its end. Here the soft shape goes on from where it is, and after each of
its steps the hard one takes a step, beside it, with the sides that it has. But for another cubeness
or crispness, they are found anew now and then, which takes as long as several steps: soon if the
run before has not come to it. Where a new run would have others, or end in another minimum, its end
is only near that of this one.
"""

from __future__ import annotations

from ..hardening.hardening import ROUNDS, Hardening
from ..hardening.sides import NO_SIDE
from .runner import Run
from .setup import Setup
from .stylization import Stylization

SOON, LATER, LAST = 1, 3, 8
"""steps of the soft shape after which sides are found anew: one of the first, and the last"""


def has_sides(run: Run) -> bool:
    """Return whether a run has come to a shape with sides, which a `RestyledRun` can go on from."""
    is_begun = isinstance(run, RestyledRun) or run.reason is not None
    hard = run.hard
    return is_begun and hard is not None and bool((hard.hardening.side != NO_SIDE).any())


class RestyledRun(Run):
    """A Run that goes on from the end of another, or from anywhere in one of its own kind.

    That one cannot be continued afterwards.

    `run`: of `has_sides`. `soft`: with other settings, at the soft shape of that run.
    `keeps_sides`: whether only the cubeness or the crispness is another.
    """

    def __init__(self, run: Run, soft: Stylization, *, keeps_sides: bool):
        hard = run._present_hard
        self.__dict__.update(run.__dict__)
        self.reason, self.seconds, self._apart, self._hard_end = None, 0.0, None, None
        held = run._held if isinstance(run, RestyledRun) else hard.setup
        self._held: Setup | None = held if soft.setup is run.soft.setup else None
        self._soft, self._coarse_iterations = soft, 0
        self.stylization = hard.beside(soft)
        is_late = isinstance(run, RestyledRun) and run._is_to_find
        self._is_to_find = is_late or not keeps_sides
        self._findings = (SOON if is_late else LATER, LAST) if self._is_to_find else ()
        self._found: Hardening | None = None
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
        soft = self.soft
        soft.global_step()
        is_due = soft.iterations in self._findings
        self._phase = RestyledRun._find_sides if is_due else RestyledRun._follow

    def _find_sides(self):
        self._found = self._present_hard.found_anew(self.soft)
        self._phase = RestyledRun._take_sides if self._held else RestyledRun._hold

    def _hold(self):
        assert self._found is not None
        self._held = self.soft.setup.held(self._found.target.hold)
        self._phase = RestyledRun._take_sides

    def _take_sides(self):
        assert self._found is not None and self._held is not None
        self.stylization = self._present_hard.go_on_with(self.soft, self._found, self._held)
        self._is_to_find = False
        self._phase = RestyledRun._hard_step  # its rotations fit

    def _follow(self):
        hard = self._present_hard
        hard.follow(self.soft)
        hard.local_step()
        self._phase = RestyledRun._hard_step

    def _hard_step(self):
        hard = self._present_hard
        hard.global_step()
        if self._found is not None:
            hard.straighten_borders(may_cross=True)
            self._found = None
        self._phase = RestyledRun._soft_local_step
        if self.soft.iterations == ROUNDS:
            self.reason = "max_iterations"
