# SPDX-License-Identifier: GPL-3.0-or-later
"""A ball that an armature bends, and what is seen of it."""

import math
import struct

import numpy as np

import bpy  # isort: skip
from scene import select  # isort: skip

FRAMES = 8


def ball_with_bones(subdivisions=3):
    """Add a ball, of 162 vertices, with the bones Low and High, and return it and the armature."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=subdivisions)
    ball = bpy.context.object
    ball.name = "Ball"
    armature = bpy.data.armatures.new("Rig")
    rig = bpy.data.objects.new("Rig", armature)
    bpy.context.scene.collection.objects.link(rig)
    select(rig)
    bpy.ops.object.mode_set(mode="EDIT")
    for name, height in (("Low", -1.0), ("High", 0.0)):
        bone = armature.edit_bones.new(name)
        bone.head, bone.tail = (0.0, 0.0, height), (0.0, 0.0, height + 1.0)
    bpy.ops.object.mode_set(mode="OBJECT")
    z = np.array([vertex.co.z for vertex in ball.data.vertices])
    share = np.clip(0.5 + z, 0.0, 1.0)
    for name, weights in (("Low", 1.0 - share), ("High", share)):
        group = ball.vertex_groups.new(name=name)
        for index, weight in enumerate(weights):
            group.add([index], weight, "REPLACE")
    modifier = ball.modifiers.new("Armature", "ARMATURE")
    modifier.object = rig
    rig.pose.bones["High"].rotation_mode = "XYZ"
    select(ball)
    return ball, rig


def bending_ball(subdivisions=3):
    """Add the ball with keyframes that bend it within the frames of the scene, and return it.

    It is solved as it is: on a finer copy each frame takes several times as long.
    """
    ball, rig = ball_with_bones(subdivisions)
    ball.cubic_craft.refine = "OFF"
    bone = rig.pose.bones["High"]
    for frame, angle in ((1, 0.0), (FRAMES, 0.8)):
        bone.rotation_euler.x = angle
        bone.keyframe_insert("rotation_euler", frame=frame)
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 1, FRAMES
    bpy.context.scene.frame_set(1)
    return ball


def seen(obj):
    """Return the visible positions (n,3) of an object."""
    mesh = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).data
    points = np.empty((len(mesh.vertices), 3), np.float32)
    mesh.vertices.foreach_get("co", points.ravel())
    return points


def shown(obj, frame):
    """Return the visible positions of an object in a frame."""
    bpy.context.scene.frame_set(frame)
    return seen(obj)


def read_pc2(path):
    """Read a point cache by the description of its format."""
    data = path.read_bytes()
    signature, version, points, start, rate, frames = struct.unpack("<12siiffi", data[:32])
    assert (signature, version, start, rate) == (b"POINTCACHE2\0", 1, 0.0, 1.0)
    return np.frombuffer(data, "<f4", offset=32).reshape(frames, points, 3)


def flatness(positions, mesh):
    """Return the share of the surface within 15 degrees of the sides of the cube."""
    triangles = np.array([tuple(face.vertices) for face in mesh.polygons])
    corners = positions[triangles].astype(float)
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    areas = np.linalg.norm(normals, axis=1)
    is_flat = np.abs(normals).max(axis=1) > math.cos(math.radians(15.0)) * areas
    return areas[is_flat].sum() / areas.sum()
