# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects that are solved together, frame by frame."""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import hashlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

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

FrameSettings = Callable[[bpy.types.Object], Settings]
"""gives the settings with which an object is to be cubified in the present frame"""


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

    def settings(self, settings_for: FrameSettings) -> Settings:
        """Return the settings in this frame."""
        owner = self.source if self.source.type == "MESH" else self.new
        return replace(settings_for(owner), **IN_ANIMATION)


class AnimatedGroup:
    """Objects that are solved together.

    Raises CubicCraftError: they cannot be solved.
    """

    def __init__(self, objects: Sequence[Animated], settings_for: FrameSettings):
        self.objects, self._settings_for = objects, settings_for
        self._first = pipeline.prepare([self._in_first_pose(one) for one in objects])
        self._unposed = self._first
        self._sequence = solver.FrameSequence(self._first.setup.rest)
        self.moment = ""
        """what the last frame depended on"""
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
        return {
            "objects": [one.source.name for one in self.objects],
            "first": _digest(
                [(_moment(member), _digest_of_array(member.shape.triangles)) for member in members]
            ),
        }

    def continue_from(self, state: solver.SequenceState, moment: str, last: solver.Frames) -> None:
        """Continue after a frame that was solved before."""
        self._sequence = solver.FrameSequence(self._first.setup.rest, state)
        self.moment, self._last = moment, last

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

    def solve(self):
        """Solve the present frame of the scene; a generator of a phase of the solver each.

        Returns Frames, of all vertices, in the coordinates of their objects. Raises
        CubicCraftError: an object has another number of vertices than in the first frame, or has a
        setting that is invalid.
        """
        unposed, members, moment = self._read()
        if self._last is None or moment != self.moment:
            self._last = yield from self._solve(unposed, members)
            self.moment = moment
        return self._last

    def _read(self):
        known = zip(self.objects, self._unposed.pieces, strict=True)
        unposed = [self._in_first_pose(one, member) for one, member in known]
        members = list(map(self._posed, self.objects, unposed))
        return unposed, members, _digest([_moment(member) for member in members])

    def _solve(self, unposed, members):
        self._unposed = pipeline.prepare(unposed, [self._unposed])
        posed = self._unposed.posed(placed(members))
        sequence, settings = self._sequence, pipeline.settings_of_all(posed)
        try:
            stylization = pipeline.stylization_of(posed)
            run = sequence.begin(stylization, settings.max_iterations, settings.tolerance)
            while run.reason is None:
                yield
                run.advance()
            yield from sequence.settle(run)
            result = sequence.end(run)
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

    def _in_first_pose(self, one: Animated, known: Member | None = None) -> Member:
        """Return an object as Cubify would read it in the first frame, with the present settings.

        The bones are there in any case, as they can be read in that pose only.
        """
        settings = one.settings(self._settings_for)
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
