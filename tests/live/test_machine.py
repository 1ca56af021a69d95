# SPDX-License-Identifier: GPL-3.0-or-later
import itertools

import pytest
from pure import load

machine = load("machine")
Action, Event, Machine, State = machine.Action, machine.Event, machine.Machine, machine.State

GIVEN_UP = (Event.CANCEL, Event.NOTHING_LEFT, Event.LOST, Event.LOAD, Event.FAILED)
ELSEWHERE = (Event.MODE_LEFT, Event.SELECTED, Event.PLACE_LEFT)
CUT_OFF = (Event.CLOSED, Event.DISABLED)
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


@pytest.mark.parametrize("event", [*GIVEN_UP, *ELSEWHERE, *CUT_OFF])
@pytest.mark.parametrize("state", RUNNING)
def test_only_what_is_given_up_ends_without_the_shape_that_was_seen(state, event):
    m = in_state(state)
    actions = m.on(event)
    assert m.state is State.ENDED
    assert actions[-1] is Action.CLEAN_UP
    assert (Action.WRITE in actions) == (event not in GIVEN_UP)


@pytest.mark.parametrize("event", ELSEWHERE)
def test_a_mode_is_left_for_as_long_as_is_written(event):
    actions = Machine().on(event)
    order = [Action.LEAVE_MODE, Action.PUT_BACK, Action.WRITE, Action.BACK_TO_MODE]
    assert [action for action in actions if action in order] == order


@pytest.mark.parametrize(
    ("event", "word"),
    [
        (Event.NOTHING_LEFT, "undo"),
        (Event.MODE_LEFT, "mode"),
        (Event.SELECTED, "another mesh"),
        (Event.PLACE_LEFT, "workspace"),
        (Event.LOST, "gone"),
    ],
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


@pytest.mark.parametrize("state", [State.WORKING, State.FINISHING])
def test_a_file_has_what_is_seen_and_live_goes_on_as_if_it_had_not(state):
    m = in_state(state)
    assert m.on(Event.SAVE) == (Action.PUT_BACK, Action.WRITE_TO_FILE)
    actions = m.on(Event.SAVED)
    assert actions[-2:] == (Action.PUT_BACK, Action.SHOW_AGAIN)
    assert m.state is state


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
                elif action in (Action.WRITE, Action.WRITE_TO_FILE):
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
