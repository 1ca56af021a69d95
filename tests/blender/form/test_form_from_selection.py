# SPDX-License-Identifier: GPL-3.0-or-later
"""Directions from Selection: selected faces become the sides of the form."""

import bmesh
import bpy
import numpy as np
import pytest
from live_steps import bits, confirm, tick_to_rest
from mathutils import Matrix
from scene import add_empty, add_monkey, add_triangles, cubify, select
from solids import share_facing

OPTIONS = {"refine": "OFF", "max_iterations": 200}
GIVEN = "0 0 1, 1 0 0, 0 1 0"


@pytest.fixture
def seen_sides(part):
    """Return a function that returns the normals of the form of an object in world space."""
    settings_of, form_of = part("settings.properties").settings_of, part("form.body").form_of
    world_axes = part("read.object_frame").world_axes

    def sides(obj):
        settings = settings_of(obj)
        return form_of(settings).normals @ world_axes(obj, settings).T

    return sides


@pytest.fixture(autouse=True)
def object_mode():
    yield
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")


def add_dodecahedron_faces(count=12):
    """Add a hull with twelve sides, in Edit Mode, of which so many faces are selected."""
    g = (1 + 5**0.5) / 2
    corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
    for a in (-1 / g, 1 / g):
        for b in (-g, g):
            corners += [(0, a, b), (a, b, 0), (b, 0, a)]
    hull, mesh = bmesh.new(), bpy.data.meshes.new("Hull")
    for corner in corners:
        hull.verts.new(corner)
    bmesh.ops.convex_hull(hull, input=hull.verts[:])
    bmesh.ops.dissolve_limit(hull, angle_limit=0.01, verts=hull.verts, edges=hull.edges)
    bmesh.ops.recalc_face_normals(hull, faces=hull.faces[:])
    assert len(hull.faces) == 12
    hull.to_mesh(mesh)
    hull.free()
    obj = bpy.data.objects.new("Hull", mesh)
    bpy.context.collection.objects.link(obj)
    select(obj)
    edit_faces(obj, range(count))
    return obj


def edit_faces(obj, indices):
    """Enter Edit Mode with these faces selected."""
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    edited = bmesh.from_edit_mesh(obj.data)
    edited.faces.ensure_lookup_table()
    for index in indices:
        edited.faces[index].select_set(True)
    bmesh.update_edit_mesh(obj.data)


def selected_normals(obj):
    """Return the unit normals of the selected faces in world space."""
    matrix = np.array(obj.matrix_world.to_3x3())
    cofactors = np.linalg.det(matrix) * np.linalg.inv(matrix).T
    faces = [np.array(f.normal) for f in bmesh.from_edit_mesh(obj.data).faces if f.select]
    seen = np.array(faces) @ cofactors.T * np.sign(np.linalg.det(matrix))
    return seen / np.linalg.norm(seen, axis=1, keepdims=True)


def pick():
    assert bpy.ops.cubic_craft.form_from_selection() == {"FINISHED"}


def check_has_sides(found, wanted):
    assert (wanted @ found.T).max(axis=1).min() > 1 - 1e-5


@pytest.mark.parametrize("space", ["OBJECT", "WORLD", "FRAME"])
@pytest.mark.parametrize("scale", [(1, 1, 1), (1, 2, 0.5), (-1, 1, 1), (-1, 0.5, 2)])
def test_the_faces_are_sides_whatever_the_angles_are_relative_to(seen_sides, space, scale):
    obj = add_dodecahedron_faces(5)
    frame = add_empty("Axes")
    frame.rotation_euler = (0.4, 0.1, -0.7)
    obj.rotation_euler, obj.scale = (0.3, -0.5, 0.9), scale
    settings = obj.cubic_craft
    settings.space, settings.frame, settings.orientation = space, frame, (0.2, 0.7, -0.3)
    bpy.context.view_layer.update()
    select_edited = selected_normals(obj)
    bpy.context.view_layer.objects.active = obj
    pick()
    assert settings.form == "FACES"
    check_has_sides(seen_sides(obj), select_edited)


def test_a_ball_becomes_the_form_and_comes_back(seen_sides):
    hull = add_dodecahedron_faces()
    pick()
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=5)
    ball = bpy.context.object
    ball.cubic_craft.form_directions = hull.cubic_craft.form_directions
    ball.cubic_craft.form = "FACES"
    before, sides = bits(ball), seen_sides(ball)
    assert len(sides) == 12
    cubify(cubeness=1.0, solidity=0.0, **OPTIONS)
    assert share_facing(ball, sides) > 0.8
    assert bpy.ops.cubic_craft.flatten(tolerance=0.05) == {"FINISHED"}
    bpy.ops.cubic_craft.restore()
    assert bits(ball) == before


def test_facets_are_those_that_it_was_made_with():
    hull = add_dodecahedron_faces()
    pick()
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=5)
    ball = bpy.context.object
    cubify(
        form="FACES",
        form_directions=hull.cubic_craft.form_directions,
        cubeness=1.0,
        solidity=0.0,
        **OPTIONS,
    )
    assert ball.cubic_craft.form_directions == hull.cubic_craft.form_directions
    shape = bits(ball)
    assert bpy.ops.cubic_craft.flatten(tolerance=0.05) == {"FINISHED"}
    flat = bits(ball)
    bpy.ops.cubic_craft.cubify()
    assert bits(ball) == shape
    ball.cubic_craft.form_directions = GIVEN
    assert bpy.ops.cubic_craft.flatten(tolerance=0.05) == {"FINISHED"}
    assert bits(ball) == flat


@pytest.mark.parametrize("count", [1, 2, 3])
def test_open_sides_are_completed(seen_sides, count):
    obj = add_dodecahedron_faces(count)
    wanted = selected_normals(obj)
    pick()
    sides = seen_sides(obj)
    assert len(sides) >= 6
    check_has_sides(sides, np.concatenate([wanted, -wanted]))


def test_many_directions_are_few(part, seen_sides):
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=4)
    obj = bpy.context.object
    edit_faces(obj, [polygon.index for polygon in obj.data.polygons if polygon.center.z > 0.2])
    pick()
    assert 20 <= len(seen_sides(obj)) <= part("form.body").MOST_DIRECTIONS


def test_it_is_one_undo_step_back_into_edit_mode():
    obj = add_dodecahedron_faces(4)
    bpy.ops.ed.undo_push(message="Select")
    assert bpy.ops.cubic_craft.form_from_selection("INVOKE_DEFAULT", True) == {"FINISHED"}
    assert bpy.context.mode == "OBJECT"
    picked = obj.cubic_craft.form_directions
    bpy.ops.ed.undo()
    obj = bpy.data.objects["Hull"]
    assert bpy.context.mode == "EDIT_MESH" and obj.data.total_face_sel == 4
    assert obj.cubic_craft.form == "CUBE" and not obj.cubic_craft.form_directions
    bpy.ops.ed.redo()
    obj = bpy.data.objects["Hull"]
    assert obj.cubic_craft.form == "FACES" and obj.cubic_craft.form_directions == picked


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "no faces were picked for the form; select some in Edit Mode"),
        ("0 0 up", '"0 0 up" is not a list of directions; write three numbers'),
        ("0 0 1, 1 0", "is not a list of directions"),
        ("0 0 1, 0 0 0", "must be finite, and not zero"),
        ("0 0 nan", "must be finite, and not zero"),
        (", ".join(f"{k} {k * k} 1" for k in range(60)), r"the form has 120 directions; give at"),
    ],
)
def test_directions_that_cannot_be_used_are_said(text, words):
    obj = add_monkey()
    before = bits(obj)
    with pytest.raises(RuntimeError, match=words):
        cubify(form="FACES", form_directions=text)
    assert bits(obj) == before


def test_selections_that_cannot_be_used_are_said():
    operator = bpy.ops.cubic_craft.form_from_selection
    obj = add_dodecahedron_faces(0)
    with pytest.raises(RuntimeError, match="No face is selected; select some in Edit Mode"):
        operator()
    bpy.ops.object.mode_set(mode="OBJECT")
    with pytest.raises(RuntimeError, match="Switch to Edit Mode and select faces first"):
        operator()
    obj.data.transform(Matrix.Scale(0.0, 4))
    edit_faces(obj, range(12))
    with pytest.raises(RuntimeError, match='selected faces of "Hull" have no area; select others'):
        operator()
    assert obj.mode == "EDIT" and obj.cubic_craft.form == "CUBE"


def test_it_is_refused_while_live_runs(live, begin):
    session = tick_to_rest(begin(add_triangles()))
    with pytest.raises(RuntimeError, match="Confirm or cancel Live first"):
        bpy.ops.cubic_craft.form_from_selection()
    confirm(live, session)
