# SPDX-License-Identifier: GPL-3.0-or-later
from pure import load

history = load("history")
History, TakeBack = history.History, history.TakeBack


def test_nothing_done_takes_live_back():
    assert History({"a": 1}).take_back() is TakeBack.LIVE


def test_a_drag_is_taken_back_at_once():
    h = History({"a": 0, "b": 0})
    for step in range(1, 5):
        h.record({"a": step, "b": 0}, now=step * 0.1)
    assert h.take_back() == {"a": 0, "b": 0}
    assert h.take_back() is TakeBack.LIVE


def test_two_drags_are_taken_back_one_by_one():
    h = History({"a": 0, "b": 0})
    h.record({"a": 1, "b": 0}, now=0.0)
    h.record({"a": 2, "b": 0}, now=0.1 + history.PAUSE)
    h.record({"a": 2, "b": 1}, now=0.2 + history.PAUSE)
    assert h.take_back() == {"a": 2, "b": 0}
    assert h.take_back() == {"a": 1, "b": 0}
    assert h.take_back() == {"a": 0, "b": 0}


def test_what_is_taken_back_is_no_change():
    h = History({"a": 0})
    h.record({"a": 1}, now=0.0)
    back = h.take_back()
    h.record(back, now=0.1)
    assert h.take_back() is TakeBack.LIVE


def test_a_moved_handle_is_blenders_to_undo():
    h = History({"a": 0})
    h.record({"a": 1}, now=0.0)
    h.record_outside()
    assert h.take_back() is TakeBack.BLENDER
    h.record({"a": 2}, now=5.0)
    assert h.take_back() == {"a": 1}
    assert h.take_back() is TakeBack.BLENDER


def test_blender_has_undone_all_but_the_start():
    h = History({"a": 0})
    h.record_outside()
    h.record_undo(is_outside=False)
    assert h.take_back() is TakeBack.LIVE
    h.record_undo(is_outside=True)
    assert h.take_back() is TakeBack.BLENDER


def test_after_a_cut_the_next_change_is_a_step_of_its_own():
    h = History({"a": 0})
    h.record({"a": 1}, now=0.0)
    h.cut()
    h.record({"a": 2}, now=0.01)
    h.record({"a": 3}, now=0.02)
    assert h.take_back() == {"a": 1}
    assert h.take_back() == {"a": 0}


def test_a_change_soon_after_a_step_was_taken_back_is_a_step_of_its_own():
    h = History({"a": 0})
    h.record({"a": 1}, now=0.0)
    h.record({"a": 2}, now=2 * history.PAUSE)
    assert h.take_back() == {"a": 1}
    h.record({"a": 3}, now=2.1 * history.PAUSE)
    assert h.take_back() == {"a": 1}
