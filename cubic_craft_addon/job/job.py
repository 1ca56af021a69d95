# SPDX-License-Identifier: GPL-3.0-or-later
"""The work of one Cubify, step by step.

Invariant: all objects are solved before the first is written, so that it can be cancelled between
any two steps without changing anything.
"""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import contextlib
import logging
from collections.abc import Generator, Iterator, Sequence
from dataclasses import dataclass

import bpy

from ...solver import CubicCraftError
from .. import mesh_bridge
from ..environment.modes import MODES
from ..handles.pose import rebase_edited_handles
from ..read.member import ShapeRead, assemblies, read_shape
from ..run.failures import UNEXPECTED
from ..run.posed_anew import is_posed_anew
from ..run.stepwise_run import StepwiseRun
from ..run.tasks import Task, plan, write_all
from ..settings.overrides import SettingsOverrides
from ..settings.rollback import settings_kept, settings_untouched

_log = logging.getLogger(__name__)

_LONG_SETUP = 15_000  # vertices; larger meshes take noticeable time to factorize


@dataclass(frozen=True)
class Step:
    """How far a job has come."""

    texts: tuple[str, ...]
    """what it is doing, to be displayed; from long to short"""
    factor: float
    """the fraction done, from 0 to 1"""
    is_long: bool = False
    """whether the next step takes long and cannot be interrupted"""


class Job:
    """Objects to be cubified, as they are now.

    `objects`: the active one first.
    """

    cancel_text = "Cancel Cubify"

    def __init__(self, overrides: SettingsOverrides, objects: list[bpy.types.Object]):
        self._overrides = overrides
        self._problems: list[str] = []
        self._made: list[tuple[bpy.types.Object, bpy.types.Object]] = []
        try:
            self._plan(self._make_seen(objects) if overrides.is_of_what_is_seen else objects)
        except BaseException:
            self.discard()
            raise
        self._groups = assemblies(self._tasks)
        self._joined = {t.uid for group in self._groups if len(group) > 1 for t in group}
        self._shapes: dict[int, ShapeRead] = {}

    def _make_seen(self, sources: list[bpy.types.Object]) -> list[bpy.types.Object]:
        """Return new objects made from the visible meshes of others, and the problems."""
        for source in sources:
            try:
                self._made.append((mesh_bridge.make_seen(source), source))
            except CubicCraftError as error:
                self._problems.append(str(error))
        return [new for new, _ in self._made]

    def _plan(self, objects: list[bpy.types.Object]) -> None:
        meshes = [obj for obj in objects if isinstance(obj.data, bpy.types.Mesh)]
        with settings_untouched(_meshes(meshes)):
            rebase_edited_handles(meshes, self._overrides.start_of)
            self._tasks, problems = plan(self._overrides, objects)
        self._problems += problems + [text for task in self._tasks for text in _warnings(task)]
        sources = {new.session_uid: source for new, source in self._made}
        for task in self._tasks:
            task.source = sources.get(task.uid)
            task.is_seen = task.source is not None

    def stop(self) -> bool:
        """Return False: nothing is done before all is."""
        return False

    def discard(self) -> None:
        """Remove objects that were made but not written."""
        for new, _ in self._made:
            try:
                is_written = bool(new.users_scene)
            except ReferenceError:
                continue
            if not is_written:
                mesh_bridge.remove_copy(new)
        self._made.clear()

    def steps(self) -> Generator[Step]:
        """Solve all; each turn does a phase of the solver."""
        count = len(self._groups)
        for number, group in enumerate(self._groups):
            which = f"{number + 1} of {count}: " if count > 1 else ""
            twin = next((other for other in self._tasks if _is_twin(other, group)), None)
            if twin is not None:
                group[0].solution = twin.solution
                if twin.uid in self._shapes:
                    self._shapes[group[0].uid] = self._shapes[twin.uid]
                continue
            for step in self._solve(group):
                texts = tuple(which + text for text in step.texts)
                yield Step(texts, (number + step.factor) / count, step.is_long)

    def _solve(self, group: Sequence[Task]) -> Generator[Step]:
        preparing = f"Preparing {_name(group)}", "Preparing"
        is_large = sum(len(task.mesh.vertices) for task in group) > _LONG_SETUP
        yield Step(preparing, 0.0, is_long=is_large)
        run = StepwiseRun()
        run.restart(group, {}, [])
        while run.is_working:
            texts, factor = run.status
            yield Step(texts if any(texts) else preparing, factor)
            run.advance()
        self._problems += run.problems
        for task in group:
            task.solution = run.solution_of(task.uid)
            member = run.member_of(task.uid)
            if member is not None:
                self._shapes[task.uid] = member.shape
        run.forget()

    @property
    def obstacle(self) -> str:
        """Why it cannot continue after other code has run; or empty."""
        for task in self._tasks:
            try:
                if task.is_seen:
                    task.obj.name  # noqa: B018 - raises where Blender has removed it
                elif task.obj.data != task.mesh or not task.obj.users_scene:
                    return "an object was deleted or assigned another mesh"
                if task.obj.mode not in MODES:
                    return f'"{task.obj.name}" is being edited'
            except ReferenceError:
                return "an object was deleted"
        return ""

    def write(self, *, is_alone: bool) -> tuple[str, list[str]]:
        """Write what was solved.

        `is_alone`: no other code has run since the job was made. Returns `summary`: str;
        `problems`: list of str. Raises CubicCraftError: nothing could be written; the message lists
        all problems.
        """
        objects = [task.obj for task in self._tasks]
        with settings_kept(_meshes(objects)):
            rebase_edited_handles(objects, self._overrides.start_of)
            if not is_alone:
                self._drop_changed()
            solved = [task for task in self._tasks if task.solution is not None]
            looks = [mesh_bridge.Look(task.obj, task.settings.result) for task in solved]
            summary, unwritten = write_all(self._overrides, solved)
            problems = self._problems + unwritten
            try:
                problems += _unseen(solved, looks)
            except UNEXPECTED:  # what is written is written, and needs its undo step
                _log.exception("Looking at the results failed")
            if not summary:
                raise CubicCraftError("; ".join(problems))
        return summary, problems

    def _drop_changed(self) -> None:
        """Discard the solutions of objects that have changed since they were solved."""
        for task in self._tasks:
            if task.is_seen:
                task.source = _if_there(task.source)  # its source may have changed since
                continue
            if task.solution is None:
                continue
            try:
                problem = self._change_of(task)
            except CubicCraftError as error:
                problem = str(error)
            if problem:
                task.solution = None
                self._problems.append(problem)

    def _change_of(self, task: Task) -> str:
        now = Task(task.obj, self._overrides)
        is_same = now.key == task.key
        if task.uid in self._joined:
            is_same = now.key_in_world == task.key_in_world
        shape = read_shape(task.obj, task.settings.start)
        if is_same and shape.is_like(self._shapes[task.uid]):
            return ""
        return f'"{task.obj.name}" was changed while Cubify ran; click Cubify again'


def _unseen(tasks: list[Task], looks: list[mesh_bridge.Look]) -> list[str]:
    found = []
    for task, look in zip(tasks, looks, strict=True):
        if task.written is not None and task.solution is not None:
            positions = mesh_bridge.result_positions(task.written)  # with strokes
            found.append(look.problem(task.written, positions))
    return [text for text in found if text]


def _warnings(task: Task) -> Iterator[str]:
    name = task.obj.name
    with contextlib.suppress(CubicCraftError):  # reading the member will say what is wrong
        if mesh_bridge.is_lost(task.mesh):
            yield (
                f'"{name}" starts from its current shape: it was edited so that its original can no'
                " longer be determined"
            )
    if task.settings.start != "HERE" and is_posed_anew(task.obj):
        yield (
            f'"{name}" was posed anew since the last run, but its original is in the former pose:'
            " if the result is torn, undo and choose From Here"
        )


def _meshes(objects: list[bpy.types.Object]) -> list[bpy.types.Mesh]:
    return [mesh_bridge.mesh_of(obj) for obj in objects]


def _if_there(obj: bpy.types.Object | None) -> bpy.types.Object | None:
    try:
        return obj if obj is not None and obj.users_scene else None
    except ReferenceError:
        return None


def _is_twin(task: Task, group: Sequence[Task]) -> bool:
    """Return whether a task has been solved that has the solution of a group of one."""
    if task.solution is None or task.solution.objects > 1 or len(group) > 1:
        return False
    return task.is_like(group[0])


def _name(group: Sequence[Task]) -> str:
    others = len(group) - 1
    end = f" and {others} more" if others else ""
    return f'"{group[0].obj.name}"{end}'
