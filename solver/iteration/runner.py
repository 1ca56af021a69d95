# SPDX-License-Identifier: GPL-3.0-or-later
"""A run from the first iteration to the last, phase by phase."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from copy import copy
from functools import partial
from typing import Any, TypeAlias

from numpy.typing import ArrayLike

from ..aliases import FloatArray
from ..coarse_to_fine.start import (
    MAX_ITERATIONS,
    TOLERANCE,
    coarse_stylization,
    preview_on_fine,
    prolongate,
)
from ..contacts.keep_apart import KeepApart
from ..errors import CubicCraftError
from ..hardening.hard_stylization import HardStylization
from ..hardening.hardening import GIVEN_BACK, ROUNDS, is_hardened
from ..inputs import instance, real_number, switch, whole_number
from .from_below import FromBelow
from .result import Energy, Reason, Result
from .stop_rule import StopRule
from .stylization import Stylization

OnIteration: TypeAlias = Callable[[Stylization], object]

OF_ROUND = 8
LEAST_ROUND = 10
"""A round of Keep Apart has at most one in `OF_ROUND` of the iterations before it, or this many if
that is less: what it changes lies near what crosses, and settles soon. Never more than those."""
TRIES = 3
"""in a row to leave soft what crosses, of which none helps"""
CRISP = 0.95
"""of the crisp area have to be left by that, or parts may press into each other"""


class Run:
    """A run that is advanced phase by phase, so that the caller can do other work in between.

    However it is sliced, the result is identical to that of `run`, bit for bit.
    The arguments are those of `run`. `reason` is None while it is not finished, then as in
    `Result`; `seconds` is the time of the iterations so far.

    Raises
    ------
    CubicCraftError
        The tolerance is not positive, or max_iterations is no whole number from 1.

    Examples
    --------
    >>> import numpy as np
    >>> from solver import Run, Setup, SolverOptions, Stylization, ball, rest_mesh
    >>> V, F = ball()
    >>> options = SolverOptions(keep_rotation=True, device="numpy")
    >>> run = Run(Stylization(Setup(rest_mesh(V, F)), 0.6, options=options))
    >>> for _ in range(4):
    ...     run.advance()  # a local or a global step
    >>> round(float(np.linalg.norm(run.positions() - V, axis=1).max()), 2)  # on its way
    0.18
    >>> while run.reason is None:
    ...     run.advance()
    >>> round(float(np.linalg.norm(run.positions() - V, axis=1).max()), 2)
    0.26
    """

    def __init__(
        self,
        stylization: Stylization,
        max_iterations: int = 1000,
        tolerance: float = 1e-3,
        keep_apart: bool = True,
        harden: bool = True,
    ):
        instance(stylization, "stylization", Stylization)
        tolerance = real_number(tolerance, "tolerance")
        if not (math.isfinite(tolerance) and tolerance > 0.0):
            raise CubicCraftError(f"tolerance must be finite and positive, not {tolerance}")
        max_iterations = whole_number(max_iterations, "max_iterations", 1)
        self.stylization = stylization
        self.reason: Reason | None = None
        self._last = max_iterations
        self._tolerance = tolerance
        self._rule = self._new_rule()
        # not a bound method: a run would hold itself, and its memory, until cycles are looked for
        self._phase: Callable[[Any], None] = Run._local_step
        self.seconds = 0.0
        self._coarse_iterations = 0
        coarse = coarse_stylization(stylization)
        self._coarse = None if coarse is None else Run(coarse, MAX_ITERATIONS, TOLERANCE)
        self._coarse_energy: Energy | None = None
        # a run on a coarser mesh rises itself
        self._below = FromBelow(stylization, max_iterations if coarse is None else 0)
        if not self._below.is_done:
            self._phase = Run._rise
        rest = stylization.rest
        is_kept = switch(keep_apart, "keep_apart") and not stylization.is_coarse
        is_kept = is_kept and rest.options.keep_apart
        self._apart = KeepApart(rest) if is_kept else None
        self._end: Reason = "converged"
        self._round = 0
        self._soft: Stylization | None = None
        self._hard_end: tuple[HardStylization, KeepApart | None] | None = None
        self._is_hardened_itself = switch(harden, "harden")

    @property
    def is_on_coarser_mesh(self) -> bool:
        """Whether the run has not yet reached the mesh itself."""
        return self._coarse is not None

    @property
    def keeps_apart(self) -> bool:
        """Whether it looks, after the iterations, for what has come to cross."""
        return self._apart is not None

    @property
    def is_keeping_apart(self) -> bool:
        """Whether the iterations have ended, and what crosses is looked for and drawn apart."""
        return self._round > 0

    @property
    def soft(self) -> Stylization:
        """The Stylization of the soft shape: at its end, once the sides become flat."""
        return self._soft or self.stylization

    @property
    def hard(self) -> HardStylization | None:
        """The Stylization whose sides become flat; None before."""
        return self.stylization if isinstance(self.stylization, HardStylization) else None

    @property
    def _present_hard(self) -> HardStylization:
        assert isinstance(self.stylization, HardStylization)
        return self.stylization

    @property
    def iterations(self) -> int:
        """Number of iterations done, including those on coarser meshes, up to the soft shape."""
        coarse = self._coarse_iterations if self._coarse is None else self._coarse.iterations
        return coarse + self.soft.iterations

    @property
    def steps(self) -> int:
        """Number of all global steps, those after the soft shape included."""
        return self.iterations - self.soft.iterations + self.stylization.iterations

    @property
    def energy(self) -> Energy | None:
        """The energy of the last iteration, which may be one on a coarser mesh; None before it."""
        if self._coarse is not None:
            return self._coarse.energy
        return self.soft.energy or self._coarse_energy

    def advance(self) -> None:
        """Do one phase: a local or a global step. The last one sets `reason`."""
        begin = time.perf_counter()
        if self._coarse is not None:
            self._coarse.advance()
            if self._coarse.reason is not None:
                self._leave(self._coarse)
        else:
            self._phase(self)
        self.seconds += time.perf_counter() - begin

    def _leave(self, coarse: Run) -> None:
        """Begin on the mesh itself, from where the coarser one is."""
        if coarse._coarse is not None:
            coarse._leave(coarse._coarse)
        prolongate(coarse.stylization, self.stylization)
        self._coarse_iterations, self._coarse_energy = coarse.iterations, coarse.energy
        self._coarse = None

    def _new_rule(self) -> StopRule:
        state = self.stylization
        topology = state.rest.topology
        has_linked_parts = bool(topology.part.max() >= topology.component_count)
        may_swing = not state.is_coarse and has_linked_parts
        return StopRule(self._tolerance, state.resolution, may_swing)

    def _local_step(self):
        self.stylization.local_step()
        self._phase = Run._global_step

    def _global_step(self):
        state = self.stylization
        state.global_step()
        self._phase = Run._local_step
        assert state.energy is not None  # the local step has set it
        is_converged = self._rule.is_converged(
            state.energy.total, state.displacement, state.distance
        )
        if not self._below.is_done:
            if self._below.is_over(state.iterations, is_converged):
                self._phase = Run._rise
        elif is_converged:
            self._ended("converged")
        elif state.iterations >= self._last:
            self._ended("max_iterations")

    def _rise(self) -> None:
        self._below.rise(self.stylization)  # to a higher cubeness, see `from_below.py`
        self._rule = self._new_rule()
        self._phase = Run._local_step

    def _ended(self, reason: Reason) -> None:
        if self._apart is None:
            self._end = reason
            self._phase = Run._harden_or_end
            self._phase(self)
            return
        if not self._round:
            done = self.stylization.iterations
            self._end, self._round = reason, min(max(done // OF_ROUND, LEAST_ROUND), done)
        self._phase = partial(Run._check, apart=self._apart)

    def _check(self, apart: KeepApart) -> None:
        needs_round = apart.check(self.stylization)
        self._phase = partial(Run._renew if needs_round else Run._finish, apart=apart)

    def _renew(self, apart: KeepApart) -> None:
        renewed = apart.renewed(self.stylization)
        if renewed is None:
            self._phase = partial(Run._finish, apart=apart)
            return
        self.stylization = renewed
        self._rule = self._new_rule()
        self._last = self.stylization.iterations + self._round
        self._phase = Run._local_step

    def _finish(self, apart: KeepApart) -> None:
        self.stylization = apart.finish(self.stylization)
        self._harden_or_end()

    def _harden_or_end(self) -> None:
        state = self.stylization
        is_soft = self._soft is None and not state.is_coarse and self._is_hardened_itself
        if is_soft and is_hardened(state):
            self._phase = Run.harden
        else:
            self._conclude()

    def harden(self, before: FloatArray | None = None) -> None:
        """Make the sides of the soft shape flat; `before` as of `HardStylization`.

        A Run does so itself, but for one of a `FrameSequence`, which goes on when it is told to.
        """
        self.reason, self._soft = None, self.stylization
        self._soft.finish()
        self.stylization = HardStylization(self._soft, before)
        self._phase = Run._hard_local_step

    def _hard_local_step(self) -> None:
        self.stylization.local_step()
        self._phase = Run._hard_global_step

    def _hard_global_step(self) -> None:
        hard = self._present_hard
        hard.global_step()
        self._phase = Run._hard_local_step
        done = hard.iterations - self.soft.iterations
        if done in GIVEN_BACK:
            hard.give_back_volume()
        if done < ROUNDS:
            return
        hard.straighten_borders()
        self._begin_at_hard_end(hard, self._apart)

    def _begin_at_hard_end(self, hard: HardStylization, soft_apart: KeepApart | None) -> None:
        self._hard_end = hard, soft_apart
        self.stylization, self._apart = self._hard_end
        if soft_apart is None:
            self.reason = self._end
        else:
            self._phase = partial(Run._part, apart=copy(soft_apart))

    def _part(self, apart: KeepApart) -> None:
        """Push apart what has come to cross: to be left soft, it takes what is around it along.

        Parts that cross at rest may cross elsewhere as their sides become flat, but for those of
        which more comes to light.
        """
        hard = self._present_hard
        crossing, parts = apart.look(hard), apart.parts_found
        if len(parts):
            hard.straighten_borders(apart=parts)
            crossing = apart.look(hard)
        if len(crossing):
            self.stylization = hard.moved_to(apart.parted(hard))
        soften = partial(Run._soften, last=apart, is_between_parts=apart.is_between_parts)
        self._phase = soften

    def _soften(
        self, last: KeepApart, is_between_parts: bool, fewest: float = math.inf, tries: int = 0
    ) -> None:
        """Leave soft what still crosses, again and again while that helps.

        What is soft may cross what is still crisp beside it: a try that does not help is followed
        by others. Where it takes too much of the crispness, parts may press into each other.
        """
        looked, hard = copy(last), self._present_hard
        assert self._hard_end is not None
        crossing, tries = looked.look(hard), tries + 1
        if len(crossing) < fewest:
            self._apart, self._before = looked, hard
            fewest, tries = len(crossing), 0
        if len(crossing) and tries < TRIES:
            self.stylization = hard.softened(crossing)
            again = {"is_between_parts": is_between_parts, "fewest": fewest, "tries": tries}
            self._phase = partial(Run._soften, last=looked, **again)
            return
        end, apart = self._hard_end
        if is_between_parts and self._before.crisp_area < CRISP * end.crisp_area:
            assert apart is not None
            self.stylization = end
            self._phase = partial(Run._part, apart=apart.pressing())
            return
        self.stylization = self._before
        self._conclude()

    def _conclude(self) -> None:
        self.reason = self._end
        if self._apart is not None:
            self.stylization = self._apart.conclude(self.stylization)

    def with_crispness(self, crispness: ArrayLike) -> Run | None:
        """Return a Run with another crispness, as of a `Style`, that has only its end to find.

        It comes to the same end as a new one. None if this one has not come so far, or if sides
        would be flat where they are not.
        """
        if self._hard_end is None:
            return None
        hard = self._hard_end[0].with_crispness(crispness)
        if hard is None:
            return None
        other = copy(self)
        other.reason, other.seconds = None, 0.0
        other._begin_at_hard_end(hard, self._hard_end[1])
        return other

    def complete(self, on_iteration: OnIteration | None = None) -> None:
        """Advance to the end; `on_iteration` as in `run`."""
        while self.reason is None:
            state = self._advanced
            before = state.iterations
            self.advance()
            if on_iteration and state.iterations > before and on_iteration(state):
                self.reason = self.reason or "cancelled"

    @property
    def _advanced(self) -> Stylization:
        """The Stylization that the next phase is of, maybe on a coarser mesh."""
        return self.stylization if self._coarse is None else self._coarse._advanced

    def positions(self) -> FloatArray:
        """Return the current positions (n,3), in the units of the input.

        While the run is on a coarser mesh, they follow its vertices, with the details at rest.
        """
        if self._coarse is None:
            return self.stylization.placed_positions()  # rotations of a hard shape take long
        return self.stylization.placed_positions(self._current()[1])

    def placed(self) -> tuple[FloatArray, FloatArray]:
        """Return the current positions (n,3) and rotations (n,3,3)."""
        return self.stylization.placed(*self._current())

    def _current(self):
        """Return the current rotations and the positions in the unit box."""
        if self._coarse is None:
            return self.stylization.current()
        positions, R = self._coarse.placed()
        return preview_on_fine(positions, R, self.stylization.rest)

    def result(self) -> Result:
        """Return the Result so far; the iteration cannot be continued afterwards."""
        begin = time.perf_counter()
        if self._coarse is not None:  # cancelled
            self._leave(self._coarse)
        if self.stylization.is_limited:
            self.stylization.limit_cubeness(math.inf)
        energy = self._soft.energy if self._soft is not None else self.stylization.finish()
        self.seconds += time.perf_counter() - begin
        return self._result(energy)

    def so_far(self) -> Result | None:
        """Return the current shape as a Result, None before the first iteration.

        The run goes on as if nobody had asked.
        """
        energy = self.energy
        return None if energy is None else self._result(energy)

    def _result(self, energy):
        begin = time.perf_counter()
        positions, rotations = self.placed()
        seconds = self.seconds + time.perf_counter() - begin
        apart, reason = self._apart, self.reason or "cancelled"
        found = None, None, None
        if apart is not None and reason != "cancelled":
            found = apart.crossings, apart.pressed, apart.vertices
        soft = self.soft.iterations, reason, self.soft.device, self.soft.compile_seconds
        return Result(positions, rotations, energy, *soft, seconds, *found)
