# SPDX-License-Identifier: GPL-3.0-or-later
"""The work of one Cubify Animation, step by step.

Nothing is changed before the end but the current frame, which comes back, and the files in the
folder. When it is stopped, the frames that are done are kept, and the next bake continues there.
"""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

import time
from collections.abc import Generator, Sequence
from dataclasses import dataclass

import bpy

from ... import solver
from ...solver import CubicCraftError
from ...solver.pieces.placement import Placement
from .. import mesh_bridge
from ..job.job import Step
from ..read.member import assemblies
from ..read.object_frame import placements
from ..send.targets import check_exporter
from ..settings.values import Settings
from .animated import Animated, AnimatedGroup, FrameSettings
from .places import BakeOptions, BakeResult, Places
from .playback import SUFFIXES, play, shown, stretch
from .point_cache import new_point_cache
from .recording import Recording
from .sources import OF_ALL_FRAMES, animated_settings

_SAVED_EVERY = 10.0  # seconds


@dataclass
class _Work:
    """A group, and what is there of its frames."""

    group: AnimatedGroup
    recording: Recording


@dataclass(frozen=True)
class _Item:
    """An object, for `assemblies`."""

    one: Animated
    settings: Settings
    in_world: Placement | None


class Bake:
    """Objects whose frames are to be cubified, as a job of `WatchedJob`.

    `sources`: the active one first. `baked`, `results`: lists of what was written. Raises
    CubicCraftError: there are no frames, a source is not evaluated or has keyframes that cannot be
    used, or the format or the folder cannot be used.
    """

    cancel_text = "Stop, and Keep the Frames"

    def __init__(
        self, settings_for: FrameSettings, sources: Sequence[bpy.types.Object], options: BakeOptions
    ):
        if not options.frames:
            raise CubicCraftError("the last frame comes before the first; change the range")
        check_exporter(SUFFIXES[options.file_format])
        self._stretch = stretch()
        self._places = Places(options)
        self._settings_for, self._sources, self._options = settings_for, sources, options
        self._problems: list[str] = []
        self._made: list[Animated] = []
        self._works: list[_Work] = []
        self._is_stopped = False
        self.baked: list[bpy.types.Object] = []
        self.results: list[BakeResult] = []
        self._next_save = 0.0
        self._begin = time.perf_counter()
        self._scene = bpy.context.scene
        self._frame = self._scene.frame_current, self._scene.frame_subframe
        self._hidden = [source for source in sources if source.hide_get()]
        for source in self._hidden:  # or it would not be evaluated
            source.hide_set(False)
        try:
            self._check_sources()
        except CubicCraftError:
            self._restore_scene()
            raise

    def _check_sources(self):
        """Refuse before the first frame what would go wrong in a later one."""
        for source in self._sources:
            if not source.visible_get():  # Blender does not evaluate it
                raise CubicCraftError(
                    f'"{source.name}" or its collection is disabled or excluded; enable it, so that'
                    " its frames can be seen"
                )
            animated = animated_settings(source)
            refused = [animated[name] for name in OF_ALL_FRAMES if name in animated]
            if refused:
                raise CubicCraftError(
                    f'"{source.name}": {" and ".join(refused)} cannot be animated, as the same'
                    " vertices are solved in all frames; remove the keyframes or drivers"
                )

    # -- solving -----------------------------------------------------------------------------------

    def steps(self) -> Generator[Step]:
        """Solve all frames; each turn does a phase of the solver."""
        yield Step(("Preparing",), 0.0, is_long=True)
        self._prepare()
        known = min((work.recording.count for work in self._works), default=0)
        numbers = range(known, len(self._options.frames))
        begin = time.perf_counter()
        for done, number in enumerate(numbers):
            if self._is_stopped or not self._works:
                break
            frame = self._options.frames[number]
            self._scene.frame_set(frame)
            texts = self._texts(frame, done, len(numbers), begin)
            try:
                for work in self._works:
                    if work.recording.count <= number:
                        yield from self._solve(work, texts)
            except CubicCraftError as error:
                self._problems.append(f"Frame {frame}: {error}")
                break
            if time.perf_counter() > self._next_save:
                self._save()

    def _prepare(self):
        self._scene.frame_set(self._options.start)
        for source in self._sources:
            try:
                self._made.append(Animated(source, mesh_bridge.make_seen(source)))
            except CubicCraftError as error:
                self._problems.append(str(error))
        items = []
        for one in self._made:
            settings = one.settings(self._settings_for)
            items.append(_Item(one, settings, placements(one.source, settings, is_posed=True)[1]))
        for group in assemblies(items):
            try:
                self._works.append(self._work([item.one for item in group]))
            except CubicCraftError as error:
                self._problems.append(str(error))

    def _work(self, objects):
        group = AnimatedGroup(objects, self._settings_for)
        path = self._places.recording_of(objects[0].source)
        about = {**group.about, "start": self._options.start, "stretch": self._stretch}
        recording = Recording(path, about, group.vertices)
        if recording.state is not None:
            group.continue_from(recording.state, recording.moment, recording.last())
        return _Work(group, recording)

    def _solve(self, work, texts):
        frame = yield from self._solved(work.group.solve(), texts)
        work.recording.append(frame, work.group.state, work.group.moment)
        yield Step(texts, self._factor)

    def _solved(self, solving, texts) -> Generator[Step, None, solver.Frames]:
        while True:
            try:
                next(solving)
            except StopIteration as end:
                return end.value
            yield Step(texts, self._factor)

    @property
    def _factor(self):
        count = min(work.recording.count for work in self._works)
        return min(count / max(len(self._options.frames), 1), 1.0)

    def _texts(self, frame, done, count, begin):
        short = f"Frame {frame} of {self._options.end}"
        if not done:
            return (short,)
        left = (time.perf_counter() - begin) / done * (count - done)
        return f"{short}, {_duration(left)} left", short

    def stop(self) -> bool:
        """End after the frame that is being solved, and return True."""
        self._is_stopped = True
        return True

    # -- writing -----------------------------------------------------------------------------------

    def write(self, *, is_alone: bool) -> tuple[str, list[str]]:
        """Write the files of what is solved, and make objects that play them back.

        Returns `summary`: str; `problems`: list of str. Raises CubicCraftError: no frame was
        solved; the message lists all problems.
        """
        self._restore_scene()
        self._save()
        works = [work for work in self._works if work.recording.count]
        if not works:
            raise CubicCraftError("; ".join(self._problems) or "no frame was baked")
        names = [self._write(work) for work in works]
        return self._summary(works, [name for more in names for name in more]), self._problems

    def _write(self, work):
        recording, names = work.recording, []
        width, ratios = self._smoothing(work)
        frames = recording.count
        for one, vertices in work.group.parts():
            cache, path = self._places.files_of(one.source, recording.folder)
            with new_point_cache(cache, frames, one.vertices) as positions:
                for columns, piece in recording.pieces(vertices):
                    positions[:, columns] = piece.results(width)
            self._made.remove(one)
            with shown(one.source, one.new, cache) as baked:
                options = self._options
                names.append(play(baked, cache, path, options.file_format, options.start))
            self.baked.append(baked)
            self.results.append(
                BakeResult(one.source.name, frames, width, *(round(x, 4) for x in ratios))
            )
        if frames == len(self._options.frames):
            recording.remove()
        return names

    def _smoothing(self, work):
        """Return over how many frames to smooth, and how far vertices jump then."""

        def everything():
            return (piece for _, piece in work.recording.pieces(slice(0, work.group.vertices)))

        width, ratios = solver.least_width(everything)
        if max(ratios) > solver.MOST_JUMPS:
            self._problems.append(
                f"{work.group.name} jumps up to {max(ratios):.1f} times as far as the original,"
                " even smoothed; a lower cubeness is steadier"
            )
        return width, ratios

    def _summary(self, works, names):
        count = min(result.frames for result in self.results)
        frames = self._options.frames
        what = names[0] if len(names) == 1 else f"{len(names)} objects"
        seconds = time.perf_counter() - self._begin
        if count == len(frames):
            return f"Cubified {count} frames to {what} in {_duration(seconds)}"
        last = frames[count - 1]
        return f"Frames {frames[0]} to {last} of {frames[-1]} are in {what}; bake again to continue"

    def _save(self):
        self._next_save = time.perf_counter() + _SAVED_EVERY
        for work in self._works:
            work.recording.save_state()

    # -- ending ------------------------------------------------------------------------------------

    @property
    def obstacle(self) -> str:
        """Why it cannot continue after other code has run; or empty."""
        try:
            if not all(source.users_scene for source in self._sources):
                return "an object was deleted"
            for one in self._made:
                one.new.name  # noqa: B018 - raises where Blender has removed it
        except ReferenceError:
            return "an object was deleted"
        return ""

    def discard(self) -> None:
        """Keep what is needed to continue, remove all else, and let other bakes have the files."""
        try:
            self._save()
        finally:
            for work in self._works:
                work.recording.release()
            self._works.clear()
        for one in self._made:
            try:
                mesh_bridge.remove_copy(one.new)
            except ReferenceError:
                continue
        self._made.clear()
        self._restore_scene()

    def _restore_scene(self):
        """Go back to the frame that was shown, and hide what was hidden; once."""
        if self._frame is None:
            return
        try:
            self._scene.frame_set(self._frame[0], subframe=self._frame[1])
            for source in self._hidden:
                source.hide_set(True)
        except ReferenceError:
            pass
        self._frame = None


def _duration(seconds: float) -> str:
    if seconds < 90.0:
        return f"{seconds:.0f} s"
    minutes = round(seconds / 60.0)
    return f"{minutes} min" if minutes < 90 else f"{minutes / 60:.1f} h"
