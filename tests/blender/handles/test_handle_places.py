# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the handles can be grabbed while Live runs; dragging them is tested in a window."""

import importlib

import bpy
import numpy as np
import pytest
from live_steps import tick_to_rest
from mathutils import Matrix
from posing import LEFT, RIGHT, add_posable, follow, mapped, pin
from rich_mesh import position_of
from scene import select

BENT = Matrix.LocRotScale((0.4, -0.2, 0.5), Matrix.Rotation(0.6, 3, "Y"), (1.2, 0.8, 1.5))
THERE = {"location": (5, -3, 2), "rotation_euler": (0.4, 1.2, -2.0)}


@pytest.fixture
def places(extension):
    """Return the module of the installed extension."""
    name = f"{extension.__name__}.cubic_craft_addon.handles.gizmos.places"
    return importlib.import_module(name)


def middle(points):
    return (points.min(axis=0) + points.max(axis=0)) / 2


def add_pinned(**where):
    obj, left, right = add_posable(**where)
    pin(obj, LEFT)
    pin(obj, RIGHT)
    return obj, left, right


def test_each_handle_is_grabbed_in_the_middle_of_its_part(places, live, begin):
    obj, left, right = add_pinned(**THERE)
    rest = position_of(obj.data)
    obj.cubic_craft.handles[1].pose = BENT
    tick_to_rest(begin(obj))
    one, other = places.places_of(obj)
    assert (one.number, other.number) == (0, 1)
    world = np.array(obj.matrix_world)
    np.testing.assert_allclose(
        one.center_in_world, mapped(middle(rest[left])[None], world)[0], atol=1e-5
    )
    posed = mapped(middle(rest[right])[None], np.array(obj.matrix_world @ BENT))[0]
    np.testing.assert_allclose(other.center_in_world, posed, atol=1e-5)
    # The vertices are there: the middle of an affine image is the image of the middle.
    moved = mapped(rest[right], np.array(BENT))
    np.testing.assert_allclose(position_of(obj.data)[right], moved, atol=1e-6)


@pytest.mark.parametrize("scale", [(1, 1, 1), (2, 2, 2), (1, 1, -1)])
def test_its_own_axes_turn_with_it(places, live, begin, scale):
    obj, _, _ = add_pinned(**THERE, scale=scale)
    obj.cubic_craft.handles[1].pose = BENT
    tick_to_rest(begin(obj))
    _, place = places.places_of(obj)
    axes = place.own_axes
    np.testing.assert_allclose(axes.T @ axes, np.eye(3), atol=1e-6)
    assert np.linalg.det(axes) > 0
    for axis, column in zip(axes.T, np.array(obj.matrix_world @ BENT)[:3, :3].T, strict=True):
        assert abs(axis @ column) == pytest.approx(np.linalg.norm(column), rel=1e-5)


def test_what_follows_an_object_is_moved_by_that(places, live, begin):
    obj, _, _ = add_posable()
    pin(obj, LEFT)
    empty = follow(obj, RIGHT)
    session = tick_to_rest(begin(obj))
    assert [place.number for place in places.places_of(obj)] == [0]
    select(empty)
    assert places.live_object(bpy.context) == obj
    obj.cubic_craft.handles[1].mode = "PINNED"
    tick_to_rest(session)
    assert [place.number for place in places.places_of(obj)] == [0, 1]


def test_the_list_may_change_while_live_runs(places, live, begin):
    obj, _, right = add_pinned()
    rest = position_of(obj.data)
    session = tick_to_rest(begin(obj))
    before = [place.center for place in places.places_of(obj)]
    obj.cubic_craft.handles.move(1, 0)
    assert places.places_of(obj) == [], "Live has not seen it yet"
    tick_to_rest(session)
    after = [place.center for place in places.places_of(obj)]
    assert np.array_equal(after, before[::-1])
    obj.vertex_groups[RIGHT].remove(right[1:].tolist())
    obj.update_tag()
    session.on_mesh_update()
    tick_to_rest(session)
    first, _ = places.places_of(obj)
    np.testing.assert_allclose(first.center, rest[right[0]], atol=1e-6)
    live.live_properties().use_handles = False
    tick_to_rest(session)
    assert places.places_of(obj) == []


def test_only_a_live_mesh_has_them(places, live, begin):
    obj, _, _ = add_pinned()
    other, _, _ = add_posable(name="Other", location=(4, 0, 0))
    pin(other, LEFT)
    assert places.live_object(bpy.context) is None
    session = tick_to_rest(begin(obj))
    assert places.live_object(bpy.context) == obj
    select(other)
    assert places.live_object(bpy.context) is None
    select(obj)
    obj.hide_set(True)
    bpy.context.view_layer.objects.active = obj
    assert places.live_object(bpy.context) is None
    obj.hide_set(False)
    bpy.context.view_layer.objects.active = obj
    obj.scale.x = 0.0
    tick_to_rest(session)
    assert places.places_of(obj) == [], "no motion of the world could be mapped"
