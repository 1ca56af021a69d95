# SPDX-License-Identifier: GPL-3.0-or-later
"""Normal captures in Blender: of a shaped ball, or of one that was cubified, and followed live."""

import bpy
import numpy as np
import pytest
from live_steps import bits, check_same_as_cubify, confirm, tick_to_rest
from lumps import FLIP_X
from mathutils import Matrix
from rich_mesh import position_of
from scene import add_copy, add_empty, add_monkey, add_triangles, cubify, select
from solids import add_solid, share_facing

AXES = np.concatenate([np.eye(3), -np.eye(3)])
OPTIONS = {"refine": "OFF", "max_iterations": 200}
PURE = {**OPTIONS, "cubeness": 0.0}


def add_ball(name="Ball", subdivisions=4, **where):
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=subdivisions, **where)
    bpy.context.object.name = name
    return bpy.context.object


def shape_ball(ball, power=8.0, stretch=(1.0, 1.0, 1.0)):
    """Sculpt a ball into a cushion with square sides, along its own directions."""
    V = position_of(ball.data).astype(np.float64)
    V /= np.linalg.norm(V, axis=1)[:, None]
    V /= (np.abs(V / stretch) ** power).sum(axis=1)[:, None] ** (1 / power)
    ball.data.vertices.foreach_set("co", V.astype(np.float32).ravel())
    ball.data.update()
    return ball


@pytest.fixture
def capture_of(part):
    """Return a function that returns the capture of an object."""
    of, settings_of = (
        part("form.normal_capture").capture_of,
        part("settings.properties").settings_of,
    )
    return lambda obj: of(obj, settings_of(obj))


def test_a_ball_becomes_like_the_other_and_comes_back():
    cushion = shape_ball(add_ball("Cushion", location=(9, 0, 0)))
    ball = add_ball(subdivisions=4)
    before, was = bits(ball), share_facing(ball, AXES)
    ball.cubic_craft.capture_object, ball.cubic_craft.capture_strength = cushion, 1.0
    cubify(**PURE)
    assert share_facing(ball, AXES) > was + 0.3
    bpy.ops.cubic_craft.restore()
    assert bits(ball) == before


def test_a_cubified_ball_says_how_it_faced_before(capture_of):
    """Its directions are the normals that it had, wherever its vertices are now."""
    ball, other = add_ball("Ball"), add_ball("Other", subdivisions=4)
    ball.data.transform(Matrix.Translation((0, 0, 0.7)))  # by its vertices it is no ball
    select(ball)
    cubify(cubeness=2.0, **OPTIONS)
    other.cubic_craft.capture_object = ball
    d = np.array([[0.9, 0.2, 0.1], [0.1, -0.2, -0.95]])
    d /= np.linalg.norm(d, axis=1)[:, None]
    np.testing.assert_allclose(capture_of(other).at(d), [[1, 0, 0], [0, 0, -1]], atol=0.12)
    select(other)
    was = share_facing(other, AXES)
    cubify(capture_strength=1.0, **PURE)
    assert other.cubic_craft.capture_object == ball
    assert share_facing(other, AXES) > was + 0.3


@pytest.mark.thorough(4)
@pytest.mark.parametrize("turn", [(0.4, 0.2, 0.7), (0, 0, 0)])
@pytest.mark.parametrize("scale", [(1, 1, 1), (-1, 1, 1), (2, 2, 2)])
@pytest.mark.parametrize("is_cubified", [False, True])
def test_the_ball_counts_as_it_is_seen_in_the_world(capture_of, turn, scale, is_cubified):
    ball = add_ball()
    if is_cubified:
        cubify(cubeness=2.0, orientation=(0.2, 0.1, 0.0), **OPTIONS)
    else:
        shape_ball(ball, stretch=(1.0, 1.3, 0.8))
    obj = add_monkey()
    obj.cubic_craft.capture_object = ball
    x = np.random.default_rng(0).normal(size=(200, 3))
    x /= np.linalg.norm(x, axis=1)[:, None]
    at_rest = capture_of(obj).at(x)
    ball.rotation_euler, ball.scale, ball.location = turn, scale, (3, 2, 1)
    bpy.context.view_layer.update()
    linear = np.array(ball.matrix_world.to_3x3())
    linear /= np.linalg.norm(linear, axis=0)
    np.testing.assert_allclose(capture_of(obj).at(x @ linear.T), at_rest @ linear.T, atol=1e-4)


def test_a_cubified_ball_with_more_vertices_on_top_counts_by_its_vertices(capture_of):
    ball, monkey = add_ball(subdivisions=4), add_monkey()
    monkey.cubic_craft.capture_object = ball
    select(ball)
    cubify(cubeness=2.0, **OPTIONS)
    ball.modifiers.new("Subdivision", "SUBSURF")
    bpy.context.view_layer.update()
    x = np.array([[0.0, 0.3, 0.95]])
    np.testing.assert_allclose(capture_of(monkey).at(x), [[0, 0, 1]], atol=0.15)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: "Nobody", 'no object "Nobody"; pick another normal capture'),
        (lambda: add_empty("Nothing").name, '"Nothing" has no surface'),
        (lambda: add_triangle_less().name, '"Dots" has no surface'),
        (lambda: add_solid("plane").name, '"Form" is not a normal capture: .* do not surround'),
        (lambda: add_far_ball().name, '"Ball" is not a normal capture: .* not surround its origin'),
        (lambda: add_triangle().name, '"Three" is not a normal capture: .* fewer than four'),
        (lambda: "Suzanne", '"Suzanne" cannot be its own normal capture'),
    ],
)
def test_what_is_no_ball_is_said(make, words):
    name, monkey = make(), add_monkey()
    before = bits(monkey)
    with pytest.raises(RuntimeError, match=words):
        cubify(capture_object=name)
    assert bits(monkey) == before and not monkey.cubic_craft.status


def add_mesh(name, points, faces):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(obj)
    return obj


def add_triangle_less():
    return add_mesh("Dots", [(0, 0, 1), (1, 0, 0), (0, 1, 0), (-1, -1, -1)], [])


def add_triangle():
    return add_mesh("Three", [(1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 1, 2)])


def add_far_ball():
    ball = add_ball(subdivisions=3)
    ball.data.transform(Matrix.Translation((3, 0, 0)))
    return ball


def test_live_follows_the_ball_while_it_is_edited(live, begin):
    cushion, obj = add_ball("Cushion", location=(9, 0, 0)), add_triangles()
    obj.cubic_craft.refine = "OFF"
    session = begin(obj, capture_object=cushion, capture_strength=0.5)
    assert live.live_properties().capture_object == cushion.name
    tick_to_rest(session)
    before = bits(obj)
    shape_ball(cushion)
    tick_to_rest(session)
    edited = bits(obj)
    assert edited != before
    cushion.rotation_euler.x = 0.4
    tick_to_rest(session)
    turned = bits(obj)
    assert turned != edited
    live.live_properties().capture_strength = 1.0
    tick_to_rest(session)
    assert bits(obj) != turned
    confirm(live, session)
    assert obj.cubic_craft.capture_object == cushion
    assert obj.cubic_craft.capture_strength == 1.0
    check_same_as_cubify(obj)


def test_a_mirrored_object_has_the_mirrored_shape_of_its_twin():
    """Both look alike in the world, where the ball and the form are."""
    tilted = shape_ball(add_ball("Tilted"), stretch=(1.0, 1.5, 0.7))
    tilted.rotation_euler = (0.3, 0.2, 0.4)
    one = add_triangles()
    other = add_copy(one)
    other.data.transform(Matrix.Diagonal((-1, 1, 1, 1)))
    other.data.flip_normals()
    other.scale.x = -1.0
    bpy.context.view_layer.update()
    for obj in (one, other):
        select(obj)
        style = {"form": "TETRAHEDRON", "orientation": (0.2, 0.3, 0.4), "capture_strength": 1.0}
        cubify(capture_object=tilted.name, **style, **OPTIONS)
    np.testing.assert_allclose(position_of(other.data) * FLIP_X, position_of(one.data), atol=2e-3)


def test_what_is_solved_together_may_have_different_captures_or_none(part):
    """Three balls beside each other, of which one is drawn to nothing."""
    cushion = shape_ball(add_ball("Cushion"))
    tall = shape_ball(add_ball("Tall"), power=2.0, stretch=(1.0, 1.0, 3.0))
    balls = [add_ball(f"Ball {k}", subdivisions=4, location=(4 * k, 9, 0)) for k in range(3)]
    for ball, capture in zip(balls, (cushion, tall, None), strict=True):
        ball.cubic_craft.capture_object, ball.cubic_craft.capture_strength = capture, 1.0
        ball.cubic_craft.cubeness, ball.cubic_craft.refine = 0.0, "OFF"
    bpy.context.view_layer.update()
    settings_of = part("settings.properties").settings_of
    members = [part("read.member").read_member(ball, settings_of(ball)) for ball in balls]
    prepared = part("run.pipeline").prepare(members)
    one, other, none = part("run.pipeline").solve(prepared)
    at_rest = position_of(balls[0].data)
    assert np.abs(none.positions - at_rest).max() < 0.02
    assert np.abs(one.positions - at_rest).max() > 0.05
    assert np.ptp(other.positions[:, 2]) > 1.05 * np.ptp(one.positions[:, 2])


def test_the_panel_knows_when_the_ball_has_changed(part, reopen):
    changes_since = part("run.up_to_date").changes_since
    last_run = part("mesh_bridge").last_run
    cushion, obj = add_ball("Cushion", subdivisions=4), add_triangles()
    cubify(capture_object="Cushion", **OPTIONS)
    assert not changes_since(obj, last_run(obj))
    name = obj.name
    obj = reopen(name)
    cushion = bpy.data.objects["Cushion"]
    assert not changes_since(obj, last_run(obj))
    shape_ball(cushion)
    bpy.context.view_layer.update()
    assert changes_since(obj, last_run(obj)) == ["Normal Capture"]
    obj.cubic_craft.capture_strength = 0.7
    assert set(changes_since(obj, last_run(obj))) == {"Normal Capture", "Strength"}
    obj.cubic_craft.capture_object = None
    assert set(changes_since(obj, last_run(obj))) == {"Normal Capture", "Strength"}


def test_only_surfaces_can_be_picked(part):
    may_be = part("settings.properties")._may_be_capture
    monkey, ball, empty = add_monkey(), add_ball(), add_empty("Nothing")
    found = [may_be(monkey.cubic_craft, obj) for obj in (ball, empty, monkey)]
    assert found == [True, False, False]


def test_sides_can_be_flattened_whatever_has_become_of_the_ball():
    cushion, ball = shape_ball(add_ball("Cushion")), add_ball()
    cubify(capture_object="Cushion", cubeness=1.0, solidity=0.0, **OPTIONS)
    bpy.data.objects.remove(cushion)
    assert bpy.ops.cubic_craft.flatten(tolerance=0.05) == {"FINISHED"}
    assert share_facing(ball, AXES, 0.05) > 0.5
