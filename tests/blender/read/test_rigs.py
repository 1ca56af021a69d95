# SPDX-License-Identifier: GPL-3.0-or-later
"""A rigged mesh that is made cubic at rest: its armature, drivers and keys go on working."""

import numpy as np
import pytest

import bpy  # isort: skip
from mathutils import Vector  # isort: skip
from rig import ball_with_bones, seen  # isort: skip
from scene import select  # isort: skip

ANGLE = 1.2
PUSH = 0.3
KEYS = {"Smile": (0, 0, 0.2), "Bulge": (PUSH, 0, 0)}


@pytest.fixture
def rigged(empty_file):
    """Return a ball with bones, a key that an artist dials, and one that the bend drives."""
    ball, rig = ball_with_bones()
    ball.shape_key_add(name="Basis", from_mix=False)
    for name, offset in KEYS.items():
        key = ball.shape_key_add(name=name, from_mix=False)
        key.value = 0.0
        for vertex, point in zip(ball.data.vertices, key.data, strict=True):
            if abs(vertex.co.z) < 0.4 and vertex.co.x > 0.6:
                point.co = vertex.co + Vector(offset)
    curve = ball.data.shape_keys.key_blocks["Bulge"].driver_add("value")
    curve.driver.expression = f"min(angle / {ANGLE}, 1)"
    variable = curve.driver.variables.new()
    variable.name, variable.type = "angle", "TRANSFORMS"
    target = variable.targets[0]
    target.id, target.bone_target = rig, "High"
    target.transform_type, target.transform_space = "ROT_X", "LOCAL_SPACE"
    select(ball)
    return ball, rig


def bend(rig, angle):
    rig.pose.bones["High"].rotation_euler.x = angle
    bpy.context.view_layer.update()


def skinned(points, obj, rig):
    """Return where the bones take points (n,3), by linear blend skinning."""
    found = np.zeros_like(points)
    for name in ("Low", "High"):
        bone = rig.pose.bones[name]
        matrix = np.array(bone.matrix @ bone.bone.matrix_local.inverted())
        index = obj.vertex_groups[name].index
        weights = np.zeros(len(points))
        for vertex in obj.data.vertices:
            for group in vertex.groups:
                if group.group == index:
                    weights[vertex.index] = group.weight
        found += weights[:, None] * (points @ matrix[:3, :3].T + matrix[:3, 3])
    return found


def weights_of(obj):
    return [[(group.group, group.weight) for group in v.groups] for v in obj.data.vertices]


def key_points(obj, name):
    return np.array([point.co for point in obj.data.shape_keys.key_blocks[name].data])


def cubic_base(obj):
    """Return the cubic positions at rest with all keys at 0."""
    return np.array([vertex.co for vertex in obj.data.vertices])


def test_the_rig_bends_the_cubic_mesh_by_the_same_weights(rigged):
    ball, rig = rigged
    before = weights_of(ball)
    bpy.ops.cubic_craft.cubify("EXEC_DEFAULT", result="MESH")
    ball.data.shape_keys.key_blocks["Bulge"].mute = True
    assert weights_of(ball) == before and ball.modifiers["Armature"].object == rig
    assert np.ptp(np.linalg.norm(cubic_base(ball), axis=1)) > 0.2, "it is still a ball"
    bend(rig, ANGLE)
    np.testing.assert_allclose(seen(ball), skinned(cubic_base(ball), ball, rig), atol=1e-5)


@pytest.mark.parametrize("result", ["MESH", "SHAPE_KEY", "NEW_OBJECT"])
def test_the_driven_key_corrects_the_bend_of_the_cubic_mesh(rigged, result):
    ball, rig = rigged
    bpy.ops.cubic_craft.cubify("EXEC_DEFAULT", result=result)
    cubic = bpy.context.object
    keys = cubic.data.shape_keys.key_blocks
    assert keys["Bulge"].value == 0.0
    bend(rig, ANGLE)
    assert cubic.data.shape_keys.evaluated_get(bpy.context.evaluated_depsgraph_get()).key_blocks[
        "Bulge"
    ].value == pytest.approx(1.0)
    corrected = seen(cubic)
    keys["Bulge"].mute = True
    moved = np.linalg.norm(corrected - seen(cubic), axis=1)
    is_pushed = np.linalg.norm(key_points(ball, "Bulge") - key_points(ball, "Basis"), axis=1) > 0.01
    assert moved[is_pushed].min() > 0.5 * PUSH, "the corrective key does nothing"
    assert moved[~is_pushed].max() < 1e-5
