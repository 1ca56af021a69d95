# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects that are solved together, frame by frame."""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import bpy
import numpy as np

from ... import solver
from ...solver import CubicCraftError
from .. import mesh_bridge
from ..read.bones import read_pose
from ..read.member import Member, ShapeRead, placed, read_member
from ..read.object_frame import placements
from ..run import pipeline
from ..run.up_to_date import what_matters
from ..settings.values import IN_ANIMATION, Settings
from .sources import on_the_way

_STILL = 1e-9  # of the unit box; less is no movement


class FrameSettings(Protocol):
    """The settings in the present frame, such as `SettingsOverrides`."""

    def settings_for(self, obj: bpy.types.Object) -> Settings:
        """Return those with which an object is to be cubified."""
        ...


@dataclass(frozen=True)
class Animated:
    """An object, and the new one with its visible mesh in the first frame."""

    source: bpy.types.Object
    new: bpy.types.Object

    @property
    def corners(self):
        """Number of corners of all faces of the visible mesh."""
        return len(mesh_bridge.mesh_of(self.new).loops)

    @property
    def vertices(self):
        """Number of vertices of the visible mesh."""
        return len(mesh_bridge.mesh_of(self.new).vertices)

    def settings(
        self, overrides: FrameSettings, share: float = 1.0, start: FrameSettings | None = None
    ) -> Settings:
        """Return the settings in this frame, a share of the way from others or the original."""
        owner = self.source if self.source.type == "MESH" else self.new
        before = None if start is None else start.settings_for(owner)
        return replace(on_the_way(before, overrides.settings_for(owner), share), **IN_ANIMATION)


class AnimatedGroup:
    """Objects that are solved together.

    `start`: FrameSettings, optional, those that a share of 0 stands for, instead of the original.
    `is_process`: whether only the settings change from frame to frame. Raises CubicCraftError: they
    cannot be solved.
    """

    def __init__(
        self,
        objects: Sequence[Animated],
        overrides: FrameSettings,
        start: FrameSettings | None = None,
        *,
        is_process: bool = False,
    ):
        self.objects = objects
        self._overrides, self._start = overrides, start
        self._first = pipeline.prepare([self._in_first_pose(one) for one in objects])
        self._unposed = self._first
        self._is_process = is_process
        self._sequence = self._continued(None)
        self.moment = ""
        """what the last frame depended on"""
        self.is_settled = False
        """whether nothing moved any more at the end of the last frame"""
        self._last: solver.Frames | None = None

    @property
    def vertices(self):
        """Number of vertices of all objects."""
        return self._first.vertices

    @property
    def name(self):
        """The name for messages."""
        return self._first.name

    @property
    def about(self):
        """What the frames depend on, as values for JSON."""
        members = self._first.pieces
        start = self._start
        return {
            "objects": [one.source.name for one in self.objects],
            "from": start and [what_matters(one.settings(start)) for one in self.objects],
            "first": _digest(
                [(_moment(member), _digest_of_array(member.shape.triangles)) for member in members]
            ),
        }

    def begin_as(self, other: AnimatedGroup) -> None:
        """Continue from the shape of the same objects with other settings.

        Raises CubicCraftError: the settings do not give the same vertices to the solver.
        """
        assert other.state is not None
        V = self._first.setup.rest.V
        if V.shape != other.state.pose.shape or not np.allclose(V, other.state.pose, atol=_STILL):
            raise CubicCraftError(
                f"{self.name}: there is no way from settings with other Keep Together, Refine or"
                " Relative To; choose another object to begin as"
            )
        self._sequence = self._continued(other.state)

    def continue_from(self, state: solver.SequenceState, moment: str, last: solver.Frames) -> None:
        """Continue after a frame that was solved before."""
        self._sequence = self._continued(state)
        self.moment, self._last = moment, last

    def _continued(self, state):
        rest = self._first.setup.rest
        if self._is_process:
            return solver.FrameSequence(rest, state, forgotten=0.0)
        return solver.FrameSequence(rest, state)

    @property
    def state(self):
        """The end of the last frame."""
        return self._sequence.state

    def parts(self):
        """Yield each object, and its part of the vertices."""
        end = 0
        for one in self.objects:
            begin, end = end, end + one.vertices
            yield one, slice(begin, end)

    def solve(self, share: float = 1.0, *, is_again: bool = False):
        """Solve the present frame of the scene; a generator of a phase of the solver each.

        `share`: of the cubeness. `is_again`: take further steps, even if nothing has changed since
        the last frame. Returns Frames, of all vertices, in the coordinates of their objects. Raises
        CubicCraftError: an object has another number of vertices than in the first frame, or has a
        setting that is invalid.
        """
        unposed, members, moment = self._read(share)
        if self._last is None or moment != self.moment or is_again:
            self._last = yield from self._solve(unposed, members)
            self.moment = moment
        return self._last

    def _read(self, share):
        known = zip(self.objects, self._unposed.pieces, strict=True)
        unposed = [self._in_first_pose(one, member, share) for one, member in known]
        members = list(map(self._posed, self.objects, unposed))
        return unposed, members, _digest([_moment(member) for member in members])

    def _solve(self, unposed, members):
        self._unposed = pipeline.prepare(unposed, [self._unposed])
        posed = self._unposed.posed(placed(members))
        sequence, settings = self._sequence, pipeline.settings_of_all(posed)
        is_first = sequence.state is None
        try:
            stylization = pipeline.stylization_of(
                posed, is_accelerated=is_first or not self._is_process
            )
            run = sequence.begin(stylization, settings.max_iterations, settings.tolerance)
            while run.reason is None:
                yield
                run.advance()
            yield from sequence.settle(run)
            result = sequence.end(run)
            self.is_settled = (
                stylization.displacement <= settings.tolerance * stylization.distance + _STILL
            )
        except CubicCraftError as error:
            raise CubicCraftError(f"{posed.name}: {error}") from error
        found = pipeline.read_back(posed, result.positions, sequence.turns)
        frames = [
            solver.frame_of(member.shape.original, turns, positions)
            for member, (positions, turns) in zip(members, found, strict=True)
        ]
        return solver.Frames(
            *(np.concatenate(parts, axis=1) for parts in zip(*frames, strict=True))
        )

    def _in_first_pose(
        self, one: Animated, known: Member | None = None, share: float = 1.0
    ) -> Member:
        """Return an object as Cubify would read it in the first frame, with the present settings.

        The bones are there in any case, as they can be read in that pose only.
        """
        settings = one.settings(self._overrides, share, self._start)
        read = replace(settings, keep_pose=known is None)
        found = read_member(one.new, read, known, rigged=one.source)
        return replace(found, settings=settings, bones=known.bones if known else found.bones)

    def _posed(self, one: Animated, first: Member) -> Member:
        points, corners = mesh_bridge.read_evaluated_points(one.source)
        if len(points) != first.vertices or corners != one.corners:
            raise CubicCraftError(
                f'"{one.source.name}" has {len(points)} vertices, and had {first.vertices} in the'
                " first frame; only meshes that keep their vertices can be animated"
            )
        if not np.isfinite(points).all():
            raise CubicCraftError(f'"{one.source.name}" has positions that are not finite')
        settings, bones = first.settings, None
        alone, in_world = placements(one.source, settings, is_posed=True)
        if len(self.objects) > 1 and in_world is None:
            raise CubicCraftError(
                f'"{one.source.name}" is scaled flat, and cannot be kept together'
            )
        if settings.keep_pose and first.bones is not None:
            bones = first.bones.in_pose(read_pose(one.source, first.bones.places))
        shape = ShapeRead(points, first.shape.triangles)
        return replace(first, shape=shape, alone=alone, in_world=in_world, bones=bones)


def _moment(member: Member):
    """Return all that the result of a frame depends on."""
    places = member.alone.key, member.in_world and member.in_world.key
    pose = member.bones and member.bones.pose
    return what_matters(member.settings), places, _digest_of_array(member.shape.original), pose


def _digest(values) -> str:
    return hashlib.sha256(repr(values).encode()).hexdigest()


def _digest_of_array(values: np.ndarray) -> str:
    return hashlib.sha256(values.tobytes()).hexdigest()
