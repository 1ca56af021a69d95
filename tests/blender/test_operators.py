# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators as the artist and a script use them, on the installed extension."""

import importlib

import bpy
import numpy as np
import pytest
from mathutils import Euler
from rich_mesh import add_rich_monkey, points_of, position_of
from snapshot import POSITIONS, STORED, differences, snapshot_object

# What a run leaves on the object beside its mesh: its settings and the text of its last run.
SETTINGS = ("rna/cubic_craft*", "*custom/custom cubic_craft*")
# Before Blender 5 the settings appear among the object's custom properties once they are read.
READ = ("custom/custom cubic_craft",)


def add_monkey(name="Suzanne", **where):
    bpy.ops.mesh.primitive_monkey_add(**where)
    obj = bpy.context.object
    obj.name = name
    return obj


def add_triangles():
    """Add a shape without symmetry, in one part and of triangles only."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=4)
    obj = bpy.context.object
    V = position_of(obj.data)
    V *= 1 + 0.3 * np.sin(3 * V[:, :1] + 0.4) * np.cos(2 * V[:, 1:2])
    obj.data.vertices.foreach_set("co", V.ravel())
    obj.data.transform(Euler((0.1, 0.2, 0.05)).to_matrix().to_4x4())
    obj.data.update()
    return obj


def select(*objects):
    bpy.ops.object.select_all(action="DESELECT")
    for obj in objects:
        obj.select_set(True)
    bpy.context.view_layer.objects.active = objects[0]


def cubify(**options):
    return bpy.ops.cubic_craft.cubify(**{"max_iterations": 30, **options})


def alignment(mesh, positions):
    mesh.calc_loop_triangles()
    F = np.array([t.vertices for t in mesh.loop_triangles])
    normals = np.cross(*(positions[F[:, k]] - positions[F[:, 0]] for k in (1, 2)))
    return np.abs(normals).max(axis=1).sum() / np.linalg.norm(normals, axis=1).sum()


def test_cubify_makes_it_cubic_and_restore_gives_the_original_bits():
    obj = add_triangles()
    before = position_of(obj.data)
    assert bpy.ops.cubic_craft.cubify(cubeness=0.8) == {"FINISHED"}
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


def test_cubify_again_starts_from_the_original():
    obj = add_monkey()
    cubify(cubeness=0.9)
    cubify(cubeness=0.2)
    twice = position_of(obj.data)
    other = add_monkey()
    cubify(cubeness=0.2)
    assert position_of(other.data).tobytes() == twice.tobytes()


def test_an_edited_mesh_becomes_the_original():
    obj = add_monkey()
    cubify()
    obj.data.vertices[3].co.x += 0.5
    obj.data.update()
    edited = position_of(obj.data)
    with pytest.raises(RuntimeError, match="original shape"):
        bpy.ops.cubic_craft.restore()
    cubify()
    bpy.ops.cubic_craft.restore()
    assert position_of(obj.data).tobytes() == edited.tobytes()


def test_apply_keeps_the_shape_and_forgets_the_original():
    obj = add_monkey()
    cubify()
    cubic = position_of(obj.data)
    assert bpy.ops.cubic_craft.apply() == {"FINISHED"}
    assert position_of(obj.data).tobytes() == cubic.tobytes()
    assert not [a.name for a in obj.data.attributes if a.name.startswith("cubic_craft")]
    assert not bpy.ops.cubic_craft.restore.poll()


def test_saving_and_loading_between_cubify_and_restore_loses_nothing(tmp_path):
    obj = add_rich_monkey(keys=True)
    names = [key.name for key in obj.data.shape_keys.key_blocks]
    before = {name: points_of(obj.data, name) for name in names}
    cubify(cubeness=0.7)
    path = str(tmp_path / "file.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    obj = bpy.data.objects["Suzanne"]
    assert obj.cubic_craft.cubeness == pytest.approx(0.7)
    select(obj)
    bpy.ops.cubic_craft.restore()
    for name, points in before.items():
        assert points_of(obj.data, name).tobytes() == points.tobytes()


def test_the_settings_of_the_object_are_used_and_kept():
    obj = add_monkey()
    obj.cubic_craft.cubeness = 0.7
    obj.cubic_craft.orientation = (0.1, 0.2, 0.3)
    bpy.ops.cubic_craft.cubify()
    by_settings = position_of(obj.data)
    other = add_monkey()
    bpy.ops.cubic_craft.cubify(cubeness=0.7, orientation=(0.1, 0.2, 0.3))
    assert position_of(other.data).tobytes() == by_settings.tobytes()
    assert other.cubic_craft.cubeness == pytest.approx(0.7)
    assert tuple(other.cubic_craft.orientation) == pytest.approx((0.1, 0.2, 0.3))


def test_the_settings_of_the_active_object_are_those_of_all():
    second = add_monkey("Second", location=(3, 0, 0))
    first = add_monkey("First")
    first.cubic_craft.cubeness = 0.9
    select(first, second)
    bpy.ops.cubic_craft.cubify()
    assert second.cubic_craft.cubeness == pytest.approx(0.9)
    assert position_of(first.data).tobytes() == position_of(second.data).tobytes()


def test_several_objects_and_a_shared_mesh():
    first = add_monkey("First")
    twin = first.copy()
    bpy.context.collection.objects.link(twin)
    other = add_monkey("Other", location=(3, 0, 0))
    select(other, first, twin)
    before = position_of(first.data)
    assert cubify() == {"FINISHED"}
    assert position_of(first.data).tobytes() == position_of(other.data).tobytes()
    assert position_of(first.data).tobytes() != before.tobytes()
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    for obj in (first, other):
        assert position_of(obj.data).tobytes() == before.tobytes()


def test_one_bad_object_does_not_stop_the_others():
    good = add_monkey("Good")
    lamp = bpy.data.objects.new("Wire", bpy.data.meshes.new("Wire"))
    lamp.data.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1)], [])
    bpy.context.collection.objects.link(lamp)
    select(good, lamp)
    before = position_of(good.data)
    assert cubify() == {"FINISHED"}
    assert position_of(good.data).tobytes() != before.tobytes()


def test_pins_stay_to_the_bit_and_the_rest_moves():
    obj = add_monkey()
    group = obj.vertex_groups.new(name="Hold")
    group.add([3, 50, 51, 52], 0.5, "REPLACE")
    group.add([7], 0.49, "REPLACE")
    before = position_of(obj.data)
    cubify(pin_group="Hold", cubeness=0.8)
    after = position_of(obj.data)
    held = [3, 50, 51, 52]
    assert after[held].tobytes() == before[held].tobytes()
    assert after[7].tobytes() != before[7].tobytes()


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
    np.testing.assert_allclose(shapes["All", True], before, atol=1e-6)
    np.testing.assert_allclose(shapes["None", False], before, atol=1e-6)


def test_world_orientation_equals_turning_the_cube_against_the_object():
    obj = add_monkey(rotation=(0.3, 0.2, 0.5))
    cubify(space="WORLD")
    by_world = position_of(obj.data)
    bpy.ops.cubic_craft.restore()
    inverse = obj.matrix_world.to_3x3().inverted().to_euler()
    cubify(space="OBJECT", orientation=tuple(inverse))
    np.testing.assert_allclose(position_of(obj.data), by_world, atol=1e-4)


def test_the_frame_object_gives_the_orientation():
    frame = bpy.data.objects.new("Frame", None)
    bpy.context.collection.objects.link(frame)
    frame.rotation_euler = (0.2, -0.3, 0.4)
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


def test_a_flat_scale_is_no_obstacle():
    obj = add_monkey()
    obj.scale = (1.0, 1.0, 0.0)
    bpy.context.view_layer.update()
    assert cubify() == {"FINISHED"}
    assert np.isfinite(position_of(obj.data)).all()


def test_rotation_changes_only_how_the_shape_stands():
    obj = add_triangles()
    shapes = {}
    for rotation in ("FREE", "KEEP", "AUTO"):
        cubify(rotation=rotation)
        shapes[rotation] = position_of(obj.data)
    assert np.abs(shapes["FREE"] - shapes["KEEP"]).max() > 1e-3
    lengths = [np.linalg.norm(shapes[r] - shapes[r][0], axis=1) for r in ("FREE", "KEEP")]
    np.testing.assert_allclose(*lengths, atol=1e-5)
    np.testing.assert_array_equal(shapes["AUTO"], shapes["FREE"])


def test_several_parts_keep_their_rotation_by_default():
    obj = add_monkey()
    cubify(rotation="KEEP")
    kept = position_of(obj.data)
    cubify(rotation="AUTO")
    np.testing.assert_array_equal(position_of(obj.data), kept)


def test_numpy_and_taichi_give_the_same_shape():
    obj = add_monkey()
    shapes = []
    for device in ("NUMPY", "CPU"):
        cubify(device=device)
        assert ("numpy" if device == "NUMPY" else "taichi-cpu") in obj.cubic_craft.status
        shapes.append(position_of(obj.data))
    np.testing.assert_allclose(*shapes, atol=1e-5)


def _empty(obj):
    obj.data.clear_geometry()


def _no_faces(obj):
    obj.data.clear_geometry()
    obj.data.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1)], [])


def _not_finite(obj):
    obj.data.vertices[5].co.x = float("nan")


def _hidden(obj):
    obj.hide_set(True)
    bpy.context.view_layer.objects.active = obj


def _all_pinned(obj):
    obj.vertex_groups.new(name="All").add(range(len(obj.data.vertices)), 1.0, "REPLACE")


@pytest.mark.parametrize(
    ("spoil", "options", "message"),
    [
        (_empty, {}, "Suzanne.*fewer than 3 vertices"),
        (_no_faces, {}, "Suzanne.*no faces"),
        (_not_finite, {}, "Suzanne.*finite"),
        (_hidden, {}, "Suzanne.*hidden"),
        (_all_pinned, {"pin_group": "All"}, "Suzanne.*all vertices are pinned"),
        (None, {"pin_group": "Ears"}, "Suzanne.*Ears"),
        (None, {"map_group": "Ears"}, "Suzanne.*Ears"),
        (None, {"space": "FRAME"}, "Suzanne.*frame object"),
        (None, {"space": "FRAME", "frame": "Nobody"}, "no object.*Nobody"),
    ],
)
@pytest.mark.parametrize("result", ["MESH", "SHAPE_KEY", "NEW_OBJECT"])
def test_refusals_name_the_object_and_change_nothing(spoil, options, message, result):
    obj = add_monkey()
    if spoil:
        spoil(obj)
    bpy.context.view_layer.update()
    before = snapshot_object(obj)
    objects = len(bpy.data.objects)
    with pytest.raises(RuntimeError, match=message):
        cubify(result=result, **options)
    assert differences(before, snapshot_object(obj), READ) == []
    assert len(bpy.data.objects) == objects


def test_edit_mode_and_no_mesh_fail_the_poll_with_a_message():
    add_monkey()
    bpy.ops.object.mode_set(mode="EDIT")
    with pytest.raises(RuntimeError, match="Switch to Object Mode first"):
        cubify()
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.object.select_all(action="DESELECT")
    bpy.context.view_layer.objects.active = None
    with pytest.raises(RuntimeError, match="Select a mesh object first"):
        cubify()


def test_an_exception_in_the_solver_changes_nothing(extension, monkeypatch):
    obj, other = add_rich_monkey(keys=True), add_monkey("Other")
    select(other, obj)
    before = [snapshot_object(o) for o in (obj, other)]
    pipeline = importlib.import_module(f"{extension.__name__}.cubic_craft_addon.cubify")
    original = pipeline.solve
    calls = []

    def fail_second(*arguments):
        calls.append(arguments)
        if len(calls) == 2:
            raise MemoryError("no memory left")
        return original(*arguments)

    monkeypatch.setattr(pipeline, "solve", fail_second)
    with pytest.raises(RuntimeError, match="no memory left"):
        cubify()
    for o, taken in zip((obj, other), before, strict=True):
        assert differences(taken, snapshot_object(o), READ) == []


def test_n_gons_are_kept_and_solved():
    bpy.ops.mesh.primitive_cylinder_add(vertices=9, end_fill_type="NGON")
    obj = bpy.context.object
    sizes = sorted(p.loop_total for p in obj.data.polygons)
    assert cubify(cubeness=1.0) == {"FINISHED"}
    assert sorted(p.loop_total for p in obj.data.polygons) == sizes == [4] * 9 + [9, 9]


def test_enabling_again_and_again_leaves_no_trace(extension):
    name = extension.__name__
    for _ in range(3):
        bpy.ops.preferences.addon_disable(module=name)
        assert not hasattr(bpy.types.Object, "cubic_craft")
        assert not hasattr(bpy.types, "CUBIC_PT_main")
        bpy.ops.preferences.addon_enable(module=name)
    assert bpy.context.preferences.addons[name].preferences.tab == "Cubic Craft"
    add_monkey()
    assert cubify() == {"FINISHED"}


def test_the_tab_can_be_renamed(extension):
    preferences = bpy.context.preferences.addons[extension.__name__].preferences
    preferences.tab = "Sculpture"
    assert bpy.types.CUBIC_PT_main.bl_category == "Sculpture"
    preferences.tab = "Cubic Craft"
    assert bpy.types.CUBIC_PT_main.bl_category == "Cubic Craft"
