# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators as the artist and a script use them, on the installed extension."""

import dataclasses
import importlib
from functools import partial

import bpy
import numpy as np
import pytest
from rich_mesh import add_rich_monkey, position_of
from scene import add_copy, add_empty, add_monkey, add_triangles, cubify, reports_of, select
from snapshot import POSITIONS, STORED, differences, snapshot_object

# What a run leaves on the object beside its mesh: its settings and the text of its last run.
SETTINGS = ("rna/cubic_craft*", "*custom/custom cubic_craft*")


def alignment(mesh, positions):
    mesh.calc_loop_triangles()
    F = np.array([t.vertices for t in mesh.loop_triangles])
    normals = np.cross(*(positions[F[:, k]] - positions[F[:, 0]] for k in (1, 2)))
    return np.abs(normals).max(axis=1).sum() / np.linalg.norm(normals, axis=1).sum()


def test_cubify_makes_it_cubic_and_restore_gives_the_original_bits():
    obj = add_triangles()
    before = position_of(obj.data)
    assert cubify(cubeness=0.8) == {"FINISHED"}
    after = position_of(obj.data)
    assert alignment(obj.data, after) > alignment(obj.data, before) + 0.05
    assert "642 vertices" in obj.cubic_craft.status
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert position_of(obj.data).tobytes() == before.tobytes()
    assert obj.cubic_craft.status == ""


@pytest.mark.parametrize("keys", [False, True])
@pytest.mark.parametrize("result", ["MESH", "SHAPE_KEY", "NEW_OBJECT"])
def test_all_else_stays_bit_identical(result, keys):
    obj = add_rich_monkey(keys=keys)
    before = snapshot_object(obj)
    assert cubify(result=result) == {"FINISHED"}
    if result == "NEW_OBJECT":
        made = bpy.context.object
        assert made != obj and made.name == "Suzanne Cubic"
        bpy.ops.cubic_craft.show_source()
        select(obj)
        assert differences(before, snapshot_object(obj), SETTINGS) == []
        return
    ignored = [*POSITIONS, *STORED, *SETTINGS]
    if result == "MESH":
        ignored += ["mesh/shape_keys/blocks/*/points"]
    else:
        ignored += ["mesh/shape_keys/*Cubic*", "mesh/shape_keys/order", "rna/active_shape_key*"]
        if not keys:
            ignored += ["mesh/shape_keys/*", "mesh/rna/shape_keys"]
    changed = differences(before, snapshot_object(obj), ignored)
    assert changed == []
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert differences(before, snapshot_object(obj), SETTINGS) == []


@pytest.mark.thorough(1)
@pytest.mark.parametrize("turn", [0.7, 0.0])
def test_cubify_after_apply_starts_from_the_original(turn):
    """As if the transform had been applied first; but for squares that are cut the other way."""
    one, twin = add_monkey("One"), add_monkey("Twin")
    for obj in (one, twin):
        obj.rotation_euler, obj.scale = (turn, 0, turn), (1, 1, 2)
        select(obj)
        if obj == one:
            cubify()
        bpy.ops.object.transform_apply(location=True, rotation=True, scale=True)
        # on a finer copy, where it matters less how; not kept apart, as that would push others; and
        # soft, as a triangle between two sides may belong to either
        cubify(keep_apart=False, refine="AUTO", crispness=0.0)
    np.testing.assert_allclose(position_of(one.data), position_of(twin.data), atol=0.02)
    for obj in (one, twin):
        select(obj)
        bpy.ops.cubic_craft.restore()
    np.testing.assert_allclose(position_of(one.data), position_of(twin.data), atol=1e-6)


def test_apply_keeps_the_shape_and_forgets_the_original():
    obj = add_monkey()
    cubify()
    cubic = position_of(obj.data)
    assert bpy.ops.cubic_craft.apply() == {"FINISHED"}
    assert position_of(obj.data).tobytes() == cubic.tobytes()
    assert not [a.name for a in obj.data.attributes if a.name.startswith("cubic_craft")]
    assert not bpy.ops.cubic_craft.restore.poll()


def test_the_settings_of_the_object_are_used_and_kept():
    obj = add_monkey()
    obj.cubic_craft.cubeness = 0.7
    obj.cubic_craft.orientation = (0.1, 0.2, 0.3)
    cubify()
    by_settings = position_of(obj.data)
    other = add_monkey()
    cubify(cubeness=0.7, orientation=(0.1, 0.2, 0.3))
    assert position_of(other.data).tobytes() == by_settings.tobytes()
    assert other.cubic_craft.cubeness == pytest.approx(0.7)
    assert tuple(other.cubic_craft.orientation) == pytest.approx((0.1, 0.2, 0.3))


def test_the_settings_of_the_active_object_are_those_of_all():
    second = add_monkey("Second", location=(3, 0, 0))
    first = add_monkey("First")
    first.cubic_craft.cubeness, first.cubic_craft.together = 0.9, "PARTS"
    select(first, second)
    cubify()
    assert second.cubic_craft.cubeness == pytest.approx(0.9)
    assert second.cubic_craft.together == "PARTS"
    assert position_of(first.data).tobytes() == position_of(second.data).tobytes()


def test_several_objects_and_a_shared_mesh():
    first = add_monkey("First")
    twin = add_copy(first, is_linked=True)
    other = add_monkey("Other", location=(3, 0, 0))
    select(other, first, twin)
    before = position_of(first.data)
    assert cubify(together="PARTS") == {"FINISHED"}
    assert position_of(first.data).tobytes() == position_of(other.data).tobytes()
    assert position_of(first.data).tobytes() != before.tobytes()
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    for obj in (first, other):
        assert position_of(obj.data).tobytes() == before.tobytes()


def test_new_objects_of_a_shared_mesh_are_each_solved_as_they_stand():
    first = add_monkey("First")
    twin = add_copy(first, is_linked=True)
    twin.scale, twin.rotation_euler = (1.0, 1.0, 3.0), (0.5, 0.0, 0.0)
    bpy.context.view_layer.update()
    select(first, twin)
    cubify(result="NEW_OBJECT", space="WORLD", together="PARTS")
    shapes = [
        position_of(bpy.data.objects[name].data) for name in ("First Cubic", "First.001 Cubic")
    ]
    bpy.ops.cubic_craft.show_source()
    select(twin)
    cubify(result="MESH", space="WORLD")
    assert position_of(twin.data).tobytes() == shapes[1].tobytes()
    assert shapes[0].tobytes() != shapes[1].tobytes()


def test_the_object_that_differs_from_its_twin_is_named():
    first = add_monkey("First")
    twin = add_copy(first, is_linked=True)
    twin.name = "Twin"
    twin.scale.z = 3.0
    bpy.context.view_layer.update()
    select(first, twin)
    report = reports_of(cubify)
    assert '"Twin" shares its mesh with "First" and now has its shape; make it single' in report


def test_objects_that_differ_from_their_twin_are_named_at_once():
    first = add_monkey("First")
    twins = [first.copy() for _ in range(3)]
    for number, twin in enumerate(twins):
        twin.name = f"Twin {number}"
        bpy.context.collection.objects.link(twin)
        twin.rotation_euler.z = 0.3 + number
    bpy.context.view_layer.update()
    select(first, *twins)
    report = reports_of(cubify)
    assert report.count("shares its mesh") == 1
    assert '"Twin 0" shares its mesh' in report and "so do 2 others" in report


def test_a_new_object_shows_how_it_was_made_and_is_changed_by_the_next_click():
    source = add_monkey()
    cubify(cubeness=0.9, result="NEW_OBJECT")
    made = bpy.context.object
    assert made.cubic_craft.cubeness == pytest.approx(0.9)
    assert "507 vertices" in made.cubic_craft.status
    assert source.cubic_craft.cubeness == pytest.approx(0.4)
    assert source.cubic_craft.status == ""
    before = position_of(made.data)
    cubify()
    assert bpy.context.object == made
    assert position_of(made.data).tobytes() == before.tobytes()


def test_a_frame_of_the_same_name_in_a_library_is_not_mixed_up(tmp_path):
    library = str(tmp_path / "library.blend")
    linked = bpy.data.objects.new("Frame", None)
    linked.rotation_euler = (0.3, 0.4, 0.5)
    bpy.data.libraries.write(library, {linked}, fake_user=True)
    bpy.data.objects.remove(linked)
    add_empty("Frame")
    with bpy.data.libraries.load(library, link=True) as (_, wanted):
        wanted.objects = ["Frame"]
    linked = wanted.objects[0]
    obj = add_monkey()
    obj.cubic_craft.space, obj.cubic_craft.frame = "FRAME", linked
    cubify()
    assert obj.cubic_craft.frame == linked


def test_settings_that_are_not_used_leave_other_objects_alone():
    frames = [bpy.data.objects.new(name, None) for name in ("One", "Two")]
    first, second = add_monkey("First"), add_monkey("Second")
    for obj, frame in zip((first, second), frames, strict=True):
        obj.cubic_craft.frame = frame
    select(first, second)
    cubify(frame="Nobody")
    assert [obj.cubic_craft.frame for obj in (first, second)] == frames


def test_an_active_object_that_is_not_selected_is_left_alone():
    active, other = add_monkey("Active"), add_monkey("Other")
    select(other)
    bpy.context.view_layer.objects.active = active
    before = position_of(active.data)
    cubify()
    assert position_of(active.data).tobytes() == before.tobytes()
    assert position_of(other.data).tobytes() != before.tobytes()


def test_every_setting_can_be_driven_and_animated():
    obj = add_monkey()
    for name in ("cubeness", "tolerance", "map_invert", "max_iterations", "space", "result"):
        obj.driver_add(f"cubic_craft.{name}")
        obj.keyframe_insert(f"cubic_craft.{name}", frame=1)


def test_one_bad_object_does_not_stop_the_others():
    good = add_monkey("Good")
    lamp = bpy.data.objects.new("Wire", bpy.data.meshes.new("Wire"))
    lamp.data.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1)], [])
    bpy.context.collection.objects.link(lamp)
    select(good, lamp)
    before = position_of(good.data)
    assert "Wire" in reports_of(cubify)
    assert position_of(good.data).tobytes() != before.tobytes()


def test_the_map_scales_cubeness_and_inverts():
    obj = add_monkey()
    everything = range(len(obj.data.vertices))
    obj.vertex_groups.new(name="All").add(everything, 1.0, "REPLACE")
    obj.vertex_groups.new(name="None")
    before = position_of(obj.data)
    shapes = {}
    for group, invert in (("All", False), ("All", True), ("None", False), ("None", True)):
        cubify(map_group=group, map_invert=invert)
        shapes[group, invert] = position_of(obj.data)
    cubify(map_group="")
    plain = position_of(obj.data)
    np.testing.assert_array_equal(shapes["All", False], plain)
    np.testing.assert_array_equal(shapes["None", True], plain)
    np.testing.assert_array_equal(shapes["All", True], before)
    np.testing.assert_array_equal(shapes["None", False], before)


def test_half_the_weight_is_half_the_cubeness_and_half_the_crispness():
    obj = add_monkey()
    obj.vertex_groups.new(name="Half").add(range(len(obj.data.vertices)), 0.5, "REPLACE")
    cubify(cubeness=0.8, crispness=1.0, map_group="Half")
    mapped = position_of(obj.data)
    cubify(cubeness=0.4, crispness=0.5, map_group="")
    np.testing.assert_allclose(mapped, position_of(obj.data), atol=1e-5)


def test_rotation_says_whether_the_shape_may_turn():
    obj = add_triangles()
    before = position_of(obj.data)
    shapes, turns = {}, {}
    for rotation in ("FREE", "KEEP"):
        cubify(rotation=rotation)
        shapes[rotation] = position_of(obj.data)
        A, B = (X - X.mean(axis=0) for X in (shapes[rotation], before))
        U, _, Vt = np.linalg.svd(A.T @ B)
        turns[rotation] = np.linalg.norm(U @ Vt - np.eye(3))
    assert turns["KEEP"] < 0.3 * turns["FREE"]


def test_numpy_and_taichi_give_the_same_shape():
    obj = add_monkey()
    shapes = []
    for device in ("NUMPY", "CPU"):
        cubify(device=device)
        assert ("numpy" if device == "NUMPY" else "taichi-cpu") in obj.cubic_craft.status
        shapes.append(position_of(obj.data))
    np.testing.assert_allclose(*shapes, atol=1e-5)


def test_n_gons_are_kept_and_solved():
    bpy.ops.mesh.primitive_cylinder_add(vertices=9, end_fill_type="NGON")
    obj = bpy.context.object
    sizes = sorted(p.loop_total for p in obj.data.polygons)
    before = position_of(obj.data)
    assert cubify(cubeness=1.0) == {"FINISHED"}
    assert np.abs(position_of(obj.data) - before).max() > 0.01
    assert sorted(p.loop_total for p in obj.data.polygons) == sizes == [4] * 9 + [9, 9]


def test_enabling_again_and_again_leaves_no_trace(extension):
    name = extension.__name__
    for _ in range(3):
        bpy.ops.preferences.addon_disable(module=name)
        assert not hasattr(bpy.types.Object, "cubic_craft")
        assert not hasattr(bpy.types, "CUBIC_CRAFT_PT_main")
        bpy.ops.preferences.addon_enable(module=name)
    assert bpy.context.preferences.addons[name].preferences.tab == "Cubic Craft"
    add_monkey()
    assert cubify() == {"FINISHED"}


def test_the_tab_can_be_renamed(extension):
    preferences = bpy.context.preferences.addons[extension.__name__].preferences
    preferences.tab = "Sculpture"
    assert bpy.types.CUBIC_CRAFT_PT_main.bl_category == "Sculpture"
    preferences.tab = "Cubic Craft"
    assert bpy.types.CUBIC_CRAFT_PT_main.bl_category == "Cubic Craft"


def test_the_redo_panel_shows_what_holds_together():
    """It takes what the object has, and what it is told the object then keeps."""
    obj = add_monkey()
    obj.cubic_craft.solidity, obj.cubic_craft.refine = 0.6, "OFF"
    cubify()
    first = position_of(obj.data)
    cubify(solidity=0.6, refine="OFF", together="PARTS", rotation="KEEP")
    np.testing.assert_array_equal(position_of(obj.data), first)
    assert obj.cubic_craft.together == "PARTS"
    for name, value in (("solidity", 0.0), ("refine", "AUTO"), ("together", "OFF")):
        cubify(**{name: value})
        assert obj.cubic_craft.bl_rna.properties[name] and getattr(obj.cubic_craft, name) == value
        assert np.abs(position_of(obj.data) - first).max() > 1e-4
        first = position_of(obj.data)


OF_THE_PROXY = {"keep_pose": False, "detail": 0.125, "keep_apart": False}


@pytest.mark.thorough(3)
@pytest.mark.parametrize("name", OF_THE_PROXY)
@pytest.mark.parametrize("way", ["operator", "object", "Live"])
def test_each_option_of_the_proxy_reaches_the_solver(
    extension, live, begin, monkeypatch, way, name, part
):
    pipeline = part("run.pipeline")
    seen, prepare, value = [], pipeline.prepare, OF_THE_PROXY[name]

    def watched(members, *arguments):
        seen.append(members[0].settings.proxy)
        return prepare(members, *arguments)

    monkeypatch.setattr(pipeline, "prepare", watched)
    obj = add_monkey()
    run = partial(bpy.ops.cubic_craft.cubify, max_iterations=3, refine="OFF")
    if way == "Live":
        session = begin(obj, keep_apart=True)
        for other in (getattr(obj.cubic_craft, name), value):
            setattr(live.live_properties(), name, other)
            for _ in range(10):
                session.tick(bpy.context)
        session.on(live.Event.CANCEL)
    elif way == "operator":
        assert run(**{name: value}) == {"FINISHED"}
        assert getattr(obj.cubic_craft, name) == value, "the object keeps what it was told"
    else:
        setattr(obj.cubic_craft, name, value)
        assert run() == {"FINISHED"}
    solver = importlib.import_module(f"{extension.__name__}.solver")
    expected = dataclasses.asdict(solver.ProxyOptions(refine=False)) | {name: value}
    assert dataclasses.asdict(seen[-1]) == pytest.approx(expected)


def test_a_value_of_an_older_file_is_the_default():
    obj = add_monkey()
    obj.cubic_craft.rotation = "FREE"
    stored = obj.bl_system_properties_get() if hasattr(obj, "bl_system_properties_get") else obj
    stored["cubic_craft"]["rotation"] = 0
    before = position_of(obj.data)
    assert cubify() == {"FINISHED"}
    assert obj.cubic_craft.rotation == "KEEP"
    assert np.abs(position_of(obj.data) - before).max() > 0.01


def test_a_shared_mesh_that_cannot_be_restored_is_reported_once():
    obj = add_monkey()
    cubify(refine="OFF")
    obj.data.attributes.remove(obj.data.attributes["cubic_craft_original"])
    select(obj, add_copy(obj, is_linked=True))
    with pytest.raises(RuntimeError) as caught:
        bpy.ops.cubic_craft.restore()
    assert str(caught.value).count("has been edited") == 1
