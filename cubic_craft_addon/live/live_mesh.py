# SPDX-License-Identifier: GPL-3.0-or-later
"""One mesh of a Live session, which shows the run that it takes part in."""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import time
from collections.abc import Iterable, Mapping, Sequence
from contextlib import ExitStack
from typing import Any

import bpy

from ... import solver
from .. import mesh_bridge
from ..read.member import Member, read_shape
from ..run.stepwise_run import StepwiseRun
from ..run.tasks import Task
from .ease import Ease


class LiveMesh:
    """The mesh of one task of `tasks.plan`.

    It keeps no reference to Blender's data, which undo frees: the mesh is passed again to
    each call, and identified by its ``session_uid``.

    `run`: the one that it takes part in; an idle one if it takes part in none. `member`: the data
    last read from it.
    """

    is_as_seen = False
    """whether its run is of the visible mesh, with modifiers"""
    follower_uid = shown_uid = 0
    """``session_uid`` of the object beside the original on which it shows the result, and of the
    mesh of that; 0 for none"""

    def __init__(self, task: Task, is_shown: bool):
        self.object_uid = task.uid
        self.mesh_uid = task.mesh.session_uid
        self.run = StepwiseRun()
        self.member: Member | None = None
        self._is_shown = is_shown
        self._start: mesh_bridge.Start = task.settings.start
        self._preview: mesh_bridge.Preview | None = None
        self._shown_moment = None
        self._ease = Ease()

    @property
    def solution(self):
        """The result, once the run has ended."""
        return self.run.solution_of(self.object_uid)

    @property
    def solution_so_far(self):
        """The current shape as a result, None if nothing of it can be shown yet."""
        return self.run.solution_so_far(self.object_uid)

    @property
    def is_seen(self):
        """Whether the current run has been shown, if it is shown at all."""
        return self._preview is None or self._shown_moment is not None

    def follower(self) -> bpy.types.Object | None:
        """Return the object beside the original on which it shows the result, None for none."""
        return None

    def shows_on(self, obj: bpy.types.Object) -> bpy.types.Mesh | None:
        """Return the mesh on which it shows the run of an object."""
        return mesh_bridge.mesh_of(obj)

    def join(self, run: StepwiseRun) -> None:
        """Take part in a run that has just been started, or is idle."""
        self.run = run
        self.member = run.member_of(self.object_uid) or self.member
        self._shown_moment = None

    def follow(self, task: Task) -> None:
        """Discard the data of a mesh that has another shape after undo or redo.

        The preview must have been ended.
        """
        try:
            is_like = self.member is not None and self.member.shape.is_like(
                read_shape(task.obj, task.settings.start)
            )
        except solver.CubicCraftError:
            is_like = False  # reading it again will report the reason
        if not is_like:
            self.member = None
            self.run.forget()

    def begin_preview(self, obj: bpy.types.Object, beside: Sequence[bpy.types.Object]) -> None:
        """Keep what the preview will overwrite, on the mesh itself.

        A follower, if it needs one, is made `beside` all these.
        """
        mesh = self.shows_on(obj)
        if self._is_shown and mesh is not None:
            self._preview = mesh_bridge.Preview(mesh, self._start)
            self._shown_moment = None
            self._ease.forget()

    def suits(self, task: Task) -> bool:
        """Return whether it shows the result where the settings of its task say."""
        return not task.is_followed

    def take_over(self, other: LiveMesh) -> None:
        """Take the place of another one of the same object."""
        self.run = other.run
        self.member = other.member if self.is_as_seen == other.is_as_seen else None

    def discard(self) -> None:
        """Remove what was made to show it on; previews have been ended."""

    def settle(self, written: bpy.types.Object, undo: ExitStack | None) -> bpy.types.Object:
        """Return the object that is the result, once it was written to an object.

        What is made of it is taken back by `undo`, or if that is None, is for good.
        """
        return written

    def show(self, obj: bpy.types.Object, values: Mapping[str, Any]) -> bool:
        """Show the current state of the run; return whether it was new.

        `values` are the settings, for a file that is opened with this shape.
        """
        mesh = self.shows_on(obj)
        if self._preview is None or mesh is None or not self._is_new:
            return False
        is_next, self._shown_moment = self._shown_moment != self.run.moment, self.run.moment
        found = self.run.intermediate_result(self.object_uid, self._preview.needs_rotations)
        if found is None:
            return False
        positions, rotations = found
        now = time.perf_counter()
        if is_next and self.run.has_replaced:
            self._ease.begin(positions, now)
        outcome = {"values": values, "run": self.run.outcome}
        shown = self._ease.shown(positions, now)
        has_edges = mesh_bridge.are_wanted(obj, values)
        self._preview.show(mesh, shown, rotations, outcome, has_edges)
        return True

    def arrive(self) -> None:
        """Take no more way from shape to shape: the end is waited for."""
        self._ease.forget()

    @property
    def _is_new(self):
        moment = self.run.moment
        return moment is not None and (moment != self._shown_moment or self._ease.is_on)

    def take_along(self, obj: bpy.types.Object) -> bool:
        """Transform the data under the preview as the artist has transformed the visible mesh.

        Return whether the preview must be restarted, see `Preview.take_along`.
        """
        mesh = self.shows_on(obj)
        return self._preview is not None and mesh is not None and self._preview.take_along(mesh)

    def release(self) -> None:
        """Release all arrays."""
        self._preview, self.member, self.run = None, None, StepwiseRun()
        self._ease.forget()


def take_along(meshes: Iterable[LiveMesh], objects: Mapping[int, Any]) -> bool:
    """Do this for all meshes whose objects, by ``session_uid``, exist; return whether any moved."""
    there = [mesh for mesh in meshes if mesh.object_uid in objects]
    return any([mesh.take_along(objects[mesh.object_uid]) for mesh in there])
