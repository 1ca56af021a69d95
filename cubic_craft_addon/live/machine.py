# SPDX-License-Identifier: GPL-3.0-or-later
"""What Live does when something happens: a table of states and events, without Blender.

`Machine.on` takes an event and returns the actions to carry out, in order. Every way to end puts
the meshes back before it writes, and cleans up last. Only what the artist cancels, or what fails,
ends without the shape that was seen.
"""

from enum import Enum, auto


class State(Enum):
    """The state of Live."""

    WORKING = auto()
    """the timer runs, the solver iterates"""
    IDLE = auto()
    """nothing to do: no timer, no redraw"""
    FINISHING = auto()
    """confirmed before it had converged: the solver iterates to its end"""
    SAVING = auto()
    """a file is being saved; the meshes are as if Live had been confirmed"""
    SAVING_TO_FINISH = auto()
    """the same, after it was confirmed"""
    ENDED = auto()


class Event(Enum):
    """What happens to Live."""

    WAKE = auto()
    """something in the scene or the panel may have changed"""
    CHANGED = auto()
    """a setting, a handle, the frame or the map has changed"""
    DONE = auto()
    """all runs have come to their end"""
    REFUSED = auto()
    """there is nothing to write"""
    CONFIRM = auto()
    CANCEL = auto()
    NOTHING_LEFT = auto()
    """the artist undoes more than was changed"""
    UNDONE = auto()
    """Blender has undone or redone a step; the data may be anything"""
    LOST = auto()
    """no mesh is left to work on"""
    MODE_LEFT = auto()
    """the artist has switched to a mode in which meshes must not be written"""
    SELECTED = auto()
    """the artist has turned to another mesh"""
    PLACE_LEFT = auto()
    """the artist has turned to another workspace or scene"""
    SAVE = auto()
    SAVED = auto()
    LOAD = auto()
    """another file is about to be loaded"""
    CLOSED = auto()
    """Blender has cancelled the operator, for example because the window was closed"""
    DISABLED = auto()
    """the extension is being disabled"""
    FAILED = auto()
    """an exception"""


class Action(Enum):
    """The responses to an event."""

    START_TIMER = auto()
    STOP_TIMER = auto()
    RESTART = auto()
    """everything that has changed restarts from the original shape"""
    FOLLOW = auto()
    """find the objects again after an undo, and show the preview on them"""
    PUT_BACK = auto()
    """restore the meshes to the bits from before the preview"""
    SHOW_AGAIN = auto()
    """restart the preview after PUT_BACK"""
    COMPLETE = auto()
    """compute to the end, as far as an artist who has gone on can be kept waiting"""
    WRITE = auto()
    """write the results, or the shapes so far, as Cubify does"""
    WRITE_TO_FILE = auto()
    """the same until PUT_BACK: for a file that is being saved"""
    LEAVE_MODE = auto()
    """go to Object Mode if meshes cannot be written in the present one"""
    BACK_TO_MODE = auto()
    """return to the mode that LEAVE_MODE has left"""
    PUSH_UNDO = auto()
    """push the undo step that the operator cannot push any more"""
    CLEAN_UP = auto()
    """remove timer, handlers, status text and references"""


_GIVE_UP = (State.ENDED, (Action.PUT_BACK, Action.CLEAN_UP))
_GO_ON_ELSEWHERE = (
    State.ENDED,
    (
        Action.COMPLETE,
        Action.LEAVE_MODE,
        Action.PUT_BACK,
        Action.WRITE,
        Action.BACK_TO_MODE,
        Action.CLEAN_UP,
    ),
)
_CUT_OFF = (State.ENDED, (Action.PUT_BACK, Action.WRITE, Action.PUSH_UNDO, Action.CLEAN_UP))
_ENDINGS = {
    Event.CANCEL: _GIVE_UP,
    Event.NOTHING_LEFT: _GIVE_UP,
    Event.LOST: _GIVE_UP,
    Event.LOAD: _GIVE_UP,
    Event.FAILED: _GIVE_UP,
    Event.MODE_LEFT: _GO_ON_ELSEWHERE,
    Event.SELECTED: _GO_ON_ELSEWHERE,
    Event.PLACE_LEFT: _GO_ON_ELSEWHERE,
    Event.CLOSED: _CUT_OFF,
    Event.DISABLED: _CUT_OFF,
}

_END_MESSAGES = {
    Event.NOTHING_LEFT: "Live has ended because there was nothing left to undo, and the shape is"
    " as before Live",
    Event.MODE_LEFT: "Live has ended because the mode was changed",
    Event.SELECTED: "Live has ended because another mesh was selected",
    Event.PLACE_LEFT: "Live has ended because another workspace or scene was chosen",
    Event.LOST: "Live has ended because its object is gone from the scene",
}
"""messages about endings that the artist did not request and may not have noticed"""

_AFTER_SAVE = (Action.START_TIMER, Action.PUT_BACK, Action.SHOW_AGAIN)

# What is not in the table changes nothing.
_TABLE = {
    State.WORKING: {
        Event.CHANGED: (State.WORKING, (Action.RESTART,)),
        Event.DONE: (State.IDLE, (Action.STOP_TIMER,)),
        Event.CONFIRM: (State.FINISHING, ()),
        Event.UNDONE: (State.WORKING, (Action.FOLLOW,)),
        Event.SAVE: (State.SAVING, (Action.PUT_BACK, Action.WRITE_TO_FILE)),
        **_ENDINGS,
    },
    State.IDLE: {
        Event.WAKE: (State.WORKING, (Action.START_TIMER,)),
        Event.CHANGED: (State.WORKING, (Action.START_TIMER, Action.RESTART)),
        Event.CONFIRM: (State.FINISHING, (Action.START_TIMER,)),
        Event.UNDONE: (State.WORKING, (Action.START_TIMER, Action.FOLLOW)),
        Event.SAVE: (State.SAVING, (Action.PUT_BACK, Action.WRITE_TO_FILE)),
        **_ENDINGS,
    },
    State.FINISHING: {
        Event.CHANGED: (State.FINISHING, (Action.RESTART,)),
        Event.DONE: (State.ENDED, (Action.PUT_BACK, Action.WRITE, Action.CLEAN_UP)),
        Event.REFUSED: (State.WORKING, ()),
        Event.UNDONE: (State.FINISHING, (Action.FOLLOW,)),
        Event.SAVE: (State.SAVING_TO_FINISH, (Action.PUT_BACK, Action.WRITE_TO_FILE)),
        **_ENDINGS,
    },
    State.SAVING: {
        Event.CONFIRM: (State.SAVING_TO_FINISH, ()),
        Event.SAVED: (State.WORKING, _AFTER_SAVE),
        **_ENDINGS,
    },
    State.SAVING_TO_FINISH: {Event.SAVED: (State.FINISHING, _AFTER_SAVE), **_ENDINGS},
    State.ENDED: {},
}


class Machine:
    """The state of one Live session.

    `end_message`: why it has ended, if the artist must be told.
    """

    def __init__(self):
        self.state = State.WORKING
        self.end_message = ""

    def on(self, event):
        """Process an Event and return a tuple of Actions."""
        before = self.state
        self.state, actions = _TABLE[before].get(event, (before, ()))
        if self.state is State.ENDED and before is not State.ENDED:
            self.end_message = _END_MESSAGES.get(event, "")
        return actions
