# SPDX-License-Identifier: GPL-3.0-or-later
"""The meshes of a session together: which object each is for, and where its result is shown."""

from collections.abc import Iterable, Mapping, Sequence

import bpy

from .. import mesh_bridge
from ..environment.modes import MODES
from ..run.tasks import Task
from .followed_mesh import FollowedMesh
from .live_mesh import LiveMesh
from .plan import Plan


def meshes_for(tasks: Iterable[Task]) -> list[LiveMesh]:
    """Return what shows the result of each task."""
    found, seen = [], set()
    for task in tasks:
        found.append(_mesh_for(task, seen))
        seen.add(task.mesh)
    return found


def mesh_of(meshes: Sequence[LiveMesh], obj: bpy.types.Object) -> LiveMesh | None:
    """Return the one of an object, or of the mesh that it shares."""
    uid = obj.data.session_uid
    candidates = [mesh for mesh in meshes if uid in (mesh.mesh_uid, mesh.shown_uid)]
    own = [mesh for mesh in candidates if mesh.object_uid == obj.session_uid]
    return next(iter(own + candidates), None)


def still_there(
    meshes: Sequence[LiveMesh], objects: Mapping[int, bpy.types.Object]
) -> list[LiveMesh]:
    """Return those whose objects are there; the follower of one that is gone stays, as a result."""
    for mesh in meshes:
        if isinstance(mesh, FollowedMesh) and mesh.object_uid not in objects:
            mesh.leave()
    return [
        mesh
        for mesh in meshes
        if mesh.object_uid in objects
        and not (isinstance(mesh, FollowedMesh) and mesh.follower() is None)
    ]


def suit(meshes: list[LiveMesh], plan: Plan) -> None:
    """Let results be shown on followers or on the objects themselves, as the setting is now.

    In place, so that none is forgotten if another one fails.
    """
    seen = set()
    for mesh, task in plan.pairs(meshes):
        may_be_written = task.is_followed or task.obj.mode in MODES
        if may_be_written and not mesh.suits(task):  # else the next tick ends it
            mesh_bridge.end_preview(task.mesh)
            mesh.discard()
            other = _mesh_for(task, seen)
            other.take_over(mesh)
            meshes[meshes.index(mesh)] = other
            other.begin_preview(task.obj, _sources(plan))
        seen.add(task.mesh)


def begin_previews(meshes: Sequence[LiveMesh], plan: Plan) -> None:
    """Store on each mesh what its preview will overwrite."""
    for mesh, task in plan.pairs(meshes):
        mesh.begin_preview(task.obj, _sources(plan))


def has_preview(meshes: Sequence[LiveMesh], objects: Mapping[int, bpy.types.Object]) -> bool:
    """Return whether there is a preview on any of them, as Blender has them now."""
    shown = [m.shows_on(objects[m.object_uid]) for m in meshes if m.object_uid in objects]
    return any(mesh_bridge.has_preview(mesh) for mesh in shown)


def _mesh_for(task, seen):
    """Return what shows the result of a task, on a mesh only once: `seen` are those of others."""
    return FollowedMesh(task) if task.is_followed else LiveMesh(task, task.mesh not in seen)


def _sources(plan):
    return [task.obj for task in plan.tasks.values()]
