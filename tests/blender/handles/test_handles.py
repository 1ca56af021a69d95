# SPDX-License-Identifier: GPL-3.0-or-later
"""Handles: what is held stays or goes where it is told, and the rest follows."""

import bpy
import numpy as np
import pytest
from mathutils import Matrix
from posing import IDENTITY, LEFT, RIGHT, add_posable, follow, mapped, pin, pose
from rich_mesh import position_of
from scene import add_copy, add_empty, cubify, given, select


@pytest.mark.parametrize("cubeness", [0.0, 0.6])
@pytest.mark.parametrize(
    "where",
    [
        {},
        {"location": (50, -20, 3), "rotation_euler": (0.4, 1.2, -2.0)},
        {"scale": (1.0, 2.0, -0.5), "rotation_euler": (0.4, 1.2, -2.0)},
    ],
)
def test_what_is_held_is_exactly_where_it_should_be_and_the_rest_follows(posed, cubeness, where):
    obj, left, right = add_posable(**where)
    before = position_of(obj.data)
    pose(obj)
    matrix = posed(obj)[1].matrix
    assert matrix != IDENTITY
    assert cubify(cubeness=cubeness) == {"FINISHED"}
    after = position_of(obj.data)
    assert after[left].tobytes() == before[left].tobytes()
    wanted = mapped(before[right], matrix)
    if "scale" in where:  # the stretch of the object and back costs the last bit
        np.testing.assert_allclose(after[right], wanted, rtol=3e-7, atol=1e-7)
    else:
        assert after[right].tobytes() == wanted.tobytes()
    free = np.setdiff1d(np.arange(len(before)), [*left, *right])
    assert np.abs(after[free] - before[free]).max() > 0.1
    assert np.isfinite(after).all()


def test_a_target_moves_rotates_and_scales_the_vertices_about_itself():
    obj, _, right = add_posable(location=(3, 2, 1), rotation_euler=(0.2, 0.3, 0.4))
    before = position_of(obj.data)
    pin(obj, LEFT)
    empty = follow(obj, RIGHT)
    here = np.array(obj.matrix_world) @ np.append(empty.location, 1.0)
    turn = Matrix.LocRotScale((0, 0, 1), Matrix.Rotation(0.5, 3, "X"), (1.5, 1.5, 1.5))
    centre = Matrix.Translation(here[:3])
    empty.matrix_world = centre @ turn @ centre.inverted() @ empty.matrix_world
    cubify(cubeness=0.0)
    world = np.array(obj.matrix_world)
    wanted = mapped(before[right], np.array(centre @ turn @ centre.inverted()) @ world)
    np.testing.assert_allclose(mapped(position_of(obj.data)[right], world), wanted, atol=2e-6)


def test_the_switch_turns_all_handles_off(posed):
    obj, left, _ = add_posable()
    before = position_of(obj.data)
    pose(obj)
    obj.cubic_craft.use_handles = False
    assert posed(obj) == ()
    cubify()
    assert position_of(obj.data)[left].tobytes() != before[left].tobytes()
    cubify(use_handles=True)
    assert position_of(obj.data)[left].tobytes() == before[left].tobytes()
    assert obj.cubic_craft.use_handles


def test_where_handles_overlap_the_first_counts():
    obj, left, _ = add_posable()
    before = position_of(obj.data)
    obj.vertex_groups.new(name="More").add(range(len(before) // 2), 1.0, "REPLACE")
    pin(obj, LEFT)
    empty = follow(obj, "More")
    empty.location.z += 1
    more = np.setdiff1d(np.arange(len(before) // 2), left)
    cubify()
    assert position_of(obj.data)[left].tobytes() == before[left].tobytes()
    np.testing.assert_allclose(position_of(obj.data)[more], before[more] + [0, 0, 1], atol=1e-6)
    obj.cubic_craft.handles.move(1, 0)
    both = np.intersect1d(np.arange(len(before) // 2), left)
    cubify()
    np.testing.assert_allclose(position_of(obj.data)[both], before[both] + [0, 0, 1], atol=1e-6)


def test_the_threshold_says_how_much_weight_is_needed():
    obj, _, _ = add_posable()
    group = obj.vertex_groups.new(name="Soft")
    for vertex, weight in ((3, 0.2), (50, 0.5), (90, 1.0)):
        group.add([vertex], weight, "REPLACE")
    before = position_of(obj.data)
    handle = pin(obj, "Soft")
    for threshold, held in ((0.5, [50, 90]), (0.1, [3, 50, 90]), (1.0, [90])):
        handle.threshold = threshold
        cubify(cubeness=0.8)
        after = position_of(obj.data)
        still = [v for v in (3, 50, 90) if after[v].tobytes() == before[v].tobytes()]
        assert still == held


def test_a_deleted_target_leaves_the_vertices_at_rest_and_undo_of_it_would_not(posed):
    obj, _, right = add_posable()
    before = position_of(obj.data)
    empty = pose(obj)
    select(empty)
    bpy.ops.object.delete()
    assert posed(obj)[1].matrix == IDENTITY
    select(obj)
    cubify()
    assert position_of(obj.data)[right].tobytes() == before[right].tobytes()
    bpy.context.collection.objects.link(empty)
    assert posed(obj)[1].matrix != IDENTITY


def move_about(obj):
    """Give every kind of place that an object may have."""
    rng = np.random.default_rng(3)
    for distance in (1.0, 100.0, 1e5):
        obj.location = rng.normal(size=3) * distance
        obj.rotation_euler = rng.normal(size=3)
        obj.scale = rng.uniform(0.5, 2.0, size=3)
        bpy.context.view_layer.update()
        yield


def test_moving_object_and_free_target_together_keeps_a_still_handle_exactly_still(posed):
    obj, _, _ = add_posable(location=(10, 20, 30))
    target = add_empty("Target", location=(11, 20, 30))
    pin(obj, RIGHT).target = target
    parent = add_empty("Both")
    for child in (obj, target):
        child.parent = parent
    for _ in move_about(parent):
        assert posed(obj)[0].matrix == IDENTITY


@pytest.mark.parametrize("culprit", ["target", "object"])
def test_a_scale_of_zero_is_refused_with_the_cure(posed, culprit):
    obj, _, _ = add_posable()
    target = add_empty("Target")
    pin(obj, RIGHT).target = target
    (target if culprit == "target" else obj).scale = (0, 1, 1)
    bpy.context.view_layer.update()
    with pytest.raises(ValueError, match=r"Body.*scale of zero.*Alt-S"):
        posed(obj)
    with pytest.raises(RuntimeError, match=r"Body.*scale of zero.*Alt-S"):
        cubify()


def test_a_target_of_zero_scale_is_not_taken(posed):
    obj, _, _ = add_posable()
    target = add_empty("Target")
    target.scale.x = 0
    handle = pin(obj, RIGHT)
    handle.target = target
    assert handle.target is None
    assert posed(obj)[0].matrix == IDENTITY


def test_an_object_cannot_follow_itself(posed):
    obj, _, _ = add_posable()
    pin(obj, RIGHT).target = obj
    with pytest.raises(ValueError, match="follows the object itself"):
        posed(obj)


def test_scripts_give_handles_in_place_of_the_objects_own():
    obj, left, right = add_posable()
    before = position_of(obj.data)
    pin(obj, RIGHT)
    up = Matrix.Translation((0, 0, 1))
    assert cubify(handles=[given(LEFT), given(RIGHT, up)]) == {"FINISHED"}
    after = position_of(obj.data)
    assert after[left].tobytes() == before[left].tobytes()
    np.testing.assert_allclose(after[right], before[right] + [0, 0, 1], atol=1e-6)
    assert [handle.group for handle in obj.cubic_craft.handles] == [RIGHT]
    cubify()  # the handles given before are forgotten
    assert position_of(obj.data)[right].tobytes() == before[right].tobytes()


def test_a_matrix_that_is_no_affine_map_is_refused():
    add_posable()
    with pytest.raises(RuntimeError, match=r"Right.*not an affine map.*mathutils"):
        cubify(handles=[given(RIGHT, Matrix.Translation((0, 0, 1)).transposed())])


@pytest.mark.parametrize("way", ["apply", "edit"])
@pytest.mark.parametrize("result", ["MESH", "NEW_OBJECT"])
def test_a_pose_that_is_part_of_the_original_is_not_done_twice(posed, way, result):
    obj, _, right = add_posable(location=(3, 2, 1))
    empty = pose(obj)
    cubify(cubeness=0.2, result=result)
    obj = bpy.context.object if result == "NEW_OBJECT" else obj
    select(obj)
    once = position_of(obj.data)
    if way == "apply":
        bpy.ops.cubic_craft.apply()
    else:
        obj.data.vertices[int(right[0])].co.z += 0.01
        obj.data.update()
        once = position_of(obj.data)
    empty.location.z += 0.5  # since it was written
    cubify(cubeness=0.0, result="MESH", start="HERE")
    np.testing.assert_allclose(
        position_of(obj.data)[right], once[right] + [0, 0, 0.5], rtol=0, atol=2e-6
    )


@pytest.mark.parametrize("how", ["restored", "key", "switched off", "given"])
def test_a_pose_that_is_not_in_the_mesh_is_still_done_after_apply(posed, how):
    obj, _, _ = add_posable()
    pose(obj)
    before = posed(obj)
    cubify()
    if how == "restored":
        bpy.ops.cubic_craft.restore()
    options = {
        "restored": {"use_handles": False},
        "key": {"result": "SHAPE_KEY"},
        "switched off": {"use_handles": False},
        "given": {"handles": [given(LEFT)]},
    }
    cubify(**options[how])
    bpy.ops.cubic_craft.apply()
    obj.cubic_craft.use_handles = True
    assert posed(obj) == before


def test_apply_counts_for_all_objects_that_share_the_mesh(posed):
    obj, _, _ = add_posable()
    pose(obj)
    twin = add_copy(obj, is_linked=True)
    twin.location.x = 5
    select(obj)
    cubify()
    bpy.ops.cubic_craft.apply()
    assert [handle.matrix for handle in posed(obj)] == [IDENTITY] * 2
    assert posed(twin) == posed(obj)


def test_apply_leaves_another_pose_of_an_object_that_shares_the_mesh():
    obj, _, _ = add_posable()
    raised, higher = (Matrix.Translation((0.0, 0.0, z)) for z in (0.5, 1.0))
    pin(obj, RIGHT).pose = raised
    twin = add_copy(obj, is_linked=True)
    twin.cubic_craft.handles[0].pose = higher
    select(obj)
    cubify()
    bpy.ops.cubic_craft.apply()
    assert [one.cubic_craft.handles[0].pose for one in (obj, twin)] == [Matrix(), higher]
