# SPDX-License-Identifier: GPL-3.0-or-later
"""Whatever function of the bridge fails: the mesh is as it was, or so after the end of the preview.

The functions are those that run (see `faults`). One of `SHARE` fails, at its first call and at its
last, with ``CUBIC_CRAFT_FAULTS=1`` all of them.
"""

import os
from pathlib import Path

import bpy
import pytest
from faults import failing, places
from previewed import add_monkey, show_some
from results import RESULTS, write
from rich_mesh import cubic_like
from snapshot import STORED, differences, snapshot_object
from world import block_names

SHARE = 1 if os.environ.get("CUBIC_CRAFT_FAULTS") else 6
STATES = ("keys", "cubified keys", "Cubic beside keys")


@pytest.fixture
def check_faults(bridge):
    """Return a function that lets what a call needs fail.

    It is given the state of a monkey, what is done before and what is called, both with the monkey
    and what the former has returned, and for previews what ends them: it returns what may be left.
    """
    folder = str(Path(bridge.__file__).parent)

    def prepared(state, prepare):
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        obj = add_monkey(bridge, state)
        before = snapshot_object(obj), block_names()
        return obj, prepare(obj), before

    def check(state, prepare, call, end=None):
        obj, given, _ = prepared(state, prepare)
        found = places(lambda: call(obj, given), folder, in_operator=False)
        assert len(found) > 10
        obj, given, before = prepared(state, prepare)
        for place, calls in list(found.items())[STATES.index(state) % SHARE :: SHARE]:
            for number in {1, calls}:
                fault = RuntimeError("disk on fire")
                with (
                    failing(place, fault, folder, number, in_operator=False) as raised,
                    pytest.raises(RuntimeError, match="disk on fire"),
                ):
                    call(obj, given)
                assert raised
                left = end(obj) if end else ()
                changed = differences(before[0], snapshot_object(obj), left)
                assert (changed, block_names()) == ([], before[1]), (str(place), number)
                if end:
                    obj, given, before = prepared(state, prepare)

    return check


@pytest.mark.thorough(5)
@pytest.mark.parametrize("state", STATES)
@pytest.mark.parametrize("result", RESULTS)
def test_a_result_that_cannot_be_written_changes_nothing(bridge, check_faults, state, result):
    check_faults(
        state,
        lambda obj: cubic_like(bridge.original_positions(obj.data), 2),
        lambda obj, made: write(bridge, obj, result, *made),
    )


@pytest.mark.parametrize("state", STATES[1:])
@pytest.mark.parametrize("end", ["restore", "discard_original"])
def test_a_result_that_cannot_be_taken_back_stays(bridge, check_faults, state, end):
    check_faults(
        state,
        lambda obj: obj if end == "restore" else obj.data,
        lambda _, given: getattr(bridge, end)(given),
    )


@pytest.mark.parametrize("state", STATES)
def test_a_preview_that_cannot_begin_changes_nothing(bridge, check_faults, state):
    check_faults(state, lambda obj: obj.data, lambda _, mesh: bridge.Preview(mesh))


@pytest.mark.parametrize("state", STATES)
def test_a_preview_that_cannot_be_shown_can_be_ended(bridge, check_faults, state):
    def show(obj, preview):
        preview.show(obj.data, *cubic_like(bridge.original_positions(obj.data), 3))

    def end(obj):
        assert bridge.end_preview(obj.data)
        return ()

    check_faults(state, lambda obj: show_some(bridge, obj.data), show, end)


@pytest.mark.parametrize("state", STATES)
def test_a_preview_that_cannot_be_ended_can_be_ended_again(bridge, check_faults, state):
    def end(obj, _=None):
        was_on = bridge.end_preview(obj.data)
        return () if was_on else STORED  # attributes that nothing tells of any more

    check_faults(state, lambda obj: show_some(bridge, obj.data), end, end)
