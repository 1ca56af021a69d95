# SPDX-License-Identifier: GPL-3.0-or-later
"""All runs of a Live session: one per assembly, whose meshes may change at any time."""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import time
from collections.abc import Mapping, Sequence, Set

import bpy

from ..run.stepwise_run import StepwiseRun
from ..run.tasks import Task
from .followed_mesh import FollowedMesh
from .live_mesh import LiveMesh
from .pace import Pace, Work

Groups = Mapping[tuple[int, ...], Sequence[Task]]
"""the tasks of `assemblies`, by the ``session_uid`` of their objects"""


class LiveRuns:
    """The runs, by the ``session_uid`` of the objects that take part."""

    def __init__(self):
        self._runs: dict[tuple[int, ...], StepwiseRun] = {}
        self._turn = 0

    @property
    def is_working(self):
        """Whether there is more to compute."""
        return any(run.is_working for run in self._runs.values())

    @property
    def problems(self):
        """The problems of objects, as texts."""
        return [text for run in self._runs.values() for text in run.problems]

    def is_changed(self, groups: Groups) -> bool:
        """Return whether the settings differ from those of the runs."""
        if not groups:
            return any(run.is_asked_for for run in self._runs.values())
        if groups.keys() != self._runs.keys():
            return True
        return any(run.is_changed(groups[uids]) for uids, run in self._runs.items())

    def restart_changed(self, groups: Groups, meshes: Sequence[LiveMesh]) -> None:
        """Restart the runs whose settings have changed, and connect the meshes to them."""
        if not groups:  # a setting is invalid; the known data is kept for the next one
            for run in self._runs.values():
                run.stop()
            return
        known = {mesh.object_uid: mesh.member for mesh in meshes if mesh.member}
        earlier = [run.problem for run in self._runs.values() if run.problem]
        before, self._runs = self._runs, {}
        for uids, tasks in groups.items():
            run = self._runs[uids] = before.get(uids) or StepwiseRun()
            if run.is_changed(tasks):
                run.restart(tasks, known, earlier)
                _join(uids, run, meshes)
        for mesh in meshes:
            if mesh.run not in self._runs.values():
                mesh.join(StepwiseRun())

    def restart_painted(self, groups: Groups, meshes: Sequence[LiveMesh]) -> bool:
        """Restart the runs whose vertex groups have new weights; return whether there were any."""
        painted = [
            uids
            for uids, tasks in groups.items()
            if uids in self._runs and self._runs[uids].restart_if_painted(tasks)
        ]
        for uids in painted:
            _join(uids, self._runs[uids], meshes)
        return bool(painted)

    def renew(self, groups: Groups, meshes: Sequence[LiveMesh], moved: Set[int]) -> None:
        """Read the objects anew that have moved vertices, by ``session_uid``, and solve them."""
        known = {mesh.object_uid: mesh.member for mesh in meshes if mesh.member}
        for uids, tasks in groups.items():
            if uids in self._runs and not moved.isdisjoint(uids):
                self._runs[uids].renew(tasks, known)
                _join(uids, self._runs[uids], meshes)

    def advance(self, deadline: float) -> None:
        """Advance all runs in turn, so that they visibly move together."""
        working = [run for run in self._runs.values() if run.is_working]
        while working:
            self._turn += 1
            working[self._turn % len(working)].advance()
            if time.perf_counter() >= deadline:
                return
            working = [run for run in working if run.is_working]

    def complete(self, seconds: float) -> None:
        """Advance all runs to their ends, as far as the time in seconds allows."""
        deadline = time.perf_counter() + seconds
        while self.is_working and time.perf_counter() < deadline:
            self.advance(deadline)

    def release(self) -> None:
        """Release all arrays."""
        for run in self._runs.values():
            run.forget()
        self._runs.clear()


def _join(uids, run, meshes):
    for mesh in meshes:
        if mesh.object_uid in uids:
            mesh.join(run)


class Following:
    """The originals of one session that are followed, at their common pace."""

    def __init__(self, runs: LiveRuns):
        self._runs = runs
        self._pace = Pace()

    @property
    def is_waiting(self):
        """Whether a shape has changed, of which the exact run has yet to begin."""
        return self._pace.is_waiting

    def look(
        self,
        meshes: Sequence[LiveMesh],
        objects: Mapping[int, bpy.types.Object],
        now: float,
        *,
        is_reported: bool,
    ) -> None:
        """Look whether originals, by ``session_uid``, have changed."""
        seen = [
            mesh.look(objects[mesh.object_uid], is_reported=is_reported)
            for mesh in _followed(meshes)
            if mesh.object_uid in objects
        ]
        if any(seen) or (not self.is_waiting and _moved(meshes)):
            self._pace.changed(now)

    def work(
        self, groups: Groups, meshes: Sequence[LiveMesh], now: float, *, is_hurried: bool
    ) -> bool:
        """Do what is due, at once if it is hurried; return whether the objects were read."""
        moved = _moved(meshes)
        if not moved:
            self._pace.renewed()  # a setting has changed, and all was read for it
            return False
        work = self._pace.due(now, sum(_seconds(run) for run in _runs_of(moved)))
        if work is Work.RENEW or is_hurried:
            for mesh in _followed(meshes):
                mesh.keep_solved()
            self._runs.renew(groups, meshes, {mesh.object_uid for mesh in moved})
            self._pace.renewed()
            return True
        if work is Work.FOLLOW and not any(mesh.is_unseen for mesh in moved):
            begin = time.perf_counter()
            for run in _runs_of(moved):
                mine = [mesh for mesh in moved if mesh.run is run]
                shapes = {m.object_uid: m.original for m in mine if m.original is not None}
                if all(mesh.can_be_followed for mesh in mine) and run.follow(shapes):
                    for mesh in mine:
                        mesh.go_on()
            self._pace.followed(time.perf_counter() - begin)
        return False


def _followed(meshes):
    return [mesh for mesh in meshes if isinstance(mesh, FollowedMesh)]


def _moved(meshes):
    return [mesh for mesh in _followed(meshes) if mesh.is_moved]


def _runs_of(meshes):
    return list({id(mesh.run): mesh.run for mesh in meshes}.values())


def _seconds(run):
    return run.problem.seconds if run.problem is not None else 0.0
