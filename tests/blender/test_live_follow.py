# SPDX-License-Identifier: GPL-3.0-or-later
"""Live with New Object: the original is worked on, and a follower shows what becomes of it."""

import time

import bmesh
import bpy
import numpy as np
import pytest
from live_steps import STEPS, add_monkey, bits, check_gone, confirm
from scene import edit_mode, select
from snapshot import differences, snapshot_mesh


@pytest.fixture
def follow(begin):
    """Return a function that begins Live with a follower."""

    def start(obj, **settings):
        return begin(obj, result="NEW_OBJECT", **{"cubeness": 0.5, **settings})

    return start


def settle(session):
    """Tick until the exact shape is there, which begins after a pause."""
    bpy.context.view_layer.update()
    for _ in range(STEPS):
        session.tick(bpy.context)
        bpy.context.view_layer.update()
        if session.is_ended or session._timer is None:
            return session
        if not session._runs.is_working:
            time.sleep(0.005)
    raise AssertionError("Live does not come to rest")


def follower_of(obj):
    return bpy.data.objects[f"{obj.name} Cubic"]


def stroke(obj, by=0.2):
    """Move some vertices as a brush would."""
    points = np.frombuffer(bits(obj), np.float32).reshape(-1, 3).copy()
    near = np.exp(-(np.linalg.norm(points - points[40], axis=1) ** 2) / 0.1)
    points[:, 1] -= by * near.astype(np.float32)
    obj.data.vertices.foreach_set("co", points.ravel())
    obj.data.update()
    bpy.context.view_layer.update()
    return points


def check_same_as_new_object(obj, result):
    """Check that the result is what Cubify makes of the original now, but for its place."""
    one = snapshot_mesh(result.data)
    bpy.data.objects.remove(result)
    select(obj)
    assert bpy.ops.cubic_craft.cubify() == {"FINISHED"}
    other = snapshot_mesh(bpy.context.object.data)
    assert not differences(one, other, ignore=("*name*", "rna/shape_keys", "shape_keys/rna/user"))


def test_the_original_is_not_touched_and_the_follower_shows_the_result(live, follow):
    obj = add_monkey()
    before = snapshot_mesh(obj.data)
    session = settle(follow(obj))
    follower = follower_of(obj)
    assert not differences(before, snapshot_mesh(obj.data))
    assert bits(follower) != bits(obj)
    assert follower.location.x > obj.location.x + 1.0 and bpy.context.object == obj
    shown = bits(follower)
    confirm(live, session)
    check_gone(live)
    assert bits(follower_of(obj)) == shown
    check_same_as_new_object(obj, follower_of(obj))


@pytest.mark.parametrize("mode", ["OBJECT", "WEIGHT_PAINT", "EDIT", "SCULPT"])
def test_a_stroke_is_followed_and_ends_as_cubify_of_the_original(live, follow, mode):
    obj = add_monkey()
    session = settle(follow(obj))
    shown = bits(follower_of(obj))
    bpy.ops.object.mode_set(mode=mode)
    settle(session)
    assert not session.is_ended and obj.mode == mode
    if mode == "EDIT":
        bm = bmesh.from_edit_mesh(obj.data)
        for vertex in list(bm.verts)[:60]:
            vertex.co.y -= 0.2
        bmesh.update_edit_mesh(obj.data)
        bpy.context.view_layer.update()
    else:
        stroke(obj)
        obj.update_tag(refresh={"DATA"})
        bpy.context.view_layer.update()
    session.tick(bpy.context)
    assert bits(follower_of(obj)) != shown, "not seen within one tick"
    settle(session)
    confirm(live, session)
    assert obj.mode == mode
    bpy.ops.object.mode_set(mode="OBJECT")
    check_same_as_new_object(obj, follower_of(obj))


def test_other_faces_are_followed(live, follow):
    obj = add_monkey()
    session = settle(follow(obj))
    with edit_mode(obj):
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.subdivide()
        settle(session)
        assert len(follower_of(obj).data.vertices) > 1500
    settle(session)
    confirm(live, session)
    check_same_as_new_object(obj, follower_of(obj))
