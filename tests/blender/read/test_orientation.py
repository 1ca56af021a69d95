# SPDX-License-Identifier: GPL-3.0-or-later
"""Which way the cube stands: spaces, the object's scale, and Auto Orient."""

import importlib
import math
import time

import bpy
import numpy as np
import pytest
from mathutils import Euler
from rich_mesh import position_of
from scene import add_empty, add_monkey, add_triangles, cubify, select
from snapshot import differences, snapshot_mesh


def test_world_orientation_equals_turning_the_cube_against_the_object():
    obj = add_monkey(rotation=(0.3, 0.2, 0.5))
    cubify(space="WORLD")
    by_world = position_of(obj.data)
    bpy.ops.cubic_craft.restore()
    inverse = obj.matrix_world.to_3x3().inverted().to_euler()
    cubify(space="OBJECT", orientation=tuple(inverse))
    np.testing.assert_allclose(position_of(obj.data), by_world, atol=1e-4)


RIGHT = math.pi / 2


@pytest.mark.thorough(2)
@pytest.mark.parametrize("together", ["PARTS", "SELECTION"])
@pytest.mark.parametrize(
    ("turn", "scale"),
    [
        ((0.0, 0.0, 0.0), (1.0, 1.0, 1.0)),
        ((0.0, 0.0, 0.0), (2.0, 0.5, 1.3)),
        ((RIGHT, 0.0, 0.0), (1.0, 1.0, 1.0)),  # as imported files stand
        ((RIGHT, 0.0, -RIGHT), (0.01, 0.01, 0.01)),
        ((0.0, 0.0, 0.0), (-1.0, 1.0, 1.0)),
    ],
)
def test_an_object_that_stands_straight_has_the_same_bits_in_both_spaces(turn, scale, together):
    obj = add_triangles()
    obj.location, obj.rotation_euler, obj.scale = (1.0, 2.0, 3.0), turn, scale
    bpy.context.view_layer.update()
    shapes = []
    for space in ("OBJECT", "WORLD"):
        # On a finer copy it takes several times as long.
        refine = "AUTO" if together == "PARTS" else "OFF"
        cubify(space=space, together=together, cubeness=0.7, refine=refine)
        shapes.append(position_of(obj.data).tobytes())
        bpy.ops.cubic_craft.restore()
    assert shapes[0] == shapes[1] != position_of(obj.data).tobytes()


def test_the_frame_object_gives_the_orientation():
    frame = add_empty("Frame", rotation_euler=(0.2, -0.3, 0.4))
    obj = add_monkey()
    cubify(space="FRAME", frame="Frame")
    by_frame = position_of(obj.data)
    assert obj.cubic_craft.frame == frame
    cubify(space="WORLD", orientation=(0.2, -0.3, 0.4))
    np.testing.assert_allclose(position_of(obj.data), by_frame, atol=1e-4)


def test_a_scaled_object_is_solved_as_it_is_seen():
    obj = add_triangles()
    obj.scale = (1.0, 2.0, -0.5)
    bpy.context.view_layer.update()
    cubify()
    seen = position_of(obj.data) * np.array(obj.scale)
    modelled = add_triangles()
    positions = position_of(modelled.data) * np.array((1.0, 2.0, 0.5))
    modelled.data.vertices.foreach_set("co", positions.astype(np.float32).ravel())
    modelled.data.update()
    cubify()
    np.testing.assert_allclose(position_of(modelled.data), seen * [1.0, 1.0, -1.0], atol=1e-4)


def add_turned_box(space, **where):
    """Add a box whose sides are turned against its own axes."""
    bpy.ops.mesh.primitive_cube_add(**where)
    obj = bpy.context.object
    obj.data.transform(Euler((0.3, 0.2, -0.4)).to_matrix().to_4x4())
    obj.cubic_craft.space = space
    return obj


@pytest.mark.parametrize("space", ["OBJECT", "WORLD", "FRAME"])
@pytest.mark.parametrize("mirror", [1.0, -1.0])
def test_auto_orient_finds_a_turned_box_in_every_space(extension, space, mirror):
    frame = add_empty("Frame", rotation_euler=(0.5, 0.1, 0.2))
    obj = add_turned_box(space, rotation=(0.1, 0.7, 0.3))
    obj.scale.x = mirror
    obj.cubic_craft.frame = frame
    bpy.context.view_layer.update()
    before = snapshot_mesh(obj.data)
    assert bpy.ops.cubic_craft.auto_orient() == {"FINISHED"}
    assert differences(before, snapshot_mesh(obj.data)) == []
    assert max(abs(angle) for angle in obj.cubic_craft.orientation) < 1.1
    room = f"{extension.__name__}.cubic_craft_addon"
    settings = importlib.import_module(f"{room}.settings.properties").settings_of(obj)
    frame_of = importlib.import_module(f"{room}.read.object_frame").stretch_and_orientation
    stretch, Q = frame_of(obj, settings)
    corners = position_of(obj.data) @ stretch.T @ Q.T  # as the cube sees them
    np.testing.assert_allclose(np.abs(corners), np.abs(corners[0]) * np.ones((8, 3)), atol=1e-3)


@pytest.mark.parametrize("space", ["OBJECT", "WORLD", "FRAME"])
def test_the_overlay_shows_the_sides_of_the_cube_in_the_world(part, space):
    overlay = part("form.overlay")
    obj = add_turned_box(space, rotation=(0.1, 0.7, 0.3), location=(5, 6, 7))
    obj.cubic_craft.frame = obj
    bpy.context.view_layer.update()
    bpy.ops.cubic_craft.auto_orient()
    points, colors = overlay.lines_of(obj)
    assert points.shape == (30, 3) and len(colors) == 30
    # The sides of the box face along the axes of the overlay.
    axes = points[1:6:2] - points[0:6:2]
    np.testing.assert_allclose(points[0], (5, 6, 7), atol=1e-5)
    world = np.array(obj.matrix_world.to_3x3())
    normals = np.array([world @ np.array(p.normal) for p in obj.data.polygons])
    along = np.abs(normals @ (axes / np.linalg.norm(axes, axis=1, keepdims=True)).T)
    np.testing.assert_allclose(along.max(axis=1), 1.0, atol=1e-4)
    lengths = np.linalg.norm(points[7::2] - points[6::2], axis=1)
    np.testing.assert_allclose(lengths, 2 * np.linalg.norm(axes[0]), rtol=1e-5)


def test_the_cube_is_seen_for_a_moment_when_an_angle_is_changed(part, live, begin, monkeypatch):
    glimpse = part("screen.glimpse")
    obj = add_monkey()

    def is_seen_after(change):
        glimpse.forget()
        assert not glimpse.is_seen()
        change()
        return glimpse.is_seen()

    settings = obj.cubic_craft
    assert is_seen_after(lambda: setattr(settings, "orientation", (0.0, 0.0, 0.3)))
    assert is_seen_after(lambda: bpy.ops.cubic_craft.auto_orient())
    for name, value in (("cubeness", 0.3), ("space", "WORLD"), ("form", "OCTAHEDRON")):
        assert not is_seen_after(lambda name=name, value=value: setattr(settings, name, value))
    settings.form, settings.orientation = "CUBE", (0.1, 0.2, 0.3)
    other = add_monkey("Other")
    select(obj, other)
    assert not is_seen_after(lambda: cubify(max_iterations=1)), "all get the settings of the first"
    assert tuple(other.cubic_craft.orientation) == pytest.approx((0.1, 0.2, 0.3))
    select(obj)
    assert not is_seen_after(lambda: begin(obj)), "to begin Live turns nothing"
    session, in_live = live.current(), live.live_properties()
    assert is_seen_after(lambda: setattr(in_live, "orientation", (0.0, 0.4, 0.3)))
    session.tick(bpy.context)
    assert session.tasks[0].settings.orientation[1] == pytest.approx(0.4), "Live is told as well"
    assert not is_seen_after(lambda: setattr(in_live, "cubeness", 0.8))
    assert not is_seen_after(lambda: session.take_back() and session.take_back())
    assert in_live.orientation[1] == pytest.approx(0.2), "Ctrl-Z in Live"
    monkeypatch.setattr(glimpse, "SECONDS", 0.01)
    in_live.orientation = (0.0, 0.0, 0.0)
    time.sleep(0.02)
    assert not glimpse.is_seen()


def test_the_overlay_leaves_no_handler_behind(extension, part):
    overlay = part("form.overlay")
    bpy.ops.preferences.addon_disable(module=extension.__name__)
    assert overlay._handle is None
    assert not hasattr(bpy.types.WindowManager, overlay.PROPERTY)
    bpy.ops.preferences.addon_enable(module=extension.__name__)
    assert hasattr(bpy.types.WindowManager, overlay.PROPERTY)
