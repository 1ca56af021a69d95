# SPDX-License-Identifier: GPL-3.0-or-later
"""One Live session: it carries out what the state machine says.

Nothing of Blender's data is kept between two calls, because undo, delete and load free it.
"""

import logging
import time
from collections.abc import Callable

import bpy

from ...solver import CubicCraftError
from .. import mesh_bridge
from ..environment.modes import MODES
from ..handles.pose import rebase_edited_handles
from ..object_properties import object_properties
from ..screen.redraw import draw_status, redraw_panels, waiting
from ..settings.overrides import ALL
from . import elsewhere, handlers, meshes, poses, properties
from .followed_mesh import FollowedMesh
from .follower import remove_left
from .handlers import UndoSteps
from .history import History, TakeBack
from .live_mesh import LiveMesh, take_along
from .live_runs import Following, LiveRuns
from .machine import Action, Event, Machine, State
from .plan import Plan
from .slices import Slices
from .written import Written

_log = logging.getLogger(__name__)

_TIMER_STEP = 0.01  # seconds between two ticks, in which Blender draws and handles events
_PANEL_STEP = 0.1  # seconds between two redraws of the panel
_CHECK_SHARE = 0.1  # largest share of the time for checking whether anything has changed
_LEAST_LIFE = 0.1  # seconds of a run while settings are dragged
_CONFIRM = "Confirm Live", "EVENT_RETURN"
_PATIENCE = 2.0  # seconds for which an artist who has gone on to something else is kept waiting


class Session:
    """A running Live operator.

    `context`: of the window that the operator runs in. `objects`: the active one first. Raises
    CubicCraftError: none of them can be used; nothing has changed then.

    Its `meshes` are LiveMesh, `is_dragged` returns whether a handle is being dragged in the
    viewport, and `error` says why it has ended by itself.
    """

    def __init__(self, context: bpy.types.Context, objects: list[bpy.types.Object]):
        self._machine = Machine()
        self._window = context.window
        self._place = elsewhere.place_of(context)
        self._object_uids = [obj.session_uid for obj in objects]
        self._timer = None
        self._next_check = self._next_panel = self._last_restart = self._last_tick = 0.0
        self.is_dragged: Callable[[], bool] = lambda: False
        self._has_written = self._may_be_painted = self._is_undone = self._is_reported = False
        self._slices = Slices()
        self.touch()
        self._undo_steps = UndoSteps()
        self.written = Written()
        self.error = ""
        rebase_edited_handles(objects, lambda obj: object_properties(obj).start)
        properties.adopt(objects[0])
        self._own = self._values = properties.live_values()
        self._history = History(self._values)
        self._runs = LiveRuns()
        self._following = Following(self._runs)
        self._plan = Plan()
        self._plan.renew(objects)
        self.meshes: list[LiveMesh] = meshes.meshes_for(self._plan.tasks.values())
        self._restart_changed()
        if not self._runs.is_working:
            raise CubicCraftError("; ".join(self.all_problems))
        again = properties.recall(self._object_uids, self._own)
        if again is not None:
            properties.set_live_values(again)  # seen by the first tick, and undone by Ctrl-Z
        try:
            self._show_again()
            handlers.install(self)
            # Blender wants a function, and takes no method.
            draw_status(lambda header, _context: self._draw_keys(header))
            self._start_timer()
        except Exception:
            self._put_back()
            self._clean_up()
            raise

    # -- for the operator, the panel and the handlers ----------------------------------------------

    @property
    def is_ended(self):
        """Whether nothing is left to do."""
        return self._machine.state is State.ENDED

    @property
    def end_message(self):
        """The message about the end of the session, besides `error`."""
        return self._machine.end_message

    @property
    def is_finishing(self):
        """Whether it has been confirmed and is finishing."""
        return self._machine.state is State.FINISHING

    @property
    def is_single(self):
        """Whether one object is live, whose vertex groups are then settings of Live."""
        return len(self._object_uids) == 1

    @property
    def all_problems(self):
        """What is wrong with the settings or the objects, as texts."""
        return self._plan.problems + self._runs.problems

    @property
    def tasks(self):
        """The current runs, that of the active object first; valid only within one event."""
        return list(self._plan.tasks.values())

    @property
    def mesh_uids(self):
        """``session_uid`` of all meshes of the session."""
        return {mesh.mesh_uid for mesh in self.meshes}

    @property
    def shown_uids(self):
        """``session_uid`` of the meshes of followers, which only Live changes."""
        return {mesh.shown_uid for mesh in self.meshes} - {0}

    @property
    def is_following(self):
        """Whether followers show the results, and the originals can be worked on."""
        return any(isinstance(mesh, FollowedMesh) for mesh in self.meshes)

    def first_object(self, context: bpy.types.Context) -> bpy.types.Object | None:
        """Return the object whose settings are those of Live, or the next that is left."""
        return next(iter(self._objects(context).values()), None)

    def mesh_of(self, obj: bpy.types.Object) -> LiveMesh | None:
        """Return the run of an object, or of the mesh that it shares."""
        return meshes.mesh_of(self.meshes, obj)

    def on(self, event: Event) -> None:
        """Process an event and carry out the actions of the state machine."""
        if event is Event.CANCEL:
            properties.remember(self._object_uids, self._own, properties.live_values())
        for action in self._machine.on(event):
            try:
                _METHODS[action](self)
            except Exception as error:
                # The remaining actions must still be done, above all the cleanup.
                _log.exception("Live has failed in %s", action)
                self.error = f"Live has ended because of an error: {error}"
        if self.error and not self.is_ended:
            self.on(Event.FAILED)

    def touch(self) -> None:
        """Record that the artist does something, between whose events there is no long wait."""
        self._slices.touch(time.perf_counter())

    def wake(self) -> None:
        """Make the next tick check whether anything has changed."""
        self.touch()
        self._next_check = 0.0
        self.on(Event.WAKE)

    def on_mesh_update(self) -> None:
        """Record that Blender has re-evaluated a mesh of the session."""
        if self._has_written:
            self._has_written = False
        else:
            self._may_be_painted = self._is_reported = True
            self.wake()

    def on_object_update(self) -> None:
        """Record that Blender has re-evaluated an object of the session, or the frame."""
        self._may_be_painted |= self.is_following
        self.wake()

    def on_undo(self) -> None:
        """Record that Blender has undone or redone a step."""
        # Undo steps from before Live have no preview on their meshes; those pushed since do.
        has_preview = meshes.has_preview(self.meshes, self._objects(bpy.context))
        self._history.record_undo(has_preview)
        self._is_undone = True
        self.on(Event.UNDONE)

    def begin_drag(self, is_dragged: Callable[[], bool]) -> None:
        """Record that a handle is being dragged, for as long as the function returns true.

        This is one change to undo, however long it takes and however soon another follows.
        """
        self._history.record(properties.live_values(), time.perf_counter())
        self._history.cut()
        self.is_dragged = is_dragged

    def take_back(self) -> bool:
        """Undo a change of Live; return false if Blender is to undo its last step instead."""
        self._undo_steps.tell(self._history)
        self._history.record(properties.live_values(), time.perf_counter())
        earlier = self._history.take_back()
        if earlier is TakeBack.BLENDER:
            return False
        if earlier is TakeBack.LIVE:
            self.on(Event.NOTHING_LEFT)
        else:
            properties.set_live_values(earlier)
        return True

    def look_around(self, context: bpy.types.Context) -> None:
        """End if the artist has turned to another workspace or scene."""
        workspace, scene = elsewhere.place_of(context)
        if self.is_following:
            workspace = self._place[0]  # another one is made for sculpting, for example
        if (workspace, scene) != self._place:
            self.on(Event.PLACE_LEFT)

    def tick(self, context: bpy.types.Context) -> None:
        """Check whether anything has changed, compute for a time slice, and show the result."""
        try:
            self._tick(self._objects(context))
        except Exception as error:
            _log.exception("Live has failed")
            self.error = f"Live has ended because of an error: {error}"
            self.on(Event.FAILED)
        self._last_tick = time.perf_counter()

    def tick_in_drag(self, context: bpy.types.Context) -> None:
        """Tick as the timer would: during a drag, its events cannot be told from others."""
        if self._timer is not None and time.perf_counter() - self._last_tick >= _TIMER_STEP:
            self.tick(context)

    def _tick(self, objects):
        self.meshes = meshes.still_there(self.meshes, objects)
        followers = [obj for mesh in self.meshes if (obj := mesh.follower()) is not None]
        if not self.meshes:
            self.on(Event.LOST)
        elif not followers and any(obj.mode not in MODES for obj in objects.values()):
            self.on(Event.MODE_LEFT)
        elif elsewhere.is_another_mesh_active([*objects.values(), *followers]):
            self.on(Event.SELECTED)
        if self.is_ended:
            return
        if take_along(self.meshes, objects):
            self.on(Event.UNDONE)  # as if something else had set other shapes
            return
        begin = time.perf_counter()
        if begin >= self._next_check:
            self._check(list(objects.values()), begin)
            now = time.perf_counter()
            self._next_check = now + (now - begin) / _CHECK_SHARE
        if self._window is not None and len(self._window.modal_operators) > 1:
            self.touch()  # the view is orbited, or a stroke drawn: Live sees none of their events
        begin = time.perf_counter()
        self._runs.advance(begin + self._slices.begin(begin))
        self._slices.end(time.perf_counter())
        # Not at rest before Blender has evaluated what was shown: a stroke could go unnoticed.
        is_new = self._show(objects)
        is_working = self._runs.is_working or self._following.is_waiting or is_new
        if is_working or self._is_changed_at_rest(list(objects.values())):
            if begin >= self._next_panel:
                self._next_panel = begin + _PANEL_STEP
                redraw_panels()
            return
        if self.is_finishing and not any(mesh.solution for mesh in self.meshes):
            self.on(Event.REFUSED)
        self._has_written = False
        self.on(Event.DONE)
        redraw_panels()

    def _check(self, objects, now):
        """Restart the runs whose settings or weights have changed."""
        values = properties.live_values()
        self._undo_steps.tell(self._history)
        if not self.is_dragged():
            self._history.record(values, now)
        self._plan.renew(objects)
        if self._may_be_painted and self.is_following:
            there = {obj.session_uid: obj for obj in objects}
            self._following.look(self.meshes, there, now, is_reported=self._is_reported)
            self._is_reported = False
        is_changed = self._runs.is_changed(self._plan.groups)
        if self._is_too_young(now):
            return
        if is_changed:
            self.on(Event.CHANGED)
        if self._following.is_waiting:
            self._follow_originals(now)
        elif self._may_be_painted and self._plan.has_weights_at_hand:
            self._may_be_painted = False
            is_changed |= self._runs.restart_painted(self._plan.groups, self.meshes)
        if is_changed:
            self._last_restart = now
            # The first check after an undo still finds changes: frames had not been evaluated.
            if values == self._values and not self._is_undone:
                self._history.record_outside()
            self._values = values
        self._is_undone = False

    def _follow_originals(self, now, *, is_hurried=False):
        is_hurried |= self.is_finishing
        if self._following.work(self._plan.groups, self.meshes, now, is_hurried=is_hurried):
            self._may_be_painted = False
            self._history.record_outside()
            self._has_written |= self._plan.is_of_edit_mode

    def _is_too_young(self, now):
        """Return whether the runs have yet to be shown; otherwise a drag would show nothing."""
        working = [mesh for mesh in self.meshes if mesh.run.is_working]
        is_seen = all(mesh.is_seen for mesh in working)
        return working and not (is_seen and now - self._last_restart >= _LEAST_LIFE)

    def _restart_changed(self):
        meshes.suit(self.meshes, self._plan)
        self._runs.restart_changed(self._plan.groups, self.meshes)
        if self.is_following:
            self._has_written |= self._plan.is_of_edit_mode

    def _is_changed_at_rest(self, objects):
        """Check a last time: the confirmed shape must match the settings.

        Changes may have waited for the run to be shown, and strokes may have gone unnoticed while
        Live itself changed the mesh.
        """
        self._may_be_painted = True
        self._check(objects, time.perf_counter())
        return self._runs.is_working

    def _show(self, objects):
        values = {name: self._values[name] for name in ALL}
        if self.is_finishing:
            for mesh in self.meshes:
                mesh.arrive()
        shown = [mesh.show(objects[mesh.object_uid], values) for mesh in self.meshes]
        self._has_written |= any(shown) and not self.is_following  # followers are not looked at
        return any(shown)

    # -- actions of the state machine --------------------------------------------------------------

    def _follow(self):
        """Continue with meshes after an undo or redo, which may have another shape now."""
        self._put_back()
        self._plan_anew()
        is_left = any(task.obj.mode not in MODES for task in self._plan.tasks.values())
        if is_left and not self.is_following:
            return  # the next tick ends it
        for mesh, task in self._plan.pairs(self.meshes):
            mesh.follow(task)
        if self.is_following:
            self._may_be_painted = True
        else:
            self._runs.restart_painted(self._plan.groups, self.meshes)
        if self._runs.is_changed(self._plan.groups):
            self._restart_changed()
        meshes.begin_previews(self.meshes, self._plan)

    def _show_again(self):
        self._plan_anew()
        meshes.begin_previews(self.meshes, self._plan)

    def _complete(self):
        with waiting(self._window):
            if self._following.is_waiting:
                self._follow_originals(time.perf_counter(), is_hurried=True)
            self._runs.complete(_PATIENCE)

    def _leave_mode(self):
        self.written.leave_mode([*self._objects(bpy.context).values()])

    def _write(self):
        self._plan_anew()
        self.written.write(self._plan, self.meshes, self.all_problems)

    def _write_to_file(self):
        self._plan_anew()
        self.written.write_to_file(self._plan, self.meshes)

    def _start_timer(self):
        if self._timer is None:
            manager = bpy.context.window_manager
            self._timer = manager.event_timer_add(_TIMER_STEP, window=self._window)

    def _stop_timer(self):
        if self._timer is not None:
            bpy.context.window_manager.event_timer_remove(self._timer)
            self._timer = None

    def _put_back(self):
        self.written.out_of_file()
        take_along(self.meshes, self._objects(bpy.context))
        remove_left({mesh.follower_uid for mesh in self.meshes})
        # On all meshes: a preview may have been copied, or left on a mesh that was removed.
        mesh_bridge.end_all_previews()

    def _clean_up(self):
        self._stop_timer()
        handlers.remove()
        draw_status(None)
        poses.set_live_poses({})
        self._plan.release()
        self._runs.release()
        for mesh in self.meshes:
            mesh.discard()
            mesh.release()
        redraw_panels()

    def _draw_keys(self, header):
        first = ("Live is finishing", "NONE") if self.is_finishing else _CONFIRM
        for text, icon in (first, ("Cancel", "EVENT_ESC"), ("", "EVENT_CTRL"), ("Undo", "EVENT_Z")):
            header.layout.label(text=text, icon=icon)

    def _objects(self, context):
        """Return the objects that still exist, by ``session_uid``, the active one first."""
        uids = set(self._object_uids)
        # It contains None if a script has just removed an object.
        there = [obj for obj in elsewhere.objects_of(context, self._place) if obj is not None]
        found = {obj.session_uid: obj for obj in there if obj.session_uid in uids}
        known = {mesh.object_uid: mesh.mesh_uid for mesh in self.meshes}
        return {
            uid: found[uid]
            for uid in self._object_uids
            if uid in found and known.get(uid) in (None, found[uid].data.session_uid)
        }

    def _plan_anew(self):
        self._plan.renew(list(self._objects(bpy.context).values()))


_METHODS = {
    Action.START_TIMER: Session._start_timer,
    Action.STOP_TIMER: Session._stop_timer,
    Action.RESTART: Session._restart_changed,
    Action.FOLLOW: Session._follow,
    Action.PUT_BACK: Session._put_back,
    Action.SHOW_AGAIN: Session._show_again,
    Action.COMPLETE: Session._complete,
    Action.WRITE: Session._write,
    Action.WRITE_TO_FILE: Session._write_to_file,
    Action.LEAVE_MODE: Session._leave_mode,
    Action.BACK_TO_MODE: lambda session: session.written.back_to_mode(),
    Action.PUSH_UNDO: lambda session: session.written.push_undo(),
    Action.CLEAN_UP: Session._clean_up,
}
