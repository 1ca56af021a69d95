# SPDX-License-Identifier: GPL-3.0-or-later
import itertools

import pytest
from pure import load

machine = load("machine")
Action, Event, Machine, State = machine.Action, machine.Event, machine.Machine, machine.State

ENDINGS = (
    Event.CANCEL,
    Event.NOTHING_LEFT,
    Event.LOST,
    Event.MODE_LEFT,
    Event.LOAD,
    Event.CLOSED,
    Event.DISABLED,
    Event.FAILED,
)
RUNNING = [state for state in State if state is not State.ENDED]
PATHS = {
    State.WORKING: (),
    State.IDLE: (Event.DONE,),
    State.FINISHING: (Event.CONFIRM,),
    State.SAVING: (Event.SAVE,),
    State.SAVING_TO_FINISH: (Event.CONFIRM, Event.SAVE),
    State.ENDED: (Event.CANCEL,),
}


def in_state(state):
    m = Machine()
    for event in PATHS[state]:
        m.on(event)
    assert m.state is state
    return m


@pytest.mark.parametrize("event", ENDINGS)
@pytest.mark.parametrize("state", RUNNING)
def test_every_ending_puts_back_first_and_cleans_up_last(state, event):
    m = in_state(state)
    actions = m.on(event)
    assert m.state is State.ENDED
    assert actions[0] is Action.PUT_BACK and actions[-1] is Action.CLEAN_UP
    assert Action.WRITE not in actions


@pytest.mark.parametrize(
    ("event", "word"),
    [(Event.NOTHING_LEFT, "undo"), (Event.MODE_LEFT, "mode"), (Event.LOST, "gone")],
)
@pytest.mark.parametrize("state", RUNNING)
def test_endings_that_nobody_asked_for_are_told(state, event, word):
    m = in_state(state)
    m.on(event)
    told = m.end_message
    assert told.startswith("Live has ended") and word in told
    m.on(Event.CANCEL)
    assert m.end_message == told


@pytest.mark.parametrize("event", [Event.CANCEL, Event.CLOSED, Event.LOAD, Event.DISABLED])
def test_endings_that_were_asked_for_are_not(event):
    m = Machine()
    m.on(event)
    assert m.state is State.ENDED and m.end_message == ""


@pytest.mark.parametrize("event", Event)
def test_nothing_happens_after_the_end(event):
    m = in_state(State.ENDED)
    assert m.on(event) == () and m.state is State.ENDED


def test_confirming_writes_once_when_all_is_done():
    m = Machine()
    assert m.on(Event.CONFIRM) == ()
    assert m.on(Event.DONE) == (Action.PUT_BACK, Action.WRITE, Action.CLEAN_UP)
    assert m.state is State.ENDED


def test_confirming_while_idle_starts_the_timer_that_ends_it():
    m = in_state(State.IDLE)
    assert m.on(Event.CONFIRM) == (Action.START_TIMER,)
    assert Action.WRITE in m.on(Event.DONE)


def test_what_cannot_be_written_goes_on():
    m = in_state(State.FINISHING)
    m.on(Event.REFUSED)
    assert m.state is State.WORKING


def test_saving_shows_the_mesh_as_before_and_goes_on_afterwards():
    for state, then in ((State.WORKING, State.WORKING), (State.FINISHING, State.FINISHING)):
        m = in_state(state)
        assert m.on(Event.SAVE) == (Action.PUT_BACK,)
        assert Action.SHOW_AGAIN in m.on(Event.SAVED)
        assert m.state is then


def test_whatever_happens_the_invariants_hold():
    """Walk all sequences of six events; keep the books of timer and preview."""
    seen = {}
    frontier = [(Machine(), True, True)]  # the timer runs, the preview is on
    for _ in range(6):
        following = []
        for (m, timer, preview), event in itertools.product(frontier, Event):
            copy = Machine()
            copy.state = m.state
            is_on, is_shown, cleaned = timer, preview, 0
            for action in copy.on(event):
                assert not cleaned, "nothing comes after the cleaning up"
                if action is Action.START_TIMER:
                    is_on = True
                elif action is Action.STOP_TIMER:
                    is_on = False
                elif action is Action.PUT_BACK:
                    is_shown = False
                elif action in (Action.SHOW_AGAIN, Action.FOLLOW):
                    is_shown = True
                elif action is Action.RESTART:
                    assert is_on, "a restart needs the timer"
                elif action is Action.WRITE:
                    assert not is_shown, "written on top of the preview"
                elif action is Action.CLEAN_UP:
                    cleaned += 1
                    is_on = False
            if copy.state is State.ENDED:
                assert m.state is State.ENDED or cleaned == 1
                assert not is_on and not is_shown
            elif copy.state in (State.WORKING, State.FINISHING):
                assert is_on and is_shown
            elif copy.state is State.IDLE:
                assert not is_on and is_shown
            else:
                assert not is_shown, "the file is saved without the preview"
            book = (copy.state, is_on, is_shown)
            if book not in seen:
                seen[book] = copy
                following.append((copy, is_on, is_shown))
        frontier = following
    assert {state for state, *_ in seen} == set(State)
