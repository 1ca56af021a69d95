# SPDX-License-Identifier: GPL-3.0-or-later
"""Where handles are marked while Live does not run; the rings are seen in a window."""

from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from mathutils import Matrix
from posing import LEFT, RIGHT, add_posable, follow, pin
from rich_mesh import position_of
from scene import add_monkey, cubify


@pytest.fixture
def marks(part):
    module = part("handles.overlay")
    yield module
    module.middles.forget()


def middle(points):
    return (points.min(axis=0) + points.max(axis=0)) / 2


def viewport(*, overlays=True):
    """Return a context of a viewport."""
    view = SimpleNamespace(overlay=SimpleNamespace(show_overlays=overlays), type="VIEW_3D")
    return SimpleNamespace(
        space_data=view,
        mode=bpy.context.mode,
        active_object=bpy.context.active_object,
        view_layer=bpy.context.view_layer,
    )


@pytest.fixture
def is_marked(marks, monkeypatch):
    """Return a function that says whether the handles of the active object are to be drawn."""
    monkeypatch.setattr(marks, "panel_object", lambda context: _Visible(context.active_object))
    return lambda **view: marks.marked_object(viewport(**view)) is not None


class _Visible:
    """An object that is visible in all viewports, of which there is none to ask about."""

    def __init__(self, obj):
        self._obj = obj

    def __getattr__(self, name):
        return getattr(self._obj, name)

    def visible_in_viewport_get(self, _view):
        return True


def test_each_handle_is_marked_in_the_middle_of_its_part_as_it_is_seen(marks):
    obj, left, right = add_posable()
    pin(obj, LEFT)
    pin(obj, RIGHT).pose = Matrix.Translation((0.5, 0.0, 0.0))
    places = []
    for _ in range(2):
        now = position_of(obj.data)
        found = marks.middles_of(obj)
        assert list(found) == [0, 1]
        for number, part in enumerate((left, right)):
            np.testing.assert_allclose(found[number], middle(now[part]), atol=1e-6)
        places.append(found[1])
        cubify(max_iterations=2)
    np.testing.assert_allclose(places[1] - places[0], (0.5, 0.0, 0.0), atol=1e-5)


def test_what_follows_an_object_is_marked_by_that(marks):
    obj, _, _ = add_posable()
    pin(obj, LEFT)
    follow(obj, RIGHT)
    assert list(marks.middles_of(obj)) == [0]
    obj.vertex_groups.remove(obj.vertex_groups[LEFT])
    assert marks.middles_of(obj) == {}


def test_they_are_found_after_a_pause_and_forgotten_when_the_mesh_changes(marks):
    obj, _, _ = add_posable()
    pin(obj, LEFT)
    assert marks.middles.now(obj) is None
    assert marks.middles.is_waiting
    marks.middles.find(obj.session_uid)
    np.testing.assert_array_equal(marks.middles.now(obj)[0], marks.middles_of(obj)[0])
    obj.location.x += 1
    bpy.context.view_layer.update()
    assert marks.middles.now(obj), "they are in object space"
    cubify(max_iterations=2)
    assert marks.middles.now(obj) is None
    marks.middles.find(obj.session_uid)
    assert marks.middles.now(obj)
    pin(obj, RIGHT)
    assert marks.middles.now(obj) is None, "the list is another one"
    asked_for = marks.middles._waiting
    marks.middles.forget()
    assert not bpy.app.timers.is_registered(asked_for)


def test_they_are_there_only_in_object_mode_without_live(is_marked, begin, live):
    obj, _, _ = add_posable()
    pin(obj, LEFT)
    assert is_marked() and not is_marked(overlays=False)
    obj.cubic_craft.use_handles = False
    assert not is_marked()
    obj.cubic_craft.use_handles = True
    session = begin(obj)
    assert not is_marked()
    session.on(live.Event.CANCEL)
    assert is_marked()
    bpy.ops.object.mode_set(mode="EDIT")
    try:
        assert not is_marked()
    finally:
        bpy.ops.object.mode_set(mode="OBJECT")


def test_nothing_is_found_of_what_is_gone(marks):
    obj = add_monkey()
    uid = obj.session_uid
    bpy.data.objects.remove(obj)
    marks.middles.find(uid)
    assert not marks.middles.uids
