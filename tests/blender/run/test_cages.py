# SPDX-License-Identifier: GPL-3.0-or-later
"""Cages: what a Subdivision Surface modifier shows becomes cubic, and the cage follows."""

import bmesh
import bpy
import numpy as np
import pytest
from live_steps import bits, confirm, tick_to_rest, wake_to_rest
from mathutils import Matrix
from rich_mesh import position_of
from scene import add_monkey, bmesh_of, change_settings, cubify, given, reports_of, select
from scipy.spatial import KDTree


def add_sphere():
    bpy.ops.mesh.primitive_uv_sphere_add(segments=16, ring_count=8)
    return bpy.context.object


def under_subdivision(obj, levels=2, **options):
    modifier = obj.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = levels
    for name, value in options.items():
        setattr(modifier, name, value)
    return obj


def add_creased_cube():
    """Add a cube, subdivided once, of which some edges are sharp, a little sharp, or both."""
    bpy.ops.mesh.primitive_cube_add()
    mesh = bpy.context.object.data
    with bmesh_of(mesh) as edited:
        bmesh.ops.subdivide_edges(edited, edges=edited.edges, cuts=1, use_grid_fill=True)
    crease = mesh.attributes.new("crease_edge", "FLOAT", "EDGE")
    crease.data.foreach_set("value", np.repeat([0.0, 0.25, 1.0], 16)[: len(mesh.edges)])
    return bpy.context.object


def half_monkey():
    """Add the half of a monkey with a Mirror modifier."""
    obj = add_monkey()
    with bmesh_of(obj.data) as edited:
        beyond = [vertex for vertex in edited.verts if vertex.co.x < -1e-4]
        bmesh.ops.delete(edited, geom=beyond, context="VERTS")
    obj.modifiers.new("Mirror", "MIRROR")
    return obj


def finely(**options):
    """Cubify on a finer copy, to the end."""
    assert cubify(refine="AUTO", max_iterations=1000, **options) == {"FINISHED"}


def seen(obj):
    """Return the positions (n,3) and triangles (m,3) of what the viewport shows."""
    mesh = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    mesh.calc_loop_triangles()
    return position_of(mesh), np.array([each.vertices[:] for each in mesh.loop_triangles])


def share(obj):
    """Return the share of the visible area that faces an axis within 8 degrees."""
    V, F = seen(obj)
    a, b, c = (V[F[:, k]].astype(np.float64) for k in range(3))
    normals = np.cross(b - a, c - a)
    sizes = np.linalg.norm(normals, axis=1)
    is_near = np.abs(normals).max(axis=1) > np.cos(np.radians(8.0)) * sizes
    return sizes[is_near].sum() / sizes.sum()


def folds(obj):
    """Return the number of corners at which a face turns back."""
    V, count = position_of(obj.data).astype(np.float64), 0
    for polygon in obj.data.polygons:
        points = V[list(polygon.vertices)]
        at = np.cross(points - np.roll(points, 1, 0), np.roll(points, -1, 0) - points)
        count += int((at @ at.sum(axis=0) < 0.0).sum())
    return count


@pytest.mark.parametrize("add, least", [(add_monkey, 0.5), (add_sphere, 0.57)])
def test_what_is_seen_of_a_cage_becomes_cubic(add, least):
    obj = under_subdivision(add())
    uvs = [tuple(each.uv) for each in obj.data.uv_layers[0].data]
    obj.shape_key_add(name="Basis")
    obj.shape_key_add(name="Smile").data[40].co.x += 0.3
    before, was_folded = position_of(obj.data), folds(obj)
    finely()
    assert share(obj) > least
    assert folds(obj) <= was_folded + 6  # three of them on each side
    assert len(obj.data.vertices) == len(before)
    assert [each.type for each in obj.modifiers] == ["SUBSURF"]
    assert [tuple(each.uv) for each in obj.data.uv_layers[0].data] == uvs
    assert [key.name for key in obj.data.shape_keys.key_blocks] == ["Basis", "Smile"]
    bpy.ops.cubic_craft.restore()
    assert position_of(obj.data).tobytes() == before.tobytes()


def test_a_fine_cage_does_not_tangle():
    obj = add_monkey()
    under_subdivision(obj, 1)
    bpy.ops.object.modifier_apply(modifier="Subdivision")
    under_subdivision(obj)
    was_folded = folds(obj)
    finely()
    assert share(obj) > 0.5
    assert folds(obj) <= was_folded + 16


@pytest.mark.parametrize("cuts, is_told", [(0, True), (1, False)])
def test_it_is_told_that_a_cage_has_too_few_faces(cuts, is_told):
    bpy.ops.mesh.primitive_cube_add()
    obj = bpy.context.object
    with bmesh_of(obj.data) as edited:
        if cuts:
            bmesh.ops.subdivide_edges(edited, edges=edited.edges, cuts=cuts, use_grid_fill=True)
    under_subdivision(obj)
    text = f'What is seen of "{obj.name}" keeps its form'
    assert (text in reports_of(lambda: cubify(refine="AUTO"))) is is_told


def test_it_is_more_cubic_than_a_cage_that_is_cubic_itself():
    obj, other = under_subdivision(add_monkey()), under_subdivision(add_monkey("Other"))
    other.modifiers[0].show_viewport = False
    for each in (obj, other):
        select(each)
        finely()
    other.modifiers[0].show_viewport = True
    assert share(obj) > share(other) + 0.12


def test_one_level_in_the_viewport_gives_what_two_do():
    one, two = under_subdivision(add_sphere(), 1), under_subdivision(add_sphere(), 2)
    select(one, two)
    finely()
    assert bits(one) == bits(two)


def test_halves_of_a_mirror_meet_in_its_plane():
    obj = under_subdivision(half_monkey())
    before = position_of(obj.data)
    is_inside = before[:, 0] == 0.0
    assert is_inside.any()
    finely()
    after = position_of(obj.data)
    assert (after[is_inside, 0] == 0.0).all()
    assert (after[~is_inside, 0] > -1e-3).all()
    assert np.abs(after - before).max() > 0.1
    V, _ = seen(obj)
    assert KDTree(V).query(V * [-1, 1, 1])[0].max() < 1e-5
    assert share(obj) > 0.5


def test_live_and_cubify_give_the_same(live, begin):
    twin, obj = under_subdivision(add_monkey("Twin")), under_subdivision(add_monkey())
    change_settings(twin, refine="AUTO", keep_apart=False)
    session = tick_to_rest(begin(obj, refine="AUTO"))
    assert share(obj) > 0.5, "the preview shows it"
    confirm(live, session)
    select(twin)
    bpy.ops.cubic_craft.cubify()
    assert bits(obj) == bits(twin)


def test_live_follows_the_modifier(live, begin):
    twin, obj = add_sphere(), under_subdivision(add_sphere())
    obj.location.x += 5.0
    session = tick_to_rest(begin(obj, refine="AUTO"))
    shape = bits(obj)
    obj.modifiers[0].show_viewport = False
    wake_to_rest(session)
    assert bits(obj) != shape
    confirm(live, session)
    select(twin)
    finely()
    assert bits(obj) == bits(twin)


AS_THEY_ARE = {
    "simple": (None, {"subdivision_type": "SIMPLE"}),
    "level 0": (None, {"levels": 0}),
    "hidden": (None, {"show_viewport": False}),
    "no finer copy": (None, {}),
    **{first: (first, {}) for first in ("BEVEL", "SOLIDIFY", "ARRAY")},  # which change the faces
}


@pytest.mark.thorough(3)
@pytest.mark.parametrize("how", AS_THEY_ARE)
def test_what_is_not_smooth_or_changed_before_is_solved_as_it_is(how):
    first, options = AS_THEY_ARE[how]
    plain, obj = add_sphere(), add_sphere()
    if first:
        obj.modifiers.new("First", first)
    under_subdivision(obj, **options)
    select(plain, obj)
    cubify(refine="OFF" if how == "no finer copy" else "AUTO", max_iterations=20)
    assert bits(plain) == bits(obj)


def test_held_vertices_stay_and_moved_ones_go_along():
    obj = under_subdivision(add_monkey())
    before = position_of(obj.data)
    top, bottom = np.flatnonzero(before[:, 2] > 0.6), np.flatnonzero(before[:, 2] < -0.6)
    for name, members in (("Top", top), ("Bottom", bottom)):
        obj.vertex_groups.new(name=name).add(members.tolist(), 1.0, "REPLACE")
    up = Matrix.Translation((0.0, 0.0, 0.5))
    finely(handles=[given("Top", up), given("Bottom")])
    after = position_of(obj.data)
    assert after[bottom].tobytes() == before[bottom].tobytes()
    np.testing.assert_allclose(after[top], before[top] + np.float32([0, 0, 0.5]), atol=1e-6)


SMOOTHED = {
    "monkey": (add_monkey, {}),
    "creases": (add_creased_cube, {}),
    "no creases": (add_creased_cube, {"use_creases": False}),
    "corners": (bpy.ops.mesh.primitive_grid_add, {"boundary_smooth": "PRESERVE_CORNERS"}),
    "n-gon": (bpy.ops.mesh.primitive_cylinder_add, {}),
    "half": (half_monkey, {}),
}


@pytest.mark.parametrize("name", SMOOTHED)
def test_the_surface_that_is_solved_is_that_of_blender(part, name):
    add, options = SMOOTHED[name]
    add()
    obj = under_subdivision(bpy.context.object, use_limit_surface=False, **options)
    settings = part("settings.properties").settings_of(obj)
    ours = part("read.member").read_member(obj, settings).V
    theirs, _ = seen(obj)
    assert len(ours) == len(theirs)
    for one, other in ((ours, theirs), (theirs, ours)):
        assert KDTree(one).query(other)[0].max() < 1e-5
