# SPDX-License-Identifier: GPL-3.0-or-later
"""Forms in Blender: each by its name, of another object, followed live, mirrored and restored."""

import bmesh
import bpy
import numpy as np
import pytest
from live_steps import bits, check_same_as_cubify, confirm, tick_to_rest
from mathutils import Euler, Matrix
from rich_mesh import position_of
from scene import add_empty, add_monkey, add_triangles, cubify, select
from solids import add_solid, share_facing

NAMES = (
    *(
        "CUBE",
        "BOX",
        "ROUNDED",
        "OCTAHEDRON",
        "TETRAHEDRON",
        "DODECAHEDRON",
        "ICOSAHEDRON",
        "RHOMBIC",
    ),
    *("PRISM", "PYRAMID", "CYLINDER", "CONE", "OBJECT", "DIRECTIONS"),
)
OPTIONS = {"refine": "OFF", "max_iterations": 200}


@pytest.fixture
def body_of(part):
    """Return a function that returns the form of an object."""
    settings_of, form_of = part("settings.properties").settings_of, part("form.body").form_of
    return lambda obj: form_of(settings_of(obj))


@pytest.mark.thorough(4)
@pytest.mark.parametrize("name", NAMES)
def test_the_surface_turns_to_the_sides_and_comes_back(body_of, name):
    form = add_solid("cone", location=(9, 0, 0))
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=5)
    ball = bpy.context.object
    before = bits(ball)
    ball.cubic_craft.form, ball.cubic_craft.form_object = name, form
    body = body_of(ball)
    assert (body is None) == (name == "CUBE" or name == "BOX")  # a box of equal sides is the cube
    normals = np.concatenate([np.eye(3), -np.eye(3)]) if body is None else body.normals
    was = share_facing(ball, normals)
    cubify(cubeness=1.0, solidity=0.0, **OPTIONS)
    assert share_facing(ball, normals) > max(was + 0.1, 0.6)
    bpy.ops.cubic_craft.restore()
    assert bits(ball) == before


def test_a_cube_as_an_object_is_the_cube():
    one, other = add_triangles(), add_triangles()
    form = add_solid("cube", location=(9, 0, 0))
    select(one)
    cubify(**OPTIONS)
    select(other)
    cubify(form="OBJECT", form_object=form.name, **OPTIONS)
    assert other.cubic_craft.form == "OBJECT" and other.cubic_craft.form_object == form
    np.testing.assert_allclose(position_of(other.data), position_of(one.data), atol=2e-5)
    form.rotation_euler.z = 0.5
    bpy.context.view_layer.update()
    cubify(form="OBJECT", form_object=form.name, **OPTIONS)
    select(one)
    cubify(orientation=(0, 0, 0.5), **OPTIONS)
    np.testing.assert_allclose(position_of(other.data), position_of(one.data), atol=1e-3)


def test_directions_of_half_a_box_are_completed(body_of):
    ball = add_triangles()
    ball.cubic_craft.form, ball.cubic_craft.form_object = "DIRECTIONS", add_solid("plane")
    body = body_of(ball)
    assert len(body.normals) == 6
    assert np.abs(body.normals @ [0, 0, 1]).max() == pytest.approx(1.0)


def test_of_a_ball_few_directions_are_taken(part, body_of):
    monkey = add_monkey()
    monkey.cubic_craft.form, monkey.cubic_craft.form_object = "OBJECT", add_solid("ball")
    assert 20 <= len(body_of(monkey).normals) <= part("form.body").MOST_DIRECTIONS


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: "", "no object is set for the form"),
        (lambda: "Nobody", 'no object "Nobody"; pick another form object'),
        (lambda: add_empty("Nothing").name, '"Nothing" has no surface'),
        (lambda: add_solid("plane").name, '"Form" gives no form: a form needs at least four'),
    ],
)
def test_what_gives_no_form_is_said(make, words):
    name, monkey = make(), add_monkey()
    before = bits(monkey)
    with pytest.raises(RuntimeError, match=words):
        cubify(form="OBJECT", form_object=name)
    assert bits(monkey) == before


def test_an_origin_outside_is_said():
    form, monkey = add_solid("cube"), add_monkey()
    form.data.transform(Matrix.Translation((3, 0, 0)))
    with pytest.raises(RuntimeError, match="the origin of the form must lie inside"):
        cubify(form="OBJECT", form_object=form.name)
    assert not monkey.cubic_craft.status


def test_live_follows_the_object_while_it_is_edited(live, begin):
    obj, form = add_triangles(), add_solid("cone", location=(9, 0, 0))
    session = begin(obj, form="OBJECT", form_object=form)
    assert live.live_properties().form_object == form.name
    tick_to_rest(session)
    before = bits(obj)
    for vertex in form.data.vertices:
        vertex.co.z *= 2.0 if vertex.co.z > 0.5 else 1.0
    form.data.update()
    tick_to_rest(session)
    edited = bits(obj)
    assert edited != before
    form.rotation_euler.x = 0.4
    tick_to_rest(session)
    assert bits(obj) != edited
    live.live_properties().form = "DODECAHEDRON"
    tick_to_rest(session)
    confirm(live, session)
    assert obj.cubic_craft.form == "DODECAHEDRON"
    check_same_as_cubify(obj)


@pytest.mark.thorough(3)
@pytest.mark.parametrize("scale", [1.0, -1.0])
@pytest.mark.parametrize("form", ["OCTAHEDRON", "TETRAHEDRON", "PYRAMID", "PRISM"])
def test_auto_orient_finds_how_the_form_is_turned(part, body_of, form, scale):
    """A mesh that is the form, turned, and seen as such through a mirroring scale, too."""
    obj = add_monkey()
    obj.cubic_craft.form = form
    body = body_of(obj)
    turn = np.array(Euler((0.2, -0.3, 0.25)).to_matrix())
    corners = body.vertices @ turn.T * [scale, 1.0, 1.0]
    hull = bmesh.new()
    for corner in corners:
        hull.verts.new(corner)
    bmesh.ops.convex_hull(hull, input=hull.verts[:])
    bmesh.ops.recalc_face_normals(hull, faces=hull.faces[:])
    hull.to_mesh(obj.data)
    hull.free()
    obj.scale.x = scale
    select(obj)
    bpy.context.view_layer.update()
    bpy.ops.cubic_craft.auto_orient()
    axes = np.array(Euler(obj.cubic_craft.orientation).to_matrix())
    directions = body.normals @ turn.T  # as they are seen
    costs = body.cost(directions @ axes)
    np.testing.assert_allclose(costs, body.offsets, rtol=5e-3)


@pytest.mark.parametrize("form", ["OCTAHEDRON", "DODECAHEDRON", "PRISM"])
def test_facets_of_the_form_can_be_made_planar(body_of, form):
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=5)
    ball = bpy.context.object
    ball.cubic_craft.form = form
    ball.cubic_craft.orientation = (0.1, 0.2, 0.3)
    cubify(cubeness=1.0, solidity=0.0, crispness=0.5, **OPTIONS)
    turn = np.array(Euler((0.1, 0.2, 0.3)).to_matrix())
    normals = body_of(ball).normals @ turn.T
    assert share_facing(ball, normals, 0.05) < 0.2
    ball.cubic_craft.form, ball.cubic_craft.form_sides = "CONE", 3  # not what it was made with
    assert bpy.ops.cubic_craft.flatten(tolerance=0.05) == {"FINISHED"}
    assert share_facing(ball, normals, 0.05) > 0.5
