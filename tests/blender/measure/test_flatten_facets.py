# SPDX-License-Identifier: GPL-3.0-or-later
"""Flatten Facets: exactly planar where it is seen, and everything else stays as it was."""

import bmesh
import bpy
import numpy as np
import pytest
from flat_balls import PLANAR, WIDE, add_ball, flatten, planar_share, world
from recorder import Recorder
from rich_mesh import add_rich_monkey, points_of, position_of, set_points
from scene import add_copy, add_monkey, cubify, edit_mode, reports_of, select
from snapshot import differences, snapshot_object, unchanged


@pytest.fixture
def bridge(part):
    return part("mesh_bridge")


def test_the_sides_are_planar_and_restore_gives_the_original_bits():
    obj = add_ball()
    before = snapshot_object(obj)
    original = position_of(obj.data)
    cubify()
    assert planar_share(obj) < 0.1
    cubic = position_of(obj.data)
    report = reports_of(flatten)
    assert "Flattened Ball; 6 planar facets" in report
    assert planar_share(obj) > PLANAR
    moves = np.linalg.norm(position_of(obj.data) - cubic, axis=1)
    assert 0.0 < moves.max() <= 0.02 * np.ptp(cubic, axis=0).max()
    # each side has a single height, to the last bit
    tops = np.sort(position_of(obj.data)[:, 2])[-60:]
    assert len(np.unique(tops)) == 1
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert position_of(obj.data).tobytes() == original.tobytes()
    ignored = ("rna/cubic_craft*", "*custom/custom cubic_craft*")
    assert differences(before, snapshot_object(obj), ignored) == []


def test_the_shape_key_is_flattened_and_keeps_its_value():
    obj = add_ball()
    original = position_of(obj.data)
    cubify(result="SHAPE_KEY")
    obj.data.shape_keys.key_blocks["Cubic"].value = 0.25
    assert planar_share(obj, points_of(obj.data, "Cubic")) < 0.1
    assert flatten() == {"FINISHED"}
    assert planar_share(obj, points_of(obj.data, "Cubic")) > PLANAR
    assert points_of(obj.data, "Basis").tobytes() == original.tobytes()
    keys = obj.data.shape_keys.key_blocks
    assert [key.name for key in keys] == ["Basis", "Cubic"] and keys["Cubic"].value == 0.25
    assert bpy.ops.cubic_craft.restore() == {"FINISHED"}
    assert obj.data.shape_keys is None
    assert position_of(obj.data).tobytes() == original.tobytes()


@pytest.mark.parametrize("result", ["MESH", "SHAPE_KEY"])
def test_the_next_cubify_starts_from_the_original(bridge, result):
    shapes = []
    for is_flattened in (False, True):
        obj = add_monkey()
        cubify(result=result)
        if is_flattened:
            status = obj.cubic_craft.status
            flatten(**WIDE)
            assert obj.cubic_craft.status == status
            assert not bridge.is_edited(obj.data) and bridge.has_original(obj.data)
        cubify(cubeness=0.9, result="MESH")
        shapes.append(position_of(obj.data).tobytes())
    assert shapes[0] == shapes[1]


def test_it_is_planar_where_it_is_seen():
    """With the scale of the object, in the axes of the world, or as the cube was rotated."""
    obj = add_ball(scale=(1.0, 1.7, 0.6), rotation=(0.0, 0.0, 0.3))
    cubify(refine="AUTO")
    assert planar_share(obj) < 0.1
    flatten()
    assert planar_share(obj) > PLANAR
    other = add_ball("Other")
    cubify(orientation=(0.3, 0.0, 0.0), refine="AUTO")
    other.cubic_craft.orientation = (0.0, 0.0, 0.0)  # it stays that of the shape
    flatten()
    axes = np.array([[1, 0, 0], [0, np.cos(0.3), -np.sin(0.3)], [0, np.sin(0.3), np.cos(0.3)]])
    V = world(other) @ axes
    tops = np.sort(V[:, 2])[-60:]
    assert np.ptp(tops) < 1e-6 and np.ptp(np.sort(world(other)[:, 2])[-60:]) > 0.01


@pytest.mark.parametrize("keys", [False, True])
def test_a_transformed_result_keeps_its_original(keys):
    """As if it had been flattened before it was transformed."""
    one, twin = add_rich_monkey(keys=keys), add_rich_monkey(keys=keys)
    for obj in (one, twin):
        select(obj)
        obj.matrix_world.identity()
        cubify()
    originals = []
    for obj in (one, twin):
        select(obj)
        obj.rotation_euler = (0.0, 0.0, np.pi / 2)
        if obj == twin:
            bpy.ops.object.transform_apply(location=False, rotation=True, scale=False)
            flatten(**WIDE)
        bpy.ops.cubic_craft.restore()
        if obj == one:
            bpy.ops.object.transform_apply(location=False, rotation=True, scale=False)
        names = [key.name for key in obj.data.shape_keys.key_blocks] if keys else []
        shapes = [position_of(obj.data), *(points_of(obj.data, name) for name in names)]
        originals.append(np.concatenate(shapes))
    np.testing.assert_allclose(originals[0], originals[1], atol=2e-5)


def test_a_key_that_is_edited_afterwards_is_carried_back_as_without_it():
    carried = []
    for is_flattened in (False, True):
        obj = add_rich_monkey(keys=True)
        cubify()
        obj.rotation_euler = (0.0, 0.4, np.pi / 2)
        bpy.ops.object.transform_apply(location=False, rotation=True, scale=False)
        if is_flattened:
            flatten(**WIDE)
        set_points(obj.data, "Wide", points_of(obj.data, "Wide") + [0.2, 0.0, 0.1])
        bpy.ops.cubic_craft.restore()
        carried.append(points_of(obj.data, "Wide"))
    np.testing.assert_allclose(*carried, atol=2e-5)


def test_edits_become_a_part_of_the_result(bridge):
    obj = add_ball()
    original = position_of(obj.data)
    cubify()
    obj.data.vertices[3].co.x += 0.5
    obj.data.update()
    edited = position_of(obj.data)[3]
    assert "edits made since Cubify are now part of the result" in reports_of(flatten)
    np.testing.assert_allclose(position_of(obj.data)[3], edited, atol=5e-3)
    assert not bridge.is_edited(obj.data)
    bpy.ops.cubic_craft.restore()
    assert position_of(obj.data).tobytes() == original.tobytes()


def test_several_meshes_and_a_shared_one():
    first, other, plain = add_ball("First"), add_ball("Other"), add_monkey("Plain")
    twin = add_copy(first, is_linked=True)
    select(first, other)
    cubify(together="PARTS")
    before = position_of(plain.data).tobytes()
    select(plain, first, twin, other)
    report = reports_of(flatten)
    assert "Flattened First, Other" in report and "Plain" not in report
    assert position_of(first.data).tobytes() == position_of(other.data).tobytes()
    assert position_of(plain.data).tobytes() == before


def test_the_seam_of_a_mirror_stays_closed():
    obj = add_ball(rotation=(0.0, 0.4, 0.0))
    with edit_mode(obj) as edited:
        geometry = [*edited.verts, *edited.edges, *edited.faces]
        bmesh.ops.bisect_plane(
            edited, geom=geometry, plane_co=(0, 0, 0), plane_no=(1, 0, 0), clear_outer=True
        )
    obj.modifiers.new("Mirror", "MIRROR")
    cubify()
    in_plane = position_of(obj.data)[:, 0] == 0.0
    assert in_plane.sum() > 20
    cubic = position_of(obj.data)
    flatten(**WIDE)
    assert (position_of(obj.data) != cubic)[in_plane].any()
    assert np.abs(position_of(obj.data)[in_plane, 0]).max() < 1e-7


def test_it_works_in_weight_paint_mode():
    obj = add_ball()
    cubify()
    bpy.ops.object.mode_set(mode="WEIGHT_PAINT")
    assert flatten(dissolve=True) == {"FINISHED"}
    assert bpy.context.object == obj and obj.mode == "WEIGHT_PAINT"
    assert "Ball Facets" in bpy.data.objects
    bpy.ops.object.mode_set(mode="OBJECT")


def refusal():
    with pytest.raises(RuntimeError) as error:
        flatten()
    lines = str(error.value).removeprefix("Error: ").strip().splitlines()
    assert len(lines) == 1
    return lines[0]


def test_without_a_result_it_is_greyed_out():
    obj = add_ball()
    assert not bpy.ops.cubic_craft.flatten.poll()
    with pytest.raises(RuntimeError, match="The mesh has no result to flatten; cubify it first"):
        flatten()
    cubify()
    assert bpy.ops.cubic_craft.flatten.poll()
    bpy.ops.object.mode_set(mode="EDIT")
    assert not bpy.ops.cubic_craft.flatten.poll()
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.cubic_craft.apply()
    assert not bpy.ops.cubic_craft.flatten.poll()
    obj.data.clear_geometry()
    assert not bpy.ops.cubic_craft.flatten.poll()


def test_what_has_no_sides_is_refused():
    obj = add_ball()
    cubify(cubeness=0.0)
    with unchanged(obj), pytest.raises(RuntimeError, match="has no sides that can be flattened"):
        flatten(angle=0.001, tolerance=0.001)


def test_what_has_lost_its_original_is_refused():
    obj = add_ball()
    cubify()
    with edit_mode(obj) as edited:
        edited.verts.ensure_lookup_table()
        for number, vertex in enumerate(edited.verts):
            vertex.co *= 1.0 + 0.1 * np.sin(number)
        bmesh.ops.extrude_face_region(edited, geom=edited.faces[:3])
        for vertex in edited.verts[-4:]:
            vertex.co.z += 0.3
    with unchanged(obj):
        assert "has no result whose original is known" in refusal()


def test_a_scipy_that_does_not_work_is_named(part, monkeypatch):
    obj = add_ball()
    cubify()

    facets = part("measure.facets")

    def check():
        raise facets.CubicCraftError("SciPy does not work")

    monkeypatch.setattr(facets, "check_requirements", check)
    with unchanged(obj):
        assert "SciPy does not work" in refusal()


def test_the_panel_offers_it_for_results_only(part):
    panel = part("ui.panel")

    obj = add_ball()
    for is_there in (False, True):
        layout = Recorder()
        panel._draw_result(layout, obj)
        assert list(layout.operators) == (["cubic_craft.flatten"] if is_there else [])
        cubify()
