# SPDX-License-Identifier: GPL-3.0-or-later
"""One mesh of a Live session: its run, and what is shown of it."""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import bpy
import numpy as np

from ... import solver
from .. import cubify, mesh_bridge
from ..tasks import Task

_FIRST_SHOWN = 2  # iterations; the first one moves nothing but handles


class LiveMesh:
    """The run of one task of `tasks.plan`.

    It keeps no reference to Blender's data, which dies at every undo: the mesh and the object are
    given anew to each call, and told by their ``session_uid``.

    Attributes
    ----------
    object_uid, mesh_uid : int
    problem : str
        Why there is no run, to be shown to the artist.
    solution : cubify.Solution or None
        The result, once the run has ended.
    """

    def __init__(self, task: Task, is_shown: bool):
        self.object_uid = task.obj.session_uid
        self.mesh_uid = task.mesh.session_uid
        self.problem = ""
        self.solution: cubify.Solution | None = None
        self._is_shown = is_shown
        self._prepared: cubify.Prepared | None = None
        self._run: solver.Run | None = None
        self._preview: mesh_bridge.Preview | None = None
        self._key = None
        self._shown_moment = None

    # -- settings ----------------------------------------------------------------------------------

    def is_changed(self, task: Task | None) -> bool:
        """Tell whether a task asks for something else than what is being done."""
        return (task and task.key) != self._key

    def restart(self, task: Task | None) -> None:
        """Start from the original shape, with the settings of the task; without one, stop."""
        self._key = task and task.key
        self._stop("")
        if task is None:
            return
        try:
            self._prepared = cubify.prepare(task.obj, task.settings, self._prepared)
        except solver.CubicCraftError as error:
            self._stop(str(error))
        else:
            self._start(task)

    def restart_if_painted(self, task: Task | None) -> bool:
        """Start again if vertex groups that matter have other weights now, and tell if so."""
        before = self._prepared
        if before is None or task is None:
            return False
        if not (task.settings.map_group or task.settings.handles):
            return False
        try:
            now = cubify.prepare(task.obj, task.settings, before, weights_changed=True)
        except solver.CubicCraftError as error:
            self._stop(str(error))
            return True
        is_same = np.array_equal(now.map_weights, before.map_weights)
        if is_same and np.array_equal(now.handle_of, before.handle_of):
            return False
        self._prepared = now
        self._start(task)
        return True

    def _start(self, task):
        assert self._prepared is not None
        self._stop("")
        try:
            self._run = cubify.start(self._prepared, task.settings)
            settings = task.settings
            self._progress = solver.Progress(settings.max_iterations, settings.tolerance)
        except solver.CubicCraftError as error:
            self.problem = str(error)

    def _stop(self, problem):
        self.problem, self.solution, self._run = problem, None, None
        self._shown_moment = None

    # -- work --------------------------------------------------------------------------------------

    @property
    def is_working(self):
        """Whether there is something left to compute."""
        return self._run is not None and self.solution is None

    def advance(self) -> None:
        """Do one phase of the solver. If it cannot go on, `problem` says why."""
        assert self._run is not None and self._prepared is not None
        try:
            if self._run.reason is None:
                self._run.advance()
            else:
                self.solution = cubify.solution_of(self._prepared, self._run)
        except solver.CubicCraftError as error:
            self._stop(f'"{self._prepared.name}": {error}')

    @property
    def is_seen(self):
        """Whether the present run has been shown, as far as it is shown at all."""
        return self._preview is None or self._shown_moment is not None

    @property
    def iteration(self):
        """Number of iterations done."""
        return self._run.stylization.iteration if self._run else 0

    @property
    def status(self):
        """A line for the artist, and how far the run has come, from 0 to 1."""
        energy = self._run.stylization.energy if self._run else None
        if energy is None:
            is_coarse = self._run is not None and self._run.is_on_coarser_mesh
            return ("First on a coarser mesh" if is_coarse else ""), 0.0
        text = f"Iteration {self.iteration}, energy {max(energy.total, 0.0):.5f}"
        if self.solution is None:
            return text, self._progress.update(self._run.stylization)
        end = "converged" if self.solution.result.converged else "not converged"
        return f"{text}, {end}", 1.0

    @property
    def rest(self):
        """The RestMesh, or None."""
        return self._prepared.setup.rest if self._prepared else None

    # -- what is shown -----------------------------------------------------------------------------

    def begin_preview(self, mesh: bpy.types.Mesh) -> None:
        """Keep what the preview will overwrite, on the mesh itself."""
        if self._is_shown:
            self._preview = mesh_bridge.Preview(mesh)
            self._shown_moment = None

    def show(self, mesh: bpy.types.Mesh) -> bool:
        """Show what the run has come to; tell whether that was anything new."""
        if self._preview is None or self._prepared is None or self._run is None:
            return False
        if self._run.iterations < _FIRST_SHOWN and self.solution is None:
            return False  # what is seen stays until there is something better
        moment = (self._run.iterations, self.solution is not None)
        if moment == self._shown_moment:
            return False
        self._shown_moment = moment
        if self.solution is not None:
            positions, rotations = self.solution.positions, self.solution.rotations
        else:
            positions, rotations = cubify.glance(
                self._prepared, self._run, self._preview.needs_rotations
            )
        self._preview.show(mesh, positions, rotations)
        return True

    def release(self) -> None:
        """Let go of all arrays."""
        self._preview = self._prepared = self._run = self.solution = None

    def follow(self, task: Task) -> None:
        """Go on with a mesh that Blender has undone or redone, which may have another shape now.

        The preview must have been ended.
        """
        try:
            shape = cubify.read_shape(task.obj)
        except solver.CubicCraftError as error:
            self._prepared = None
            self._stop(str(error))
            return
        if self._prepared is None or not shape.is_like(self._prepared.shape):
            self._prepared = None
            self.restart(task)
        elif not self.restart_if_painted(task) and self.is_changed(task):
            self.restart(task)
