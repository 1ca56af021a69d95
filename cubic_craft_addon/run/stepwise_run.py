# SPDX-License-Identifier: GPL-3.0-or-later
"""The run of an assembly, phase by phase, as in Live and Cubify."""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import time
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ... import solver
from ..read.member import Member
from ..regions.region import Region
from ..settings.values import Settings
from . import pipeline
from .countdown import Countdown
from .pipeline import MemberProblem
from .tasks import Task, key_of, prepare_all

_STRENGTHS = ("cubeness", "crispness")  # with another, a shape keeps its sides for a while
_FIRST_SHOWN = 2  # iterations; the first one moves only handles


class StepwiseRun:
    """The run of an assembly, which can be restarted.

    It keeps no reference to Blender's data, which undo frees: the tasks are passed again to
    each call.

    `problems`: reasons why there is no run, or why objects are excluded, for display.
    """

    def __init__(self):
        self.problems: list[str] = []
        self.problem: MemberProblem | None = None
        self._posed: MemberProblem | None = None
        self._is_held = self._is_behind = False
        self._seen: tuple[MemberProblem | None, solver.Run | None] | None = None
        self._starts = 0
        self._solutions: dict[int, pipeline.Solution] | None = None
        self._run: solver.Run | None = None
        self._behind: solver.Run | None = None
        self._is_restyled = self._has_replaced = False
        self._key = None
        self._intermediate_moment = None
        self._intermediate = {}
        self._so_far: tuple[Any, dict[int, pipeline.Solution]] | None = None

    # -- settings ----------------------------------------------------------------------------------

    @property
    def is_asked_for(self):
        """Whether it has tasks, even if they could not be started."""
        return self._key is not None

    def is_changed(self, tasks: Sequence[Task]) -> bool:
        """Return whether the tasks differ from the current run."""
        return key_of(tasks) != self._key

    def restart(
        self, tasks: Sequence[Task], known: Mapping[int, Member], earlier: Sequence[MemberProblem]
    ) -> None:
        """Start from the original shapes; `known` and `earlier` as for `tasks.prepare_all`."""
        key = key_of(tasks)
        before = self._run_to_go_on
        is_same = _without(key, "crispness") == _without(self._key, "crispness")
        is_like = _without(key, *_STRENGTHS) == _without(self._key, *_STRENGTHS)
        known_problem = self.problem
        self.stop()
        self._key = key
        problem, self.problems = prepare_all(tasks, known, earlier)
        if problem is not None:
            self.problem = problem
            is_like &= known_problem is not None and problem.setup is known_problem.setup
            self._start(before, known_problem, is_same=is_same and is_like, keeps_sides=is_like)

    def restart_if_painted(self, tasks: Sequence[Task]) -> bool:
        """Restart if weights of relevant vertex groups have changed; return whether they have."""
        before = self.problem
        if before is None or not any(_looks_at_weights(task) for task in tasks):
            return False
        members = {member.uid: member for member in before.pieces}
        now, problems = prepare_all(tasks, members, [before], weights_changed=True)
        if now is None:
            self._reset(problems)
            return True
        is_like = len(now.pieces) == len(before.pieces)
        if is_like and all(map(_has_weights_of, now.pieces, before.pieces)):
            return False
        is_like = is_like and now.setup is before.setup
        is_like = is_like and all(map(_has_other_weights_of, now.pieces, before.pieces))
        run = self._run_to_go_on
        self._reset(problems)
        self.problem = now
        self._start(run, before, keeps_sides=is_like)
        return True

    # -- objects that the artist works on meanwhile -----------------------------------------------

    def hold(self) -> None:
        """Stop, as a shape has changed; what it has computed so far can still be shown."""
        self._is_held = True

    def follow(self, originals: Mapping[int, np.ndarray]) -> bool:
        """Go on from what is seen, with other positions (n,3) of its vertices, by ``session_uid``.

        Nothing is factorized anew, so the end is only near that of Cubify; see `renew`. False if
        this is not possible: the run has hardly begun, or the weights have changed too much.
        """
        problem, run = self._seen or (self.problem, self._run)
        if problem is None or run is None or run.is_on_coarser_mesh:
            return False
        members = []
        for member in problem.pieces:
            original = originals.get(member.uid, member.shape.original)
            if member.is_symmetric_by_itself and not member.whole.suits(original):
                return False
            members.append(replace(member, shape=replace(member.shape, original=original)))
        if not problem.suits(members):
            return False
        posed = problem.posed(members)
        if not problem.setup.serves(posed.setup):
            return False
        try:
            run = pipeline.go_on(posed, run)
        except solver.CubicCraftError as error:
            self.problems = [f"{problem.name}: {error}"]
            return False
        self._reset(self.problems)
        self.problem, self._posed, self._run = problem, posed, run
        self._starts += 1
        return True

    def renew(self, tasks: Sequence[Task], known: Mapping[int, Member]) -> None:
        """Read the objects again, and solve them behind what is shown, which the end replaces.

        If nothing has changed, it goes on as before; `known` as for `tasks.prepare_all`.
        """
        before, was_followed = self.problem, self._posed is not None
        now, problems = prepare_all(tasks, known, [before] if before else [])
        self._is_held = False
        is_same = before is not None and now is not None and _has_members_of(now, before)
        if is_same and not was_followed and self._run is not None and not self.is_changed(tasks):
            return
        is_like = before is not None and now is not None and _has_vertices_of(now, before)
        seen = self._seen or (before, self._run)
        self._reset(problems)
        self._key, self.problem = key_of(tasks), now
        if now is not None:
            self._start()
            self._is_behind, self._seen = is_like, seen if is_like else None

    @property
    def _run_to_go_on(self):
        """The run that another one may go on from, None if that is not of the problem."""
        return None if self._is_held or self._posed is not None else self._run

    def _start(
        self,
        run: solver.Run | None = None,
        before: MemberProblem | None = None,
        *,
        is_same: bool = False,
        keeps_sides: bool = False,
    ):
        """Start a run.

        With another crispness only, find the end of the `run` of the problem `before`. Else go on
        from there first, so that a shape that was crisp is while a setting is dragged.
        """
        assert self.problem is not None
        self._starts += 1
        try:
            if run is not None and is_same:
                self._run = run.with_crispness(self.problem.style.crispness)
            if self._run is None and run is not None and before is not None:
                self._run = pipeline.restyled(self.problem, before, run, keeps_sides=keeps_sides)
                self._is_restyled = self._run is not None
            self._run = self._run or pipeline.start(self.problem)
            self._begin_to_count(self._run)
        except solver.CubicCraftError as error:
            self.problems = [*self.problems, str(error)]

    def _begin_to_count(self, run):
        assert self.problem is not None
        settings = pipeline.settings_of_all(self.problem)
        self._progress = solver.Progress(settings.max_iterations, settings.tolerance)
        self._countdown = Countdown(keeps_apart=run.keeps_apart)

    def stop(self) -> None:
        """Stop, without tasks and problems."""
        self._reset([])
        self._key = None

    def _reset(self, problems):
        self.problems, self._solutions, self._run = problems, None, None
        self._behind, self._is_restyled, self._has_replaced = None, False, False
        self._posed, self._is_held, self._is_behind, self._seen = None, False, False, None
        self._intermediate_moment, self._intermediate, self._so_far = None, {}, None

    def forget(self) -> None:
        """Release all arrays."""
        self.stop()
        self.problem = None

    def member_of(self, uid: int) -> Member | None:
        """Return the data read from an object, None if it does not take part."""
        members = self.problem.pieces if self.problem else ()
        return next((member for member in members if member.uid == uid), None)

    # -- work --------------------------------------------------------------------------------------

    @property
    def is_working(self):
        """Whether there is more to compute."""
        if self._run is None or self._is_held:
            return False
        return self._run.reason is None if self._posed else self._solutions is None

    @property
    def is_started(self):
        """Whether there is a run."""
        return self._run is not None

    @property
    def is_done(self):
        """Whether the run has come to its end."""
        return self._solutions is not None

    def advance(self) -> None:
        """Do one phase of the solver. If it cannot continue, `problems` has the reason."""
        assert self._run is not None and self.problem is not None
        try:
            if self._run.reason is None:
                self._run.advance()
            elif self._is_restyled:
                self._advance_behind()
            else:
                solutions = pipeline.solutions_of(self.problem, self._run.result())
                uids = [member.uid for member in self.problem.pieces]
                self._solutions, self._seen = dict(zip(uids, solutions, strict=True)), None
        except solver.CubicCraftError as error:
            self._reset([f"{self.problem.name}: {error}"])

    def _advance_behind(self):
        """Advance the run that Cubify would do; its end replaces what is seen."""
        assert self.problem is not None
        if self._behind is None:
            self._behind = pipeline.start(self.problem)
            self._begin_to_count(self._behind)
        else:
            self._behind.advance()
            if self._behind.reason is not None:
                self._run, self._behind = self._behind, None
                self._is_restyled, self._has_replaced = False, True

    @property
    def iterations(self):
        """Number of iterations done."""
        return self._run.stylization.iterations if self._run else 0

    @property
    def status(self):
        """Status lines, from long to short, and the fraction done, from 0 to 1."""
        energy = self._run.stylization.energy if self._run else None
        if self._run is None or energy is None:
            is_coarse = self._run is not None and self._run.is_on_coarser_mesh
            return (("First on a coarser mesh", "Coarser mesh") if is_coarse else ("",)), 0.0
        if self._posed or self._is_held or (self._is_behind and not self.is_done):
            progress = self._progress.update(self._run.stylization) if self._is_behind else 0.0
            return ("Following the original", "Following"), progress
        if self._solutions is None:
            run = self._behind or self._run
            return self._countdown.tell(
                self._progress.update(run.stylization),
                time.perf_counter(),
                is_keeping_apart=run.is_keeping_apart,
            )
        solution = next(iter(self._solutions.values()))
        return ("Converged" if solution.result.converged else "Not converged",), 1.0

    @property
    def numbers(self):
        """The iteration and the energy as a text, empty before the first."""
        energy = self._run.stylization.energy if self._run else None
        if energy is None:
            return ""
        return f"Iteration {self.iterations}, energy {max(energy.total, 0.0):.5f}"

    # -- current state ---------------------------------------------------------------------------

    def solution_of(self, uid: int) -> pipeline.Solution | None:
        """Return the result for an object, once the run has ended."""
        return self._solutions.get(uid) if self._solutions else None

    def solution_so_far(self, uid: int) -> pipeline.Solution | None:
        """Return what can be shown of an object as a result, None if there is nothing yet."""
        if self._solutions is not None:
            return self._solutions.get(uid)
        if self._state is None:
            return None
        assert self._run is not None and self.problem is not None
        if self._so_far is None or self._so_far[0] != self._state:
            result = self._run.so_far()  # None before the first iteration
            found = result and pipeline.solutions_of(self._posed or self.problem, result)
            uids = [member.uid for member in self.problem.pieces]
            self._so_far = self._state, dict(zip(uids, found or (), strict=False))
        return self._so_far[1].get(uid)

    @property
    def outcome(self):
        """The numbers of a `LastRun`, as values for JSON, while there is something to show."""
        assert self._run is not None and self.problem is not None
        energy = self._run.energy
        return {
            "vertices": int(self.problem.vertices),
            "objects": len(self.problem.pieces),
            "iterations": int(self._run.iterations),
            "energy": 0.0 if energy is None else max(float(energy.total), 0.0),
            "converged": self._run.reason == "converged",
            "seconds": float(self.problem.seconds + self._run.seconds),
            "device": self._run.stylization.device,
        }

    @property
    def moment(self):
        """Identifier of the state that can be shown, None if there is none."""
        return None if self._is_behind and not self.is_done else self._state

    @property
    def has_replaced(self):
        """Whether the end of another run has taken the place of what was shown."""
        return self._has_replaced or self._is_behind

    @property
    def _state(self):
        if self._run is None:
            return None
        is_new = self._run.steps > 0 if self._is_restyled else self._run.iterations >= _FIRST_SHOWN
        if not (is_new or self.is_done):
            return None  # keep the visible shape until there is a better one
        return self._starts, self._run.steps, self.is_done

    def intermediate_result(self, uid: int, with_rotations: bool):
        """Return current positions and rotations of an object, None if it does not take part.

        The rotations take time, and may be None unless requested.
        """
        assert self._run is not None and self.problem is not None
        if self._solutions is not None:
            solution = self._solutions.get(uid)
            return solution and (solution.positions, solution.rotations)
        moment = (self.moment, with_rotations)
        if moment != self._intermediate_moment:
            problem = self._posed or self.problem
            placed = self._run.placed() if with_rotations else (self._run.positions(), None)
            found = pipeline.read_back(problem, *placed)
            members = self.problem.pieces
            self._intermediate = {m.uid: pair for m, pair in zip(members, found, strict=True)}
            self._intermediate_moment = moment
        return self._intermediate.get(uid)


def _without(key, *names):
    """Return a key in which such numbers of the settings, and of regions, are 0."""
    if isinstance(key, tuple):
        return tuple(_without(part, *names) for part in key)
    if not isinstance(key, Settings | Region):
        return key
    values: dict[str, Any] = {name: 0.0 for name in names if hasattr(key, name)}
    if isinstance(key, Settings):
        values["regions"] = _without(key.regions, *names)
    return replace(key, **values)


def _looks_at_weights(task):
    return bool(
        task.settings.map_group
        or task.settings.detail_group
        or task.settings.handles
        or task.settings.regions
        or task.bones
    )


def _has_members_of(now, before):
    return _has_vertices_of(now, before) and all(
        one.shape.is_like(two.shape) and _has_weights_of(one, two)
        for one, two in zip(now.pieces, before.pieces, strict=True)
    )


def _has_vertices_of(now, before):
    counts = [[(m.uid, m.vertices) for m in problem.pieces] for problem in (now, before)]
    return counts[0] == counts[1]


def _has_weights_of(now, before):
    is_like = np.array_equal(now.map_weights, before.map_weights)
    return is_like and _has_other_weights_of(now, before)


def _has_other_weights_of(now, before):
    """Return whether at most the cubeness map differs, which is a strength."""
    is_like = now.bones.is_like(before.bones) if now.bones else before.bones is None
    return is_like and all(
        np.array_equal(getattr(now, name), getattr(before, name))
        for name in ("detail_weights", "region_shares", "handle_of")
    )
