# SPDX-License-Identifier: GPL-3.0-or-later
"""What to solve, as one task per mesh or new object, and how all results are written."""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import logging
from collections.abc import Mapping, Sequence
from contextlib import nullcontext
from dataclasses import asdict, replace
from typing import Any

import bpy
import numpy as np

from ...solver import CubicCraftError
from .. import hidden_source, mesh_bridge
from ..environment.requirements import look_at_engine
from ..handles.own_pose import keep_poses
from ..handles.pose import remember_pose
from ..mesh_bridge import LastRun
from ..read.bones import bone_places
from ..read.cages import subdivision_of
from ..read.member import Member, read_member
from ..read.object_frame import placements
from ..read.reflections import modifier_reflections
from ..settings.overrides import SettingsOverrides
from ..settings.rollback import settings_kept
from . import pipeline
from .failures import UNEXPECTED, in_words
from .posed_anew import REST
from .up_to_date import what_matters

_log = logging.getLogger(__name__)


def run_of(solution: pipeline.Solution, settings: dict[str, Any]) -> LastRun:
    """Return the summary of a solution that is about to be written."""
    result = solution.result
    return LastRun(
        settings=settings,
        vertices=solution.vertices,
        objects=solution.objects,
        iterations=int(result.iterations),
        energy=max(float(result.energy.total), 0.0),
        converged=bool(result.converged),
        seconds=float(solution.total_seconds),
        device=result.device,
        matching=None if solution.matching is None else int(solution.matching),
        own_vertices=int(solution.own_vertices),
        crossings=None if result.crossings is None else int(result.crossings),
        pressed=None if result.pressed is None else int(result.pressed),
    )


class Task:
    """An object to be cubified with its settings; `solution` is there once it is solved."""

    def __init__(self, obj: bpy.types.Object, overrides: SettingsOverrides):
        self.obj, self.mesh = obj, mesh_bridge.mesh_of(obj)
        self.uid = obj.session_uid
        self.settings = overrides.settings_for(obj)
        if self.settings.result == "SHAPE_KEY":
            mesh_bridge.check_relative_keys(obj)
        self.solution: pipeline.Solution | None = None
        self.is_followed = False
        """whether the artist works on it in any mode while Live shows the result beside it"""
        self.is_seen = False
        """whether the object was made by `mesh_bridge.make_seen`"""
        self.source: bpy.types.Object | None = None
        """what it was made of"""
        self.written: bpy.types.Object | None = None
        """what has the cubic shape, once it is written"""
        self._reflections = modifier_reflections(obj)
        self._subdivision = subdivision_of(obj)
        self._alone, self.in_world = placements(obj, self.settings)
        self.bones = bone_places(obj) if self.settings.keep_pose else None

    @property
    def is_followed_as_seen(self):
        """Whether it is followed with its modifiers."""
        return self.is_followed and self.settings.with_modifiers

    @property
    def key(self):
        """Everything but the mesh that determines the solution; no references to Blender's data."""
        is_free = self.settings.floor != "OFF" and not self.settings.handles
        up = self._alone.up.tobytes() if is_free else b""
        pointers = {"frame": None, "form_object": None}
        regions = tuple(replace(region, form_object=None) for region in self.settings.regions)
        settings = replace(self.settings, regions=regions, **pointers)
        return settings, self._reflections, self._subdivision, up, self._alone.key, self.bones

    @property
    def key_in_world(self):
        """The same for a task that is solved with others."""
        return self.key, self.in_world and self.in_world.key

    @property
    def run(self) -> LastRun:
        """The summary of the solution, once it is solved."""
        assert self.solution is not None
        rest = {REST: list(self.bones.ends)} if self.bones else {}
        return run_of(self.solution, what_matters(self.settings) | rest)

    def is_like(self, other: Task) -> bool:
        """Return whether both have the same solution if each is solved alone."""
        one, two = self._alone, other._alone
        return (
            self.mesh == other.mesh
            and self.settings == other.settings
            and self._reflections == other._reflections
            and self._subdivision == other._subdivision
            and self.bones == other.bones
            and (self.settings.floor == "OFF" or np.allclose(one.up, two.up))
            and np.allclose(one.linear, two.linear)
            and np.allclose(one.style.orientation, two.style.orientation)
        )


def plan(
    overrides: SettingsOverrides, objects: list[bpy.types.Object]
) -> tuple[list[Task], list[str]]:
    """Return the tasks, and the problems as texts.

    A mesh that several objects share is one task, with the transform of the first; only new
    objects can differ.
    """
    tasks, problems = [], []
    unlike: dict[Task, list[str]] = {}
    for obj in objects:
        try:
            task = Task(obj, overrides)
        except CubicCraftError as error:
            problems.append(str(error))
            continue
        twin = next((other for other in tasks if other.mesh == task.mesh), None)
        if twin is None or task.settings.result == "NEW_OBJECT":
            tasks.append(task)
        elif not twin.is_like(task):
            unlike.setdefault(twin, []).append(f'"{obj.name}"')
    return tasks, problems + [_in_one_mesh(twin, names) for twin, names in unlike.items()]


def _in_one_mesh(twin, names):
    """Report that objects share the shape of another, in one sentence for possibly hundreds."""
    shares = f'{names[0]} shares its mesh with "{twin.obj.name}" and now has its shape;'
    if len(names) == 1:
        return f"{shares} make it single-user to give it its own shape"
    others = "another object" if len(names) == 2 else f"{len(names) - 1} others"
    return f"{shares} so do {others}; make them single-user to give them their own shapes"


def key_of(tasks: Sequence[Task]) -> tuple:
    """Return everything except the meshes that determines the solutions of an assembly."""
    if len(tasks) == 1:
        return ((tasks[0].uid, tasks[0].key),)
    return tuple((task.uid, task.key_in_world) for task in tasks)


def prepare_all(
    tasks: Sequence[Task],
    known: Mapping[int, Member] | None = None,
    earlier: Sequence[pipeline.MemberProblem] = (),
    *,
    weights_changed: bool = False,
) -> tuple[pipeline.MemberProblem | None, list[str]]:
    """Read and factorize an assembly, without the objects that cannot be used.

    `known`: mapping of int to Member, optional, data from earlier runs, by the ``session_uid`` of
    the object. `earlier`, `weights_changed`: as for `pipeline.prepare` and `read_member`. Returns
    `problem`: Problem or None; `problems`: list of str.
    """
    members, problems = [], []
    for task in tasks:
        before = known.get(task.uid) if known else None
        try:
            with _readable(task) as obj:
                member = read_member(
                    obj,
                    task.settings,
                    before,
                    weights_changed=weights_changed,
                    rigged=task.obj if task.is_followed_as_seen else task.source,
                )
            if task.is_followed:
                member = replace(member, uid=task.uid, name=task.obj.name)
        except CubicCraftError as error:
            problems.append(str(error))
        else:
            members.append(member)
    if not members:
        return None, problems
    try:
        return pipeline.prepare(members, earlier), problems
    except CubicCraftError as error:
        return None, [*problems, str(error)]


def _readable(task):
    if task.is_followed_as_seen:
        return mesh_bridge.as_seen(task.obj)
    return mesh_bridge.in_no_mode(task.obj) if task.is_followed else nullcontext(task.obj)


def write_all(overrides: SettingsOverrides, tasks: list[Task]) -> tuple[str, list[str]]:
    """Write the solutions of all tasks.

    Returns `summary`: str, empty if nothing was written; `problems`: list of str, meshes written
    before a failure stay and need their undo step. Hair and cages that do not follow are reported,
    too.
    """
    # All texts come before the first write, because nothing may fail after a write.
    solutions = [task.solution for task in tasks if task.solution is not None]
    runs = [task.run for task in tasks]
    statuses = [run.status for run in runs]
    waits = [(id(solution.result), solution.total_seconds) for solution in solutions]
    unmoved = [_left_behind(task) for task in tasks]
    written, problems = 0, []
    if tasks:
        look_at_engine()
    try:
        for task, run in zip(tasks, runs, strict=True):
            write_task(overrides, task, run)
            problems += unmoved[written]
            written += 1
    except UNEXPECTED as error:  # this object has been restored
        if not isinstance(error, CubicCraftError):
            _log.exception("Writing a result failed")
        reason = in_words(error)
        problems.append(f"Writing failed ({reason}); meshes that were not written are unchanged")
    if written == 1:
        return f"Cubified: {statuses[0]}", problems
    if written:
        # Objects that were solved together took their time only once.
        seconds = sum(dict(waits[:written]).values())
        return f"Cubified {written} meshes in {seconds:.2f} s", problems
    return "", problems


def _left_behind(task):
    """Return texts for what does not follow the result of a task."""
    found = hair_left_behind(task.obj, task.settings.result)
    if task.solution is not None and task.solution.is_stiff:
        found.append(
            f'What is seen of "{task.obj.name}" keeps its form, as its cage has too few faces: in'
            " Edit Mode, subdivide them or crease edges"
        )
    return found


def write_task(overrides: SettingsOverrides, task: Task, run: LastRun) -> None:
    """Write the solution of a task with the summary of its run, or nothing at all.

    The source of a new object is hidden behind it.
    """
    assert task.solution is not None
    source = task.source if task.is_seen else task.obj

    def complete(target):
        keep_poses(target, overrides.poses.get(task.uid, {}))
        # A shape key poses nothing: its basis is still the original.
        is_posed = task.settings.result != "SHAPE_KEY" and overrides.uses_own_handles(task.obj)
        remember_pose(target, is_posed=is_posed)
        overrides.remember_on(target, task.settings)
        # What was followed is beside the new object, and worked on.
        if source is not None and target != source and not task.is_followed:
            hidden_source.hide(source, target)
        shown = {**run.settings, "sharp_edges": task.settings.sharp_edges}
        mesh_bridge.shade_shape(target, shown)

    solution, note = task.solution, asdict(run)
    with hidden_source.source_kept(source):
        if task.is_seen or task.is_followed_as_seen:
            new = task.obj if task.is_seen else mesh_bridge.make_seen(task.obj)
            made = solution.positions, solution.rotations
            task.written = mesh_bridge.write_seen(new, source, *made, complete, note)
        else:
            with settings_kept([task.mesh]):
                result = task.settings.result
                task.written = pipeline.write(task.obj, solution, result, complete, note)


def hair_left_behind(obj: bpy.types.Object, result: str) -> list[str]:
    """Return a text for the hair that does not follow a result, as a list of one or none.

    Blender moves it with the surface only where a modifier deforms it, and that measures from the
    shape below shape keys: a result in the mesh itself leaves all hair behind.

    `obj`: the mesh object. `result`: {"MESH", "SHAPE_KEY", "NEW_OBJECT"}, where the result is
    written to.
    """
    if result == "NEW_OBJECT":
        return []
    names = [
        f'"{hair.name}"'
        for hair in bpy.data.objects
        if isinstance(hair.data, bpy.types.Curves)
        and hair.data.surface == obj
        and not (result == "SHAPE_KEY" and any(m.type == "NODES" for m in hair.modifiers))
    ]
    if not names:
        return []
    others = f" and {len(names) - 1} more" if len(names) > 1 else ""
    return [
        f'Hair {names[0]}{others} does not follow "{obj.name}": in its Sculpt Mode, choose Curves '
        "> Snap to Deformed Surface"
    ]
