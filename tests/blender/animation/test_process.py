# SPDX-License-Identifier: GPL-3.0-or-later
"""Bake Process: the way from the original, or from other settings, to the cubic shape."""

import math

import numpy as np
import pytest

import bpy  # isort: skip
from rig import FRAMES, bending_ball, flatness, read_pc2, shown  # isort: skip
from scene import select  # isort: skip


@pytest.fixture
def bending(empty_file):
    return bending_ball(4)


@pytest.mark.thorough(1)
@pytest.mark.parametrize("count", [FRAMES, 40])
def test_the_process_goes_from_the_original_to_the_result_at_even_speed(
    extension, bending, tmp_path, count
):
    bpy.context.scene.frame_end = count
    bpy.context.scene.frame_set(4)
    start = shown(bending, 4)
    assert bpy.ops.cubic_craft.bake_process(folder=str(tmp_path)) == {"FINISHED"}
    assert [path.name for path in tmp_path.iterdir()] == ["Ball.process.pc2"]
    frames = read_pc2(tmp_path / "Ball.process.pc2")
    assert len(frames) == count
    np.testing.assert_allclose(frames[0], start, atol=1e-5)
    steps = np.linalg.norm(np.diff(frames, axis=0), axis=2).max(axis=1)
    assert steps.max() < 1.35 * np.median(steps) and steps.min() > 0.4 * np.median(steps)
    flat = [flatness(frame, bending.data) for frame in frames]
    assert flat[-1] > flat[0] + 0.3
    # as cubic as by a click
    bpy.context.scene.frame_set(4)
    bending.hide_set(False)
    select(bending)
    bpy.ops.cubic_craft.cubify(result="NEW_OBJECT", with_modifiers=True)
    clicked = flatness(shown(bpy.context.object, 4), bending.data)
    assert abs(flat[-1] - clicked) < 0.05


def test_the_process_can_be_dialled_by_absolute_keys(extension, bending, tmp_path):
    assert bpy.ops.cubic_craft.bake_process(folder=str(tmp_path), format="SHAPE_KEYS")
    cubic = bpy.context.object
    keys = cubic.data.shape_keys
    assert not keys.use_relative and len(keys.key_blocks) == FRAMES
    first, last = (shown(cubic, frame) for frame in (1, FRAMES))
    np.testing.assert_allclose(first, shown(bending, 1), atol=1e-5)
    keys.animation_data_clear()
    keys.eval_time = keys.key_blocks[-1].frame
    bpy.context.scene.frame_set(1)
    np.testing.assert_allclose(shown(cubic, 1), last, atol=1e-5)


@pytest.fixture
def model(bending):
    """Return another object, for its settings."""
    bpy.ops.mesh.primitive_cube_add(location=(5, 0, 0))
    cube = bpy.context.object
    cube.name = "Begin"
    cube.cubic_craft.refine = bending.cubic_craft.refine
    bpy.context.scene.frame_set(1)
    select(bending)
    return cube


WAYS = {
    # soft, as a triangle between two sides may belong to either
    "cubeness": ({"cubeness": 0.1, "crispness": 0.0}, {"cubeness": 1.0, "crispness": 0.0}),
    "crispness": ({"crispness": 0.0}, {"crispness": 1.0}),
    "less": ({"cubeness": 1.0}, {"cubeness": 0.0}),
    "form": ({"form": "OCTAHEDRON", "cubeness": 0.8}, {"cubeness": 0.8}),
    "orientation": ({}, {"orientation": (0.0, 0.0, math.radians(40))}),
    # The ball has nothing to keep its thickness by, but on a finer copy.
    "solidity": (
        {"solidity": 0.02, "refine": "AUTO", "crispness": 0.0},
        {"solidity": 1.0, "crispness": 0.0},
    ),
}


def give(obj, values):
    for name, value in values.items():
        setattr(obj.cubic_craft, name, value)


def clicked(obj):
    """Return the shape that Cubify gives to what is seen of an object."""
    obj.hide_set(False)
    select(obj)
    bpy.ops.cubic_craft.cubify(result="NEW_OBJECT", with_modifiers=True)
    new = bpy.context.object
    points = shown(new, 1)
    bpy.data.objects.remove(new)
    obj.hide_set(False)
    return points


@pytest.mark.thorough(2)
@pytest.mark.parametrize("name", WAYS)
def test_the_process_goes_from_other_settings_to_those_of_the_object(
    extension, bending, model, tmp_path, name
):
    first, last = WAYS[name]
    give(bending, first)
    begin = clicked(bending)
    for key in first:
        bending.cubic_craft.property_unset(key)
    give(model, first)
    give(bending, last)
    end = clicked(bending)
    bpy.context.scene.cubic_craft_animation.process_from = model
    select(bending)
    assert bpy.ops.cubic_craft.bake_process(folder=str(tmp_path)) == {"FINISHED"}
    frames = read_pc2(tmp_path / "Ball.process.pc2")
    way = np.linalg.norm(end - begin, axis=1).max()
    assert np.linalg.norm(frames[0] - begin, axis=1).max() < 0.15 * way, "it begins elsewhere"
    assert np.linalg.norm(frames[-1] - end, axis=1).max() < 0.15 * way, "it ends elsewhere"
    steps = np.linalg.norm(np.diff(frames, axis=0), axis=2).max(axis=1)
    assert steps.max() < 1.4 * np.median(steps) and steps.min() > 0.3 * np.median(steps)


def test_the_object_can_be_named_and_must_be_there(extension, bending, model, tmp_path):
    give(model, {"cubeness": 1.0})
    bake = bpy.ops.cubic_craft.bake_process
    assert bake(folder=str(tmp_path), process_from="Begin") == {"FINISHED"}
    first = read_pc2(tmp_path / "Ball.process.pc2")[0]
    assert np.abs(first - shown(bending, 1)).max() > 0.1, "it begins with the original"
    with pytest.raises(RuntimeError, match='no object "Bgin"'):
        bake(folder=str(tmp_path), process_from="Bgin")


def test_there_is_no_way_between_settings_that_are_solved_on_other_vertices(
    extension, model, tmp_path
):
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=2)
    coarse = bpy.context.object
    with pytest.raises(RuntimeError, match="no way from settings with other"):
        bpy.ops.cubic_craft.bake_process(folder=str(tmp_path), process_from="Begin")
    assert bpy.context.object == coarse and not coarse.hide_get()


@pytest.mark.parametrize(("space", "angle"), [("WORLD", 0.3), ("OBJECT", 0.4)])
def test_angles_are_between_others_only_where_both_are_relative_to_the_same(part, space, angle):
    settings = part("settings.values").Settings
    start = settings(orientation=(0.0, 0.0, 0.2), space="WORLD")
    end = settings(orientation=(0.0, 0.0, 0.4), space=space)
    found = part("animation.sources").on_the_way(start, end, 0.5)
    assert found.orientation == pytest.approx((0.0, 0.0, angle), abs=1e-6)
