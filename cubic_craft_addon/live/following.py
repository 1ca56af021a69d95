# SPDX-License-Identifier: GPL-3.0-or-later
"""What Live computes while the artist works on the originals."""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import time
from collections.abc import Mapping, Sequence

import bpy

from .followed_mesh import FollowedMesh
from .live_mesh import LiveMesh
from .live_runs import Groups, LiveRuns
from .pace import Pace, Work


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
    return list({id(mesh.run): mesh.run for mesh in meshes if mesh.run is not None}.values())


def _seconds(run):
    return run.problem.seconds if run.problem is not None else 0.0
