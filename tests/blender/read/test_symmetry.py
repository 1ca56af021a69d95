# SPDX-License-Identifier: GPL-3.0-or-later
"""Halves stay mirror images: by the setting Symmetry, and under a Mirror modifier."""

import bmesh
import bpy
import numpy as np
import pytest
from live_steps import bits, confirm
from lumps import FLIP_X, add_lump, partner_of
from mathutils import Euler, Matrix
from posing import pin
from rich_mesh import position_of, set_position
from scene import add_empty, add_monkey, cubify, select


def in_order(V):
    """Sort positions: those of a monkey's lips coincide, so partners cannot be told from them."""
    return V[np.lexsort(V.T + np.float32(0))]


def halve(obj):
    """Keep the half at negative X, with vertices in the plane, and mirror it by a modifier."""
    bm = bmesh.new()
    bm.from_mesh(obj.data)
    bmesh.ops.bisect_plane(
        bm,
        geom=[*bm.verts, *bm.edges, *bm.faces],
        plane_co=(0, 0, 0),
        plane_no=(1, 0, 0),
        clear_outer=True,
    )
    for vertex in bm.verts:
        if abs(vertex.co.x) < 1e-5:
            vertex.co.x = 0.0
    bm.to_mesh(obj.data)
    bm.free()
    return obj.modifiers.new("Mirror", "MIRROR")


def evaluated(obj):
    """Return the positions that are seen, and how many edges have one face only."""
    graph = bpy.context.evaluated_depsgraph_get()
    mesh = obj.evaluated_get(graph).to_mesh()
    V = np.array([vertex.co for vertex in mesh.vertices])
    bm = bmesh.new()
    bm.from_mesh(mesh)
    borders = sum(edge.is_boundary for edge in bm.edges)
    bm.free()
    return V, borders


def test_objects_that_are_solved_together_share_a_plane():
    head, *eyes = add_monkey(), add_ball("Left"), add_ball("Right")
    for eye, x in zip(eyes, (0.4, -0.4), strict=True):
        eye.location, eye.scale = (x, -0.9, 0.25), (0.2, 0.2, 0.2)
    bpy.context.view_layer.update()
    select(head, *eyes)
    cubify()
    left, right = (position_of(eye.data) * eye.scale + eye.location for eye in eyes)
    images = in_order(np.round(right * FLIP_X, 4))
    np.testing.assert_allclose(in_order(np.round(left, 4)), images, atol=2e-4)
    assert np.ptp(left, axis=0).max() > 0.3


def test_what_is_symmetric_stays_so_without_being_asked():
    obj = add_monkey()
    cubify()
    after = position_of(obj.data)
    assert (in_order(after) == in_order(after * FLIP_X)).all()
    assert "507 of 507 match" in obj.cubic_craft.status


def test_the_cube_is_mirrored_as_well():
    """Else a turned cube would pull both halves, which are images, two ways."""
    obj = add_lump()
    turn = Euler((0.0, 0.4, 0.3))
    cubify(cubeness=2.0, symmetry=(True, False, False), orientation=turn)
    normals = np.array([polygon.normal for polygon in obj.data.polygons])
    areas = np.array([polygon.area for polygon in obj.data.polygons])
    right = np.array([polygon.center.x for polygon in obj.data.polygons]) > 0.0
    axes = np.array(turn.to_matrix())
    own, image = (
        (areas * np.abs(normals @ cube).sum(axis=1))[right].sum() / areas[right].sum()
        for cube in (axes, FLIP_X[:, None] * axes)
    )
    assert abs(own - image) > 0.1


def test_of_an_object_that_is_turned_and_scaled():
    obj = add_lump()
    partner = partner_of(position_of(obj.data), 1e-4)
    obj.matrix_world = Matrix.LocRotScale((3, 1, 2), Euler((0.3, 1.0, -0.4)), (1.0, 2.0, 0.5))
    bpy.context.view_layer.update()
    cubify(symmetry=(True, False, False), space="WORLD")
    after = position_of(obj.data)
    assert (after[partner] == after * FLIP_X).all()


def test_what_does_not_match_is_left_alone_and_counted():
    obj = add_lump()
    V = position_of(obj.data)
    partner = partner_of(V, 1e-4)
    number = int(np.flatnonzero(V[:, 0] > 0.4)[0])
    V[number, 1] += 0.05
    set_position(obj.data, V)
    cubify(symmetry=(True, False, False))
    after = position_of(obj.data)
    others = ~np.isin(np.arange(len(V)), (number, partner[number]))
    assert (after[partner][others] == (after * FLIP_X)[others]).all()
    assert f"{len(V) - 2:,} of {len(V):,} match" in obj.cubic_craft.status


def test_what_is_pinned_stays_although_its_partner_moves():
    obj = add_lump()
    V = position_of(obj.data)
    held = np.flatnonzero(V[:, 0] > 0.8)
    obj.vertex_groups.new(name="Held").add(held.tolist(), 1.0, "REPLACE")
    pin(obj, "Held")
    cubify(symmetry=(True, False, False))
    after = position_of(obj.data)
    assert (after[held] == V[held]).all()
    free = np.setdiff1d(np.arange(len(V)), np.concatenate([held, partner_of(V, 1e-4)[held]]))
    partner = partner_of(V, 1e-4)
    assert (after[partner][free] == (after * FLIP_X)[free]).all()


def test_shape_keys_stay_symmetric():
    obj = add_lump()
    V = position_of(obj.data)
    partner = partner_of(V, 1e-4)
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Wide")
    key.points.foreach_set("co", (V * np.float32(1.1)).ravel())
    cubify(symmetry=(True, False, False))
    wide = np.empty(V.size, np.float32)
    key.points.foreach_get("co", wide)
    wide = wide.reshape(-1, 3)
    assert np.abs(wide[partner] - wide * FLIP_X).max() < 1e-6


def test_the_seam_of_a_mirror_modifier_stays_closed():
    obj = add_monkey()
    modifier = halve(obj)
    whole, borders = evaluated(obj)
    V = position_of(obj.data)
    inside = V[:, 0] == 0.0
    assert inside.sum() > 30
    cubify()
    after = position_of(obj.data)
    assert (after[inside, 0] == 0.0).all()
    assert np.abs(after - V).max() > 0.1
    assert after[:, 0].max() < 1e-3  # nothing has gone through the plane
    seen, now = evaluated(obj)
    assert (len(seen), now) == (len(whole), borders)  # merged as before
    assert modifier.show_viewport


def test_a_half_becomes_what_the_whole_becomes():
    obj, other = add_lump("Half"), add_lump("Whole")
    halve(obj)
    graph = bpy.context.evaluated_depsgraph_get()
    mesh = bpy.data.meshes.new_from_object(obj.evaluated_get(graph))
    other.data = mesh
    half, whole = position_of(obj.data), position_of(mesh)
    at = [int(np.linalg.norm(whole - v, axis=1).argmin()) for v in half]
    for one, symmetry in ((obj, (False,) * 3), (other, (True, False, False))):
        select(one)
        cubify(symmetry=symmetry, max_iterations=1000)
    assert np.abs(position_of(obj.data) - half).max() > 0.1
    size = np.ptp(whole, axis=0).max()
    assert np.abs(position_of(obj.data) - position_of(mesh)[at]).max() < 0.02 * size


def test_the_plane_of_another_object():
    obj = add_monkey()
    modifier = halve(obj)
    turn = Matrix.LocRotScale((0.5, -1.0, 0.3), Euler((0.2, 0.1, 0.7)), None)
    empty = add_empty("Plane", matrix_world=turn)
    obj.data.transform(turn)
    modifier.mirror_object = empty
    bpy.context.view_layer.update()
    plane = np.array(turn.to_3x3())[:, 0]
    before = (position_of(obj.data) - np.array(turn.translation)) @ plane
    cubify()
    after = (position_of(obj.data) - np.array(turn.translation)) @ plane
    inside = np.abs(before) < 1e-6
    assert inside.sum() > 30
    assert np.abs(after[inside]).max() < 1e-6


def test_a_half_beside_another_object():
    """The other half is there, too, for what is selected with it."""
    obj = add_monkey()
    halve(obj)
    ring = add_lump("Ring")
    ring.location = (0, 0, 1.6)
    bpy.context.view_layer.update()
    inside = position_of(obj.data)[:, 0] == 0.0
    select(obj, ring)
    cubify()
    assert (position_of(obj.data)[inside, 0] == 0.0).all()
    assert len(ring.data.vertices) == len(position_of(ring.data))
    assert "of 2 objects" in obj.cubic_craft.status


@pytest.mark.parametrize("is_cut", [False, True])
def test_a_modifier_that_is_off_or_cuts_is_not_followed(is_cut):
    obj, plain = add_monkey(), add_monkey("Plain")
    modifier = obj.modifiers.new("Mirror", "MIRROR")
    if is_cut:
        modifier.use_bisect_axis[0] = True
    else:
        modifier.show_viewport = False
    for one in (obj, plain):
        select(one)
        cubify()
    assert bits(obj) == bits(plain)


def add_ball(name="Ball"):
    bpy.ops.mesh.primitive_uv_sphere_add(segments=24, ring_count=12)
    bpy.context.object.name = name
    return bpy.context.object


def test_live_gives_the_same(begin, live):
    obj, other = add_ball(), add_ball("Other")
    for one in (obj, other):
        halve(one)
    select(other)
    cubify(symmetry=(False, False, True), floor="ON", max_iterations=1000)
    confirm(live, begin(obj, symmetry=(False, False, True), floor="ON"))
    assert bits(obj) == bits(other)


def test_what_is_not_symmetric_is_refused():
    """Mirror images of a few vertices would tear all others apart."""
    obj = add_monkey()
    before = bits(obj)
    with pytest.raises(RuntimeError, match=r'"Suzanne" is not symmetric: only .* of its 507'):
        cubify(symmetry=(False, False, True))
    assert bits(obj) == before
    assert cubify(symmetry=(True, False, False)) == {"FINISHED"}
