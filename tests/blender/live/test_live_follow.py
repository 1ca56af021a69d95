# SPDX-License-Identifier: GPL-3.0-or-later
"""Live with New Object: the original is worked on, and a follower shows what becomes of it."""

import bmesh
import bpy
import numpy as np
import pytest
from live_steps import (
    add_monkey,
    bits,
    check_gone,
    check_same_as_cubify,
    confirm,
    follower_of,
    tick_to_rest,
)
from scene import edit_mode, select
from snapshot import differences, snapshot_mesh


def check_asleep_in_all_modes(session):
    for mode in ("EDIT", "SCULPT", "OBJECT"):
        bpy.ops.object.mode_set(mode=mode)
        tick_to_rest(session)
        for _ in range(3):
            bpy.context.view_layer.update()
            assert session._timer is None, f"woken in {mode}"


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
    session = tick_to_rest(follow(obj))
    follower = follower_of(obj)
    assert not differences(before, snapshot_mesh(obj.data))
    assert bits(follower) != bits(obj)
    assert follower.location.x > obj.location.x + 1.0 and bpy.context.object == obj
    shown = bits(follower)
    confirm(live, session)
    check_gone(live)
    assert bits(follower_of(obj)) == shown
    check_same_as_new_object(obj, follower_of(obj))


@pytest.mark.thorough(2)
@pytest.mark.parametrize("mode", ["SCULPT", "OBJECT", "WEIGHT_PAINT", "EDIT"])
def test_a_stroke_is_followed_and_ends_as_cubify_of_the_original(live, follow, mode):
    obj = add_monkey()
    session = tick_to_rest(follow(obj, keep_apart=True))
    shown = bits(follower_of(obj))
    bpy.ops.object.mode_set(mode=mode)
    tick_to_rest(session)
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
    tick_to_rest(session)
    confirm(live, session)
    assert obj.mode == mode
    bpy.ops.object.mode_set(mode="OBJECT")
    check_same_as_new_object(obj, follower_of(obj))


def test_what_is_carried_turns_with_the_surface_unless_all_moves_alike(part):
    turn = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    positions, original = np.arange(15.0).reshape(5, 3), np.zeros((5, 3), np.float32)
    solved = part("live.followed_mesh")._Solved(positions, np.tile(turn, (5, 1, 1)), original)
    way = np.float32([0.1, 0.2, 0.3])
    np.testing.assert_allclose(solved.carried(original + way), positions + way, atol=1e-6)
    strokes = original.copy()
    strokes[[0, 3], 0] = 1.0, -1.0
    np.testing.assert_allclose(solved.carried(strokes), positions + strokes @ turn.T, atol=1e-6)


def test_other_faces_are_followed_and_keep_their_material(live, follow):
    obj = add_monkey()
    session = tick_to_rest(follow(obj))
    follower_of(obj).data.materials.append(bpy.data.materials.new("Marble"))
    with edit_mode(obj):
        bpy.ops.mesh.select_all(action="SELECT")
        bpy.ops.mesh.subdivide()
        tick_to_rest(session)
        assert len(follower_of(obj).data.vertices) > 1500
    tick_to_rest(session)
    confirm(live, session)
    assert [m.name for m in follower_of(obj).data.materials] == ["Marble"]
    follower_of(obj).data.materials.clear()
    check_same_as_new_object(obj, follower_of(obj))


def test_while_it_waits_the_status_says_that_it_follows(follow):
    obj = add_monkey()
    session = tick_to_rest(follow(obj))
    assert session.meshes[0].run.status[0][-1] == "Converged"
    stroke(obj)
    session.tick(bpy.context)
    assert session.meshes[0].run.status[0][-1] == "Following"
    tick_to_rest(session)
    assert session.meshes[0].run.status[0][-1] == "Converged"


def test_what_live_writes_does_not_wake_it(follow):
    obj = add_monkey()
    session = tick_to_rest(follow(obj))
    check_asleep_in_all_modes(session)
    follower_of(obj).location.z += 1.0
    tick_to_rest(session)
    assert session._timer is None and not session.is_ended


def test_confirming_does_not_wait_for_a_pause_and_keeps_the_place(live, follow):
    obj = add_monkey()
    session = tick_to_rest(follow(obj))
    follower_of(obj).location = (5.0, 1.0, 2.0)
    stroke(obj)
    confirm(live, session)
    assert tuple(follower_of(obj).location) == (5.0, 1.0, 2.0)
    assert tuple(obj.location) == (0.0, 0.0, 0.0)
    keys = list(follower_of(obj).keys())
    assert not [key for key in keys if "follower" in key]
    check_same_as_new_object(obj, follower_of(obj))


@pytest.mark.thorough(2)
@pytest.mark.parametrize("mode", ["OBJECT", "EDIT", "SCULPT"])
def test_cancelling_removes_the_follower_and_keeps_the_strokes(live, follow, mode):
    obj = add_monkey()
    session = tick_to_rest(follow(obj))
    moved = stroke(obj)
    tick_to_rest(session)
    bpy.ops.object.mode_set(mode=mode)
    tick_to_rest(session)
    session.on(live.Event.CANCEL)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert [o.name for o in bpy.data.objects] == [obj.name] and len(bpy.data.meshes) == 1
    assert bits(obj) == moved.tobytes()
    check_gone(live)


def test_without_the_original_the_follower_stays_as_a_result(live, follow):
    obj = add_monkey()
    session = tick_to_rest(follow(obj))
    original, follower = bits(obj), follower_of(obj)
    shown = bits(follower)
    bpy.data.objects.remove(obj)
    tick_to_rest(session)
    assert session.is_ended and not session.error and "gone" in session.end_message
    check_gone(live)
    assert bits(follower) == shown
    select(follower)
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert bits(follower) == original


def test_without_the_follower_it_ends(live, follow):
    obj = add_monkey()
    session = tick_to_rest(follow(obj))
    bpy.data.objects.remove(follower_of(obj))
    bpy.context.view_layer.update()
    session.wake()
    tick_to_rest(session)
    assert session.is_ended and not session.error
    check_gone(live)
    assert [o.name for o in bpy.data.objects] == [obj.name]


@pytest.mark.parametrize("first", ["MESH", "NEW_OBJECT"])
def test_where_it_is_written_can_be_changed_meanwhile(live, begin, first):
    obj = add_monkey()
    before = bits(obj)
    session = tick_to_rest(begin(obj, result=first, cubeness=0.5))
    other = "MESH" if first == "NEW_OBJECT" else "NEW_OBJECT"
    live.live_properties().result = other
    tick_to_rest(session)
    assert (bits(obj) == before) == (other == "NEW_OBJECT")
    assert len(bpy.data.objects) == 1 + (other == "NEW_OBJECT")
    confirm(live, session)
    assert (bits(obj) == before) == (other == "NEW_OBJECT")


@pytest.mark.thorough(2)
@pytest.mark.parametrize("mode", ["OBJECT", "SCULPT", "EDIT"])
def test_a_file_saved_meanwhile_has_the_result_and_the_original(live, follow, mode, tmp_path):
    obj = add_monkey()
    session = tick_to_rest(follow(obj))
    stroke(obj)
    bpy.ops.object.mode_set(mode=mode)
    tick_to_rest(session)
    shown, original = bits(follower_of(obj)), bits(obj)
    follower_of(obj).location.z = 3.0
    path, name = str(tmp_path / "live.blend"), obj.name
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    tick_to_rest(session)
    assert not session.is_ended and bits(follower_of(obj)) == shown and obj.mode == mode
    session.on(live.Event.CANCEL)
    bpy.ops.wm.open_mainfile(filepath=path)
    obj = bpy.data.objects[name]
    assert bits(follower_of(obj)) == shown and bits(obj) == original
    assert follower_of(obj).location.z == 3.0 and len(bpy.data.objects) == 2
    bpy.ops.object.mode_set(mode="OBJECT")
    select(follower_of(obj))
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}


def test_a_file_that_blender_saves_by_itself_has_it_too(live, follow, tmp_path):
    obj = add_monkey()
    session = tick_to_rest(follow(obj))
    shown, path, name = bits(follower_of(obj)), str(tmp_path / "live.blend"), obj.name
    bpy.data.libraries.write(path, {bpy.context.scene}, fake_user=True)  # notifies nobody
    session.on(live.Event.CANCEL)
    bpy.ops.wm.open_mainfile(filepath=path)
    obj = bpy.data.objects[name]
    assert bits(follower_of(obj)) == shown != bits(obj)
    select(follower_of(obj))
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert bits(follower_of(obj)) == bits(obj)


def test_undo_and_redo_of_a_stroke_are_followed(live, follow):
    obj = add_monkey()
    name = obj.name
    bpy.ops.ed.undo_push(message="Monkey")
    session = tick_to_rest(follow(obj))
    bpy.ops.ed.undo_push(message="Before")
    shown = bits(follower_of(obj))
    stroke(obj)
    bpy.ops.ed.undo_push(message="Stroke")
    tick_to_rest(session)
    followed = bits(follower_of(obj))
    assert followed != shown
    for step, expected in ((bpy.ops.ed.undo, shown), (bpy.ops.ed.redo, followed)):
        step()
        tick_to_rest(session)
        obj = bpy.data.objects[name]
        assert not session.is_ended and bits(follower_of(obj)) == expected
        assert len(bpy.data.objects) == 2
    session.on(live.Event.CANCEL)
    bpy.ops.ed.undo_push(message="Cancelled")
    bpy.ops.ed.undo()
    assert list(bpy.data.objects.keys()) == [name], "an undo brings a follower without Live"


def test_a_shape_that_cannot_be_used_is_named_and_loses_nothing(live, follow):
    obj = add_monkey()
    session = tick_to_rest(follow(obj))
    shown = bits(follower_of(obj))
    points = stroke(obj)
    obj.data.vertices[3].co.x = float("nan")
    obj.data.update()
    tick_to_rest(session)
    assert not session.is_ended and bits(follower_of(obj)) == shown
    assert "not finite" in "; ".join(session.all_problems)
    obj.data.vertices[3].co.x = points[3, 0]
    obj.data.update()
    tick_to_rest(session)
    assert not session.all_problems and bits(follower_of(obj)) != shown
    confirm(live, session)
    check_same_as_new_object(obj, follower_of(obj))


def add_box():
    """Add a cube whose Subdivision modifier makes it round."""
    bpy.ops.mesh.primitive_cube_add()
    obj = bpy.context.object
    obj.cubic_craft.refine = "OFF"
    obj.modifiers.new("Subdivision", "SUBSURF").levels = 3
    return obj


def push_in(obj):
    obj.shape_key_add(name="Basis")
    obj.shape_key_add(name="Pushed", from_mix=False).points[0].co.x -= 0.5
    obj.data.shape_keys.key_blocks["Pushed"].value = 1.0


def set_levels(obj):
    obj.modifiers["Subdivision"].levels = 2


def edit_cage(obj):
    with edit_mode(obj):
        bm = bmesh.from_edit_mesh(obj.data)
        next(iter(bm.verts)).co.x += 0.5
        bmesh.update_edit_mesh(obj.data)


@pytest.mark.parametrize("change", [push_in, set_levels, edit_cage])
def test_what_modifiers_show_is_followed(live, follow, change):
    obj = add_box()
    session = tick_to_rest(follow(obj, with_modifiers=True))
    shown = bits(follower_of(obj))
    assert len(shown) > 12 * 300 and not follower_of(obj).modifiers
    change(obj)
    tick_to_rest(session)
    assert bits(follower_of(obj)) != shown and session._timer is None
    confirm(live, session)
    check_same_as_new_object(obj, follower_of(obj))


def test_with_modifiers_another_place_for_the_result_is_another_mesh(live, begin):
    obj = add_box()
    session = tick_to_rest(begin(obj, result="NEW_OBJECT", with_modifiers=True))
    live.live_properties().result = "MESH"
    confirm(live, tick_to_rest(session))
    check_same_as_cubify(obj)


def check_the_timeline_is_followed(live, follow, obj):
    bpy.context.scene.frame_set(1)
    session = tick_to_rest(follow(obj, with_modifiers=True))
    shown = bits(follower_of(obj))
    bpy.context.scene.frame_set(10)
    tick_to_rest(session)
    assert bits(follower_of(obj)) != shown
    confirm(live, session)
    check_same_as_new_object(obj, follower_of(obj))


@pytest.mark.thorough(3)
@pytest.mark.parametrize(
    ("owner", "name", "values"),
    [
        ("regions", "cubeness", (0.0, 1.0)),
        ("handles", "is_cubic", (True, False)),
        ("handles", "threshold", (0.9, 0.3)),
    ],
)
@pytest.mark.parametrize("is_moving", [True, False])
def test_settings_that_the_timeline_changes_are_followed(
    live, follow, owner, name, values, is_moving
):
    obj = add_box()
    push_in(obj)
    group = obj.vertex_groups.new(name="Upper")
    for vertex in obj.data.vertices:
        group.add([vertex.index], min(max(0.5 + vertex.co.z, 0.0), 1.0), "REPLACE")
    region = obj.cubic_craft.regions.add()
    region.group = "Upper"
    bpy.ops.cubic_craft.handle_add(group="Upper")
    keyed = getattr(obj.cubic_craft, owner)[0]
    key = obj.data.shape_keys.key_blocks["Pushed"]
    for frame, value in zip((1, 10), values, strict=True):
        setattr(keyed, name, value)
        keyed.keyframe_insert(name, frame=frame)
        key.value = frame / 10 if is_moving else 0.5
        key.keyframe_insert("value", frame=frame)
    check_the_timeline_is_followed(live, follow, obj)


def test_a_map_does_not_keep_it_awake_in_modes_that_cannot_be_read(follow):
    obj = add_monkey()
    obj.vertex_groups.new(name="Map").add(range(100), 0.5, "REPLACE")
    session = tick_to_rest(follow(obj, map_group="Map"))
    check_asleep_in_all_modes(session)


def test_painting_the_map_is_followed(live, follow):
    obj = add_monkey()
    group = obj.vertex_groups.new(name="Map")
    group.add(range(500), 1.0, "REPLACE")
    session = tick_to_rest(follow(obj, map_group="Map"))
    shown = bits(follower_of(obj))
    group.add(range(300), 0.2, "REPLACE")
    obj.data.update()
    tick_to_rest(session)
    assert bits(follower_of(obj)) != shown
    confirm(live, session)
    check_same_as_new_object(obj, follower_of(obj))


@pytest.mark.thorough(2)
@pytest.mark.parametrize("moved_by", ["keys", "strip", "driver", "constraint"])
def test_it_stands_beside_an_original_that_something_else_moves(live, follow, moved_by):
    obj = add_monkey()
    scene = bpy.context.scene
    if moved_by in ("keys", "strip"):
        for frame, height in ((1, 0.0), (10, 1.0)):
            obj.location.z = height
            obj.keyframe_insert("location", frame=frame)
        scene.frame_set(1)
        if moved_by == "strip":
            action, obj.animation_data.action = obj.animation_data.action, None
            obj.animation_data.nla_tracks.new().strips.new("Rise", 1, action)
    elif moved_by == "driver":
        obj.driver_add("location", 0).driver.expression = "0"
    else:
        place = bpy.data.objects.new("Place", None)
        scene.collection.objects.link(place)
        obj.constraints.new("COPY_LOCATION").target = place
    bpy.context.view_layer.update()

    def apart():
        bpy.context.view_layer.update()
        one, other = (o.matrix_world.translation for o in (obj, follower_of(obj)))
        return (one - other).length

    session = tick_to_rest(follow(obj))
    assert apart() > 1.5
    scene.frame_set(6)
    tick_to_rest(session)
    assert apart() > 1.5
    confirm(live, session)
    assert apart() > 1.5
    scene.frame_set(8)
    assert apart() > 1.5
