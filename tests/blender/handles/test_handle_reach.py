# SPDX-License-Identifier: GPL-3.0-or-later
"""How far handles reach.

What is far stays, what is held may become cubic, and small handles pull no spikes.
"""

import bmesh
import bpy
import numpy as np
import pytest
from mathutils import Euler, Matrix
from posing import pin
from rich_mesh import position_of
from scene import cubify, select

UP = Matrix.Translation((0.0, 0.0, 0.6))


def add_figure(name="Figure"):
    """Add a body with two arms along X, in one skin: arms at x = 0.3 to 1.2, legs down to z = 0."""
    balls = [((0, 0, z), 0.28) for z in np.arange(0.3, 1.5, 0.1)]
    balls += [((side * x, 0, 1.2), 0.12) for side in (1, -1) for x in np.arange(0.2, 1.15, 0.05)]
    parts = []
    for place, size in balls:
        bpy.ops.mesh.primitive_uv_sphere_add(segments=16, ring_count=8, location=place, radius=size)
        parts.append(bpy.context.object)
    select(*parts)
    bpy.ops.object.join()
    obj = bpy.context.object
    obj.name = name
    bpy.ops.object.transform_apply(location=True, rotation=True, scale=True)
    obj.data.remesh_voxel_size = 0.05
    bpy.ops.object.voxel_remesh()
    return obj


def add_group(obj, name, is_in):
    V = position_of(obj.data)
    number = np.flatnonzero(is_in(V))
    assert len(number)
    obj.vertex_groups.new(name=name).add(number.tolist(), 1.0, "REPLACE")
    return number


def raise_hand(obj):
    hand = add_group(obj, "Hand", lambda V: V[:, 0] > 1.05)
    pin(obj, "Hand").pose = UP
    return hand


def moved(before, after, where):
    return np.linalg.norm(after - before, axis=1)[where].max()


@pytest.mark.parametrize("cubeness", [0.0, 0.4])
def test_what_is_far_from_a_raised_hand_stays(cubeness):
    obj = add_figure()
    V = position_of(obj.data)
    cubify(cubeness=cubeness, max_iterations=1000)
    base = position_of(obj.data)
    hand = raise_hand(obj)
    cubify(cubeness=cubeness, max_iterations=1000)
    held = position_of(obj.data)
    cubify(cubeness=cubeness, max_iterations=1000, hold_rest=False)
    dragged = position_of(obj.data)
    expected = V[hand] + np.array([0, 0, 0.6], np.float32)
    assert np.abs(held[hand] - expected).max() < 1e-6
    foot, other = V[:, 2] < 0.5, V[:, 0] < -0.8
    size = np.ptp(V, axis=0).max()
    for place in (foot, other):
        assert moved(base, held, place) < 0.06 * size
        assert moved(base, dragged, place) > 2 * moved(base, held, place)


def test_a_pinned_handle_is_all_that_stays():
    obj = add_figure()
    raise_hand(obj)
    add_group(obj, "Foot", lambda V: V[:, 2] < 0.1)
    pin(obj, "Foot")
    shapes = []
    for hold_rest in (True, False):
        cubify(max_iterations=5, hold_rest=hold_rest)
        shapes.append(position_of(obj.data))
    np.testing.assert_array_equal(*shapes)


def test_a_handle_that_becomes_cubic_goes_where_it_is_moved():
    obj = add_figure()
    V = position_of(obj.data)
    hand = add_group(obj, "Hand", lambda V: V[:, 0] > 0.8)
    handle = pin(obj, "Hand")
    handle.is_cubic = True
    handle.pose = turn = Matrix.LocRotScale((0.1, 0, 0.4), Euler((0.0, -0.5, 0.0)), None)
    cubify(max_iterations=1000)
    after = position_of(obj.data)
    rigid = V @ np.array(turn.to_3x3(), np.float32).T + np.array(turn.translation, np.float32)
    assert np.linalg.norm((after - rigid)[hand].mean(axis=0)) < 0.02
    assert moved(rigid, after, hand) > 0.02


def test_in_the_half_of_a_mirror_modifier_it_does_the_same_in_both():
    obj = add_figure()
    V = position_of(obj.data)
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    geometry = [*bm.verts, *bm.edges, *bm.faces]
    bmesh.ops.bisect_plane(
        bm, geom=geometry, plane_co=(0, 0, 0), plane_no=(-1, 0, 0), clear_outer=True
    )
    bm.to_mesh(obj.data)
    bm.free()
    obj.modifiers.new("Mirror", "MIRROR")
    V = position_of(obj.data)
    inside = np.abs(V[:, 0]) < 1e-5
    hand = raise_hand(obj)
    obj.cubic_craft.handles[0].is_cubic = True
    cubify(max_iterations=1000)
    after = position_of(obj.data)
    assert (after[inside, 0] == V[inside, 0]).all()
    assert after[hand, 2].mean() == pytest.approx(V[hand, 2].mean() + 0.6, abs=0.03)


def test_what_two_small_handles_reach_goes_with_the_first():
    bpy.ops.mesh.primitive_uv_sphere_add(segments=192, ring_count=96)
    obj = bpy.context.object
    V = position_of(obj.data)
    tip = int(np.argmax(V @ (0.6, 0.0, 0.8)))
    distance = np.linalg.norm(V - V[tip], axis=1)
    beside = int(np.argmin(np.abs(distance - 0.06)))
    for name, vertex in (("Tip", tip), ("Beside", beside)):
        obj.vertex_groups.new(name=name).add([vertex], 1.0, "REPLACE")
        pin(obj, name)
    obj.cubic_craft.handles[0].pose = Matrix.Translation((0.3, 0.0, 0.4))
    cubify(cubeness=0.0)
    after = position_of(obj.data)
    both = (distance < 0.05) & (np.linalg.norm(V - V[beside], axis=1) < 0.05)
    assert both.any()
    assert after[both] == pytest.approx(V[both] + np.float32([0.3, 0.0, 0.4]), abs=1e-5)
