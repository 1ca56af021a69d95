# SPDX-License-Identifier: GPL-3.0-or-later
"""Results that are transformed as a whole: the original goes along."""

import contextlib
import math

import bmesh
import bpy
import numpy as np
import pytest
from rich_mesh import add_rich_monkey, cubic_like, points_of, position_of, set_position
from scene import select
from snapshot import POSITIONS, SHAPE_KEY_POINTS, STORED, differences, snapshot_object, unchanged

NOTE = "cubic_craft_note"


@contextlib.contextmanager
def edit_mode(obj, hide=()):
    """Enter Edit Mode with everything selected that is not hidden."""
    select(obj)
    obj.active_shape_key_index = 0
    bpy.ops.object.mode_set(mode="EDIT")
    bm = bmesh.from_edit_mesh(obj.data)
    bm.verts.ensure_lookup_table()
    for index in hide:
        bm.verts[index].hide_set(True)
    bmesh.update_edit_mesh(obj.data)
    bpy.ops.mesh.select_all(action="SELECT")
    yield
    bpy.ops.object.mode_set(mode="OBJECT")


def apply(**what):
    chosen = dict.fromkeys(("location", "rotation", "scale"), False) | what
    bpy.ops.object.transform_apply(**chosen)


def apply_all(obj, **transform):
    for name, value in transform.items():
        setattr(obj, name, value)
    select(obj)
    apply(location=True, rotation=True, scale=True)


def set_origin(kind, center="MEDIAN"):
    def run(obj):
        select(obj)
        bpy.context.scene.cursor.location = (5, -3, 2)
        bpy.ops.object.origin_set(type=kind, center=center)

    return run


def apply_some(**what):
    def run(obj):
        obj.scale = (2, 0.5, 1.5)
        select(obj)
        apply(**what)

    return run


def mirror_whole(obj):
    select(obj)
    bpy.ops.transform.mirror(orient_type="GLOBAL", constraint_axis=(True, False, False))
    apply(rotation=True, scale=True)


def in_edit_mode(run):
    def inside(obj):
        with edit_mode(obj):
            run()

    return inside


def again_and_again(obj):
    for step in range(4):
        apply_all(obj, rotation_euler=(step, 1, 0.3), scale=(1.1, 0.9, 1.3), location=(step, 0, 1))
        set_origin("ORIGIN_GEOMETRY")(obj)


TRANSFORMS = {
    "apply rotation": apply_some(rotation=True),
    "apply scale": apply_some(scale=True),
    "apply location": apply_some(location=True),
    "apply all": apply_some(location=True, rotation=True, scale=True),
    "negative scale": lambda obj: apply_all(obj, scale=(-1, 1, 1)),
    "turned over": lambda obj: apply_all(obj, scale=(-1, -2, -0.5)),
    "huge": lambda obj: apply_all(obj, scale=(1e4, 1e4, 1e4)),
    "small": lambda obj: apply_all(obj, scale=(1e-4, 1e-4, 1e-4)),
    "flat": lambda obj: apply_all(obj, scale=(1, 1, 1e-3)),
    "far": lambda obj: apply_all(obj, location=(300, -200, 100)),
    "origin to geometry": set_origin("ORIGIN_GEOMETRY"),
    "origin to its bounds": set_origin("ORIGIN_GEOMETRY", "BOUNDS"),
    "geometry to origin": set_origin("GEOMETRY_ORIGIN"),
    "origin to cursor": set_origin("ORIGIN_CURSOR"),
    "origin to mass": set_origin("ORIGIN_CENTER_OF_MASS"),
    "origin to volume": set_origin("ORIGIN_CENTER_OF_VOLUME"),
    "mirror": mirror_whole,
    "mirror in edit mode": in_edit_mode(
        lambda: bpy.ops.transform.mirror(constraint_axis=(True, False, False))
    ),
    "turn in edit mode": in_edit_mode(lambda: bpy.ops.transform.rotate(value=0.7)),
    "scale in edit mode": in_edit_mode(lambda: bpy.ops.transform.resize(value=(1, 2, 3))),
    "again and again": again_and_again,
}


def all_points(mesh):
    if mesh.shape_keys is None:
        return {"": position_of(mesh)}
    return {key.name: points_of(mesh, key.name) for key in mesh.shape_keys.key_blocks}


def affine(before, after):
    """Fit the affine map in the plainest way."""
    one = np.c_[before.astype(np.float64), np.ones(len(before))]
    found = np.linalg.lstsq(one, after.astype(np.float64), rcond=None)[0]
    return lambda points: np.c_[points.astype(np.float64), np.ones(len(points))] @ found


@pytest.mark.thorough(20)
@pytest.mark.parametrize("name", TRANSFORMS)
def test_original_goes_along(bridge, cubify, monkey, name):
    mesh = monkey.data
    base = bridge.read_positions(mesh)
    cubify(monkey)
    written = bridge.read_positions(mesh)
    TRANSFORMS[name](monkey)
    present = bridge.read_positions(mesh)
    assert np.abs(present - written).max() > 1e-3
    assert bridge.has_original(mesh) and not bridge.is_edited(mesh)
    expected = affine(written, present)(base)
    rounding = 1e-5 * max(np.abs(expected).max(), np.abs(present).max())
    np.testing.assert_allclose(bridge.original_positions(mesh), expected, atol=rounding)
    with unchanged(monkey, (*POSITIONS, *SHAPE_KEY_POINTS, *STORED)):
        bridge.restore(monkey)
    np.testing.assert_allclose(bridge.read_positions(mesh), expected, atol=rounding)
    np.testing.assert_allclose(position_of(mesh), expected, atol=rounding)
    assert not bridge.has_traces(mesh)


@pytest.mark.thorough(12)
@pytest.mark.parametrize("name", TRANSFORMS)
def test_shape_keys_go_along(bridge, cubify, name):
    """They end where those of a twin do that was never cubified."""
    one, twin = add_rich_monkey(keys=True), add_rich_monkey(keys=True)
    cubify(one)
    written = bridge.read_positions(one.data)
    TRANSFORMS[name](one)
    whole = affine(written, bridge.read_positions(one.data))
    TRANSFORMS[name](twin)
    bridge.restore(one)
    base = all_points(twin.data)["Basis"]
    if "edit mode" in name:  # which moves no more than the base: the offsets stay
        twin = add_rich_monkey(keys=True)
        base = all_points(twin.data)["Basis"]
    for key, points in all_points(twin.data).items():
        offset = points - base.astype(np.float64)
        found = all_points(one.data)[key] - bridge.read_positions(one.data).astype(np.float64)
        rounding = 3e-6 * np.abs(points).max() + 3e-6 * np.abs(whole(base)).max()
        np.testing.assert_allclose(found, offset, atol=rounding)


@pytest.mark.parametrize("name", ["apply all", "mirror", "origin to cursor", "flat"])
def test_next_result_starts_from_there(bridge, cubify, monkey, name):
    mesh = monkey.data
    base = bridge.read_positions(mesh)
    cubify(monkey)
    written = bridge.read_positions(mesh)
    TRANSFORMS[name](monkey)
    expected = affine(written, bridge.read_positions(mesh))(base)
    original = bridge.original_positions(mesh)
    cubify(monkey, seed=2)
    assert bridge.original_positions(mesh).tobytes() == original.tobytes()
    TRANSFORMS["origin to geometry"](monkey)
    TRANSFORMS["origin to cursor"](monkey)
    cubify(monkey, seed=3)
    bridge.restore(monkey)
    extent = np.ptp(bridge.read_positions(mesh), axis=0)
    np.testing.assert_allclose(extent, np.ptp(expected, axis=0), rtol=1e-3)


@pytest.mark.parametrize("axes", [(1, 1, 0), (1, 0, 0), (0, 0, 0)])
def test_scaled_to_nothing_keeps_the_lost_extent(bridge, cubify, monkey, axes):
    mesh = monkey.data
    monkey.location, monkey.rotation_euler = (0, 0, 0), (0, 0, 0)
    base, keys = bridge.read_positions(mesh), all_points(mesh)
    cubify(monkey)
    apply_all(monkey, scale=axes)
    assert bridge.is_edited(mesh)
    flat = bridge.read_positions(mesh)
    assert np.array_equal(bridge.original_positions(mesh), flat)
    bridge.restore(monkey)
    restored = bridge.read_positions(mesh)
    span = np.ptp(base, axis=0)
    assert sorted(np.ptp(restored, axis=0)) == pytest.approx(sorted(span), rel=0.6)
    lost = np.array(axes) == 0
    np.testing.assert_allclose(restored[:, ~lost], base[:, ~lost], atol=1e-5)
    for name, points in keys.items():
        lengths = np.linalg.norm(points - base, axis=1)
        found = np.linalg.norm(all_points(mesh)[name] - restored, axis=1)
        np.testing.assert_allclose(found, lengths, atol=1e-5)


def _sheet():
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=5, y_subdivisions=5)


def _triangle():
    mesh = bpy.data.meshes.new("Triangle")
    mesh.from_pydata([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [], [(0, 1, 2)])
    obj = bpy.data.objects.new("Triangle", mesh)
    bpy.context.collection.objects.link(obj)
    select(obj)


@pytest.mark.parametrize("make", [_sheet, _triangle])
def test_flat_meshes_keep_what_stands_out(bridge, make):
    """The original need not be flat where the result is: it is turned and scaled with the rest."""
    make()
    obj = bpy.context.object
    flat = position_of(obj.data)
    base = flat + np.float32((0, 0, 0.25)) * (np.arange(len(flat)) % 2)[:, None]
    set_position(obj.data, base)
    bridge.write_mesh(obj.data, flat, np.broadcast_to(np.eye(3), (len(flat), 3, 3)))
    apply_all(obj, rotation_euler=(math.pi / 2, 0, 0), scale=(2, 2, 2), location=(1, 2, 3))
    assert not bridge.is_edited(obj.data)
    x, y, z = base.T
    expected = np.stack([2 * x + 1, -2 * z + 2, 2 * y + 3], axis=1)
    np.testing.assert_allclose(bridge.original_positions(obj.data), expected, atol=1e-5)


def test_edit_of_a_key_survives_a_transform(bridge, keyed_monkey):
    mesh = keyed_monkey.data
    keyed_monkey.location, keyed_monkey.rotation_euler = (0, 0, 0), (0, 0, 0)
    before = all_points(mesh)
    positions, rotations = cubic_like(before["Basis"])
    bridge.write_mesh(mesh, positions, rotations)
    mesh.shape_keys.key_blocks["Wide"].points[20].co.z += 0.5
    apply_all(keyed_monkey, scale=(-1, 2, 3))
    bridge.restore(keyed_monkey)
    back = (rotations[20].T @ (0, 0, 0.5)) * (-1, 2, 3)
    expected = {name: points * (-1.0, 2.0, 3.0) for name, points in before.items()}
    expected["Wide"][20] += back
    for name, points in expected.items():
        np.testing.assert_allclose(points_of(mesh, name), points, atol=2e-5)


def test_results_of_the_first_version(bridge, cubify, error, monkey):
    """They have no marks: unchanged they are restored, transformed they are what is there."""
    mesh = monkey.data
    before = snapshot_object(monkey)
    for is_moved in (False, True):
        cubify(monkey)
        for name in ("mark", "written"):
            mesh.attributes.remove(mesh.attributes[f"cubic_craft_original.{name}"])
        if is_moved:
            apply_all(monkey, scale=(2, 2, 2))
            assert not bridge.has_original(mesh)
            with pytest.raises(error, match=r"edited since .* can no longer be determined"):
                bridge.restore(monkey)
            cubify(monkey)
            assert bridge.has_original(mesh)
        else:
            bridge.restore(monkey)
            active = ("*attributes/active*",)  # removing attributes as above moves it
            assert differences(before, snapshot_object(monkey), ignore=active) == []


@pytest.mark.thorough(14)
@pytest.mark.parametrize("name", TRANSFORMS)
def test_our_shape_key_stays_ours(bridge, cubify, monkey, name):
    mesh = monkey.data
    count = len(mesh.shape_keys.key_blocks) if mesh.shape_keys else 0
    cubify(monkey, "SHAPE_KEY")
    mesh.shape_keys.key_blocks["Cubic"].value = 0.25
    TRANSFORMS[name](monkey)
    base = bridge.read_positions(mesh)
    assert bridge.has_original(mesh) and not bridge.is_edited(mesh)
    positions = cubic_like(base, 2)[0]
    bridge.write_shape_key(monkey, positions)
    assert len(mesh.shape_keys.key_blocks) == max(count, 1) + 1
    assert mesh.shape_keys.key_blocks["Cubic"].value == 0.25
    assert points_of(mesh, "Cubic")[:-4].tobytes() == positions[:-4].tobytes()
    bridge.restore(monkey)
    assert bridge.read_positions(mesh).tobytes() == base.tobytes()
    assert (len(mesh.shape_keys.key_blocks) if mesh.shape_keys else 0) == count
    assert not bridge.has_traces(mesh)


def test_our_shape_key_edited_and_transformed_is_the_artists(bridge, cubify, monkey):
    mesh = monkey.data
    cubify(monkey, "SHAPE_KEY")
    mesh.shape_keys.key_blocks["Cubic"].points[7].co.z += 1e-3
    apply_all(monkey, scale=(1, 2, 3))
    assert not bridge.has_original(mesh)
    cubify(monkey, "SHAPE_KEY")
    assert "Cubic.001" in mesh.shape_keys.key_blocks
