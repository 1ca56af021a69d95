# SPDX-License-Identifier: GPL-3.0-or-later
"""Bones tell Keep Pose what the limbs are: after one click, the mesh lies on its bones."""

import importlib

import numpy as np
import pytest

import bpy  # isort: skip
from live_steps import tick_to_rest, wake_to_rest  # isort: skip
from mathutils import Quaternion  # isort: skip
from rig import seen  # isort: skip
from rigged_figure import LIMBS, add_figure, all_bones, figure_mesh, figure_weights  # isort: skip
from rich_mesh import position_of  # isort: skip
from scene import cubify as run_cubify  # isort: skip
from scene import select  # isort: skip

SIZE = 1.9
POSE = {
    "UpperArm.L": (0.7, (0, 1, 0)),
    "LowerArm.L": (-1.0, (1, 0, 0.3)),
    "UpperArm.R": (0.6, (0, 1, 0)),
    "UpperLeg.L": (0.7, (1, 0, 0)),
    "UpperLeg.R": (-0.4, (1, 0, 0)),
    "LowerLeg.R": (-0.7, (1, 0, 0)),
    "Spine": (0.2, (0, 0, 1)),
}


def cubify(iterations=1000, **settings):
    return run_cubify(cubeness=0.4, max_iterations=iterations, **settings)


@pytest.fixture(scope="module")
def body():
    """Return the mesh of the figure and its weights, made once."""
    mesh = figure_mesh()
    return {"mesh": mesh, "weights": figure_weights(mesh[0])}


@pytest.fixture
def figure(empty_file, body):
    return add_figure(**body)


def turn(rig, name, angle, axis):
    """Turn a pose bone about an axis of the rig."""
    bone = rig.pose.bones[name]
    bone.rotation_mode = "QUATERNION"
    own = bone.bone.matrix_local.to_3x3()
    about = own.inverted() @ Quaternion(axis, angle).to_matrix() @ own
    bone.rotation_quaternion = about.to_quaternion()


def take_pose(rig):
    for name, (angle, axis) in POSE.items():
        turn(rig, name, angle, axis)
    bpy.context.view_layer.update()


def turned(V, U, direction):
    """Return by how many degrees a direction turns with points from V (n,3) to U."""
    left, _, right = np.linalg.svd((V - V.mean(axis=0)).T @ (U - U.mean(axis=0)))
    flip = np.diag([1.0, 1.0, np.linalg.det(left @ right)])
    d = direction / np.linalg.norm(direction)
    return np.degrees(np.arccos(np.clip(d @ left @ flip @ right @ d, -1.0, 1.0)))


def winding(points, V, quads):
    """Return how often a surface winds around points (k,)."""
    F = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    found = []
    for point in points:
        a, b, c = (V[F] - point).swapaxes(0, 1)
        la, lb, lc = (np.linalg.norm(x, axis=1) for x in (a, b, c))
        volume = np.einsum("ij,ij->i", a, np.cross(b, c))
        below = la * lb * lc + (a * b).sum(1) * lc + (b * c).sum(1) * la + (c * a).sum(1) * lb
        found.append(np.arctan2(volume, below).sum() / (2.0 * np.pi))
    return np.array(found)


def test_limbs_keep_their_direction_and_their_joints(figure, body):
    obj, _ = figure
    V, quads = body["mesh"]
    cubify()
    U, bones = position_of(obj.data).astype(float), all_bones()
    assert np.abs(U - V).max() > 0.01 * SIZE
    for name in LIMBS:
        head, tail, _ = bones[name]
        is_own = body["weights"][name] > 0.5
        assert turned(V[is_own], U[is_own], np.subtract(tail, head)) < 10.0, name
    joints = np.array([bones[name][0] for name in LIMBS], float)
    np.testing.assert_allclose(winding(joints, V, quads), 1.0, atol=1e-3)
    np.testing.assert_allclose(winding(joints, U, quads), 1.0, atol=1e-3)


def test_without_keep_pose_arms_swing_and_bones_are_not_read(figure, body, part, monkeypatch):
    obj, _ = figure

    def fail(*_):
        raise AssertionError("bones were read")

    for module in ("read.member", "run.tasks"):
        for name in ("bone_places", "read_bones"):
            monkeypatch.setattr(part(module), name, fail, raising=False)
    V = body["mesh"][0]
    assert cubify(keep_pose=False) == {"FINISHED"}
    U, is_own = position_of(obj.data).astype(float), body["weights"]["LowerArm.L"] > 0.5
    assert turned(V[is_own], U[is_own], np.array([1.0, 0.0, -1.0])) > 25.0


def test_posed_by_its_rig_it_is_as_if_made_cubic_in_that_pose(figure):
    obj, rig = figure
    take_pose(rig)
    cubify(result="NEW_OBJECT", with_modifiers=True)
    in_pose = position_of(bpy.context.object.data)
    bpy.ops.cubic_craft.show_source()
    select(obj)
    cubify()
    far = np.linalg.norm(seen(obj) - in_pose, axis=1) / SIZE
    assert far.max() < 0.05 and far.mean() < 0.015


def test_both_sides_are_mirror_images(figure, body):
    obj, _ = figure
    V = body["mesh"][0]
    images = {tuple(row): number for number, row in enumerate(V.tolist())}
    image = [images[-x + 0.0, y, z] for x, y, z in V.tolist()]
    flip = np.array([-1.0, 1.0, 1.0], np.float32)
    obj.cubic_craft.symmetry = (True, False, False)
    cubify()
    U = position_of(obj.data)
    np.testing.assert_array_equal(U[image] * flip, U)


def test_half_a_figure_under_a_mirror_modifier_has_limbs_on_both_sides(figure, body):
    obj, _ = figure
    V, quads = body["mesh"]
    obj.cubic_craft.symmetry = (True, False, False)
    cubify()
    whole = position_of(obj.data)
    kept = np.flatnonzero(V[:, 0] >= 0.0)
    number = np.full(len(V), -1)
    number[kept] = np.arange(len(kept))
    halves = number[quads]
    mesh = V[kept], halves[(halves >= 0).all(axis=1)]
    half, _ = add_figure(
        "Half", mesh=mesh, weights={n: w[kept] for n, w in body["weights"].items()}
    )
    mirror = half.modifiers.new("Mirror", "MIRROR")
    half.modifiers.move(half.modifiers.find(mirror.name), 0)
    cubify()
    far = np.linalg.norm(position_of(half.data) - whole[kept], axis=1) / SIZE
    assert far.max() < 0.018


def test_bones_and_weights_that_change_restart_live(figure, live, begin):
    obj, rig = figure
    obj.cubic_craft.refine = "OFF"
    obj.cubic_craft.keep_symmetric = False  # the bones of one side will differ
    session = tick_to_rest(begin(obj))
    before = position_of(obj.data)
    bone = _edit(rig, "LowerArm.L", lambda bone: setattr(bone, "tail", bone.tail.xzy))
    select(obj)
    wake_to_rest(session)
    after = position_of(obj.data)
    assert np.abs(after - before).max() > 1e-3, f"{bone} was not seen"
    for vertex in range(len(obj.data.vertices)):
        obj.vertex_groups["UpperArm.L"].remove([vertex])
    obj.data.update()
    wake_to_rest(session)
    assert np.abs(position_of(obj.data) - after).max() > 1e-3
    session.on(live.Event.CANCEL)


def _edit(rig, name, change):
    select(rig)
    bpy.ops.object.mode_set(mode="EDIT")
    change(rig.data.edit_bones[name])
    bpy.ops.object.mode_set(mode="OBJECT")
    return name


def test_whatever_is_wrong_with_a_rig_the_shape_tells_instead(figure, part):
    obj, rig = figure
    places = part("read.bones").bone_places
    assert len(places(obj).groups) == len(all_bones())
    modifier = obj.modifiers["Armature"]
    modifier.use_vertex_groups = False
    assert places(obj) is None
    modifier.use_vertex_groups, modifier.show_viewport = True, False
    assert places(obj) is None
    modifier.show_viewport = True
    for bone in rig.data.bones:
        bone.use_deform = bone.name == "Hips"
    assert places(obj).groups == ("Hips",)
    rig.data.bones["Hips"].use_deform = False
    assert places(obj) is None and cubify() == {"FINISHED"}
    bpy.data.armatures.remove(rig.data)
    assert places(obj) is None


@pytest.mark.thorough(3)
@pytest.mark.parametrize("fault", ["flat", "empty", "short", "edited", "none", "zero"])
def test_a_broken_rig_is_no_reason_to_refuse(figure, fault):
    obj, rig = figure
    if fault == "flat":
        rig.scale = (1.0, 0.0, 1.0)
    elif fault == "empty":
        for group in obj.vertex_groups:
            group.remove(range(len(obj.data.vertices)))
    elif fault == "short":
        _edit(rig, "Hand.L", lambda bone: setattr(bone, "tail", bone.head + 1e-6 * bone.tail))
    elif fault == "edited":
        select(rig)
        bpy.ops.object.mode_set(mode="EDIT")
        rig.data.edit_bones["Hand.L"].tail.z += 0.1
        bpy.context.view_layer.objects.active = obj
    elif fault == "none":
        obj.modifiers["Armature"].object = None
    else:
        obj.modifiers["Armature"].object = bpy.data.objects.new("Empty", None)
    bpy.context.view_layer.update()
    if fault != "edited":
        select(obj)
        assert cubify(iterations=3) == {"FINISHED"}
    else:
        module = importlib.import_module(type(obj.cubic_craft).__module__.rsplit(".", 2)[0])
        bones = importlib.import_module(f"{module.__name__}.read.bones")
        assert len(bones.bone_places(obj).groups) == len(all_bones())
        bpy.ops.object.mode_set(mode="OBJECT")
