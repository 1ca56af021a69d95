# SPDX-License-Identifier: GPL-3.0-or-later
"""A mesh of a Live session that the artist goes on working on; a follower shows the result.

A stroke is seen on the follower at once: each vertex moves as far as in the original, turned by its
rotation in the last solution that was seen. The solver comes after, see `pace`.
"""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

from collections.abc import Mapping, Sequence
from contextlib import ExitStack
from typing import Any, NamedTuple

import bpy
import numpy as np

from ...solver import CubicCraftError
from .. import mesh_bridge
from ..run.stepwise_run import StepwiseRun
from ..run.tasks import Task
from .follower import Follower, shift_beside
from .live_mesh import LiveMesh
from .stale_previews import leave


class _Solved(NamedTuple):
    """A solution that was seen, and the original that it belongs to."""

    positions: np.ndarray
    rotations: np.ndarray
    original: np.ndarray

    def carried(self, original):
        """Return the solution, moved as the original has been."""
        moved = (original - self.original).astype(np.float64)
        shift = moved.mean(axis=0)  # of the whole, which does not turn
        return self.positions + shift + np.einsum("nij,nj->ni", self.rotations, moved - shift)


class FollowedMesh(LiveMesh):
    """The mesh of one task of `tasks.plan` whose result is a new object.

    `is_moved`: whether its run has not read the present shape. `is_like`: whether only positions
    have changed since that run. `original`: (n,3) float32, the present shape, as far as it was
    looked at.
    """

    def __init__(self, task: Task):
        super().__init__(task, is_shown=True)
        self.is_as_seen = task.settings.with_modifiers
        self._follower = Follower(is_as_seen=self.is_as_seen)
        self.is_moved, self.is_like = False, True
        self.original: np.ndarray | None = None
        self._corners: np.ndarray | None = None
        self._solved: _Solved | None = None
        self._is_carried = self._is_stale = False
        self._has_keys = False

    @property
    def follower_uid(self):
        """``session_uid`` of the follower."""
        return self._follower.uid

    @property
    def shown_uid(self):
        """``session_uid`` of the follower's mesh."""
        return self._follower.mesh_uid

    def suits(self, task: Task) -> bool:
        """Return whether it shows the result where the settings of its task say."""
        return task.is_followed and task.is_followed_as_seen == self.is_as_seen

    @property
    def can_be_followed(self):
        """Whether its run can go on with its present shape."""
        return self.is_like and not self._has_keys and self.original is not None

    @property
    def is_unseen(self):
        """Whether a stroke will be seen on the follower with the next `show`."""
        return self._is_carried

    def follower(self) -> bpy.types.Object | None:
        """Return the follower, None if it is gone."""
        return self._follower.find()

    def shows_on(self, obj: bpy.types.Object) -> bpy.types.Mesh | None:
        """Return the mesh of the follower, None if it is gone."""
        follower = self._follower.find()
        return None if follower is None else mesh_bridge.mesh_of(follower)

    def join(self, run: StepwiseRun) -> None:
        """Take part in a run that has read the present shape."""
        super().join(run)
        self.is_moved, self.is_like, self._is_stale = False, True, False

    def go_on(self) -> None:
        """Let the run be seen, which goes on with the present shape from here."""
        self._is_stale = False

    def follow(self, task: Task) -> None:
        """Let the present shape, which an undo may have changed, be read again."""
        self._change()

    def begin_preview(self, obj: bpy.types.Object, beside: Sequence[bpy.types.Object]) -> None:
        """Make the follower, and show on it what was seen."""
        if self._follower.find() is None:
            self._follower.make(obj, shift_beside(beside))
        super().begin_preview(obj, beside)
        if self.original is None:
            self.original, self._corners = self._glance(obj)
        else:
            self.look(obj, is_reported=False)
            self._is_carried = self._solved is not None

    def discard(self) -> None:
        """Remove the follower, unless it has become the result."""
        self._follower.remove()

    def leave(self) -> None:
        """Leave the follower behind as a result, as the original is gone."""
        follower = self._follower.find()
        if follower is not None:
            leave(follower)

    def settle(self, written: bpy.types.Object, undo: ExitStack | None) -> bpy.types.Object:
        """Make the follower the result."""
        return self._follower.become(written, undo)

    def look(self, obj: bpy.types.Object, *, is_reported: bool) -> bool:
        """Look whether the artist has changed the original; return whether he has.

        In Edit Mode, and with modifiers, only positions are compared. There, what Blender has
        reported counts, too.
        """
        before, corners = self.original, self._corners
        self.original, self._corners = self._glance(obj)
        mesh = mesh_bridge.mesh_of(obj)
        has_keys = mesh.shape_keys is not None or mesh_bridge.has_original(mesh)
        self._has_keys = has_keys and not self.is_as_seen  # what is seen has none
        is_like = before is not None and before.shape == self.original.shape
        if corners is not None and self._corners is not None:
            is_like &= np.array_equal(corners, self._corners)
        if self._corners is None:
            self._corners = corners
        is_same = is_like and before.tobytes() == self.original.tobytes()  # nan is not nan
        if is_same and not (is_reported and (mesh.is_editmode or self.is_as_seen)):
            return False
        if not is_like:
            self.is_like, self._solved, self._is_carried = False, None, False
        elif not is_same and not self._has_keys:
            self.keep_solved(before)
            self._is_carried = self._solved is not None
        self._change()
        return True

    def keep_solved(self, original: np.ndarray | None = None) -> None:
        """Keep the solution that is seen, before its run is given up."""
        original = self.original if original is None else original
        is_kept = self._is_stale or self._solved is not None
        if is_kept or self.run.moment is None or original is None:
            return
        found = self.run.intermediate_result(self.object_uid, with_rotations=True)
        if found is None or found[1] is None or found[0].shape != original.shape:
            return
        self._solved = _Solved(found[0], found[1], original)

    def show(self, obj: bpy.types.Object, values: Mapping[str, Any]) -> bool:
        """Show the run, or the last one carried along; return whether it is new."""
        values = {**values, "result": "MESH", "with_modifiers": False}
        if not self._is_stale and self._is_new:
            if not self._fits(obj):
                self._follower.renew(obj)
                super().begin_preview(obj, [obj])
            self._solved, self._is_carried = None, False
            return super().show(obj, values)
        return self._is_carried and self._show_carried(obj, values)

    def release(self) -> None:
        """Release all arrays."""
        super().release()
        self.original = self._corners = self._solved = None

    def _change(self):
        self.is_moved, self._is_stale, self.member = True, True, None
        self.run.hold()

    def _glance(self, obj):
        if not self.is_as_seen:
            return mesh_bridge.glance(obj)
        try:
            points, corners = mesh_bridge.read_evaluated_points(obj)
        except CubicCraftError:  # reading it will report the reason
            return np.empty((0, 3), np.float32), None
        return points, np.array([corners])

    def _fits(self, obj):
        mesh = self.shows_on(obj)
        return mesh is None or self.original is None or len(mesh.vertices) == len(self.original)

    def _show_carried(self, obj, values):
        self._is_carried = False
        self._ease.forget()
        mesh, solved = self.shows_on(obj), self._solved
        if self._preview is None or mesh is None or solved is None or self.original is None:
            return False
        if len(mesh.vertices) != len(solved.positions) or not np.isfinite(self.original).all():
            return False
        noted = {"values": values, "run": self.run.outcome} if self.run.is_started else None
        carried, has_edges = solved.carried(self.original), mesh_bridge.are_wanted(obj, values)
        self._preview.show(mesh, carried, solved.rotations, noted, has_edges)
        return True
