# SPDX-License-Identifier: GPL-3.0-or-later
"""The mesh is transformed while Live shows something on it: the original goes along."""

import bpy
import numpy as np
import pytest
from live_steps import add_monkey, check_gone, confirm, tick_to_rest, wake_to_rest
from mathutils import Euler, Matrix
from rich_mesh import position_of
from scene import cubify, select


def set_origin(obj):
    bpy.context.scene.cursor.location = (0.5, 0.3, 0.1)
    assert bpy.ops.object.origin_set(type="ORIGIN_CURSOR") == {"FINISHED"}
    return Matrix.Translation((-0.5, -0.3, -0.1))


def apply_transform(obj):
    matrix = obj.matrix_basis.copy()
    assert bpy.ops.object.transform_apply(location=False) == {"FINISHED"}
    return matrix


WAYS = pytest.mark.parametrize("transform", [set_origin, apply_transform])


def begin_on_monkey(begin, transform, was_cubic):
    """Return a monkey that can be transformed, its positions, and Live at rest on it."""
    obj = add_monkey()
    before = position_of(obj.data)
    if transform is apply_transform:
        obj.matrix_basis = Matrix.LocRotScale(None, Euler((0.3, 0.2, 0.1)), (1.0, 1.5, 0.5))
        bpy.context.view_layer.update()
    if was_cubic:
        cubify()
    session = tick_to_rest(begin(obj, cubeness=0.8))
    return obj, before, session


def moved(V, matrix):
    matrix = np.array(matrix)
    return V @ matrix[:3, :3].T + matrix[:3, 3]


@pytest.mark.thorough(2)
@WAYS
@pytest.mark.parametrize("ending", ["confirm", "cancel", "cancel at once"])
@pytest.mark.parametrize("was_cubic", [False, True])
def test_the_original_goes_along(begin, live, transform, ending, was_cubic):
    obj, before, session = begin_on_monkey(begin, transform, was_cubic)
    way = transform(obj)
    if ending != "cancel at once":
        wake_to_rest(session)
    if ending == "confirm":
        confirm(live, session)
    else:
        session.on(live.Event.CANCEL)
    check_gone(live)
    if ending == "confirm" or was_cubic:
        assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert position_of(obj.data) == pytest.approx(moved(before, way), abs=2e-6)


def test_a_shape_key_that_is_added_is_taken_in(begin, live):
    obj = add_monkey()
    before = position_of(obj.data)
    session = tick_to_rest(begin(obj))
    for _ in range(2):
        bpy.ops.object.shape_key_add(from_mix=False)
        wake_to_rest(session)
    confirm(live, session)
    assert len(obj.data.shape_keys.key_blocks) == 2
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert (position_of(obj.data) == before).all()


@pytest.mark.thorough(2)
@WAYS
@pytest.mark.parametrize("is_live", [True, False])
@pytest.mark.parametrize("was_cubic", [False, True])
def test_it_does_so_after_an_undo_to_the_moment_of_the_transform(
    begin, live, transform, was_cubic, is_live
):
    """Blender keeps the undo step of an operator before anybody can see what it has done."""
    obj, before, session = begin_on_monkey(begin, transform, was_cubic)
    name = obj.name
    bpy.ops.ed.undo_push(message="Live")
    way = transform(obj)
    bpy.ops.ed.undo_push(message="Transform")
    wake_to_rest(session)
    bpy.ops.ed.undo_push(message="Something else")
    if not is_live:
        session.on(live.Event.CANCEL)
    bpy.ops.ed.undo()
    if is_live:
        tick_to_rest(session)
        session.on(live.Event.CANCEL)
    check_gone(live)
    obj = bpy.data.objects[name]
    select(obj)
    if was_cubic:
        assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert position_of(obj.data) == pytest.approx(moved(before, way), abs=2e-6)
