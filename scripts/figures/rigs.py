# SPDX-License-Identifier: GPL-3.0-or-later
"""A rigged bear, made cubic in its rest pose and posed by its rig, or made cubic in its pose."""

import math

import bpy
import numpy as np

from cubic_craft.cubic_craft_addon.command_line.picture.gallery import Group
from cubic_craft.cubic_craft_addon.mesh_bridge import read_position
from cubic_craft.solver import ProxyOptions, stylize

from .figure_meshes import FigureMeshes, Model

CUBENESS = 0.4
BONES = {
    # name: head, tail, parent
    "Spine": ((0.0, 0.0, -1.0), (0.0, 0.0, 0.35), None),
    "Head": ((0.0, 0.0, 0.35), (0.0, 0.0, 1.6), "Spine"),
    "Arm.L": ((0.5, 0.0, 0.1), (1.3, 0.0, -0.3), "Spine"),
    "Arm.R": ((-0.5, 0.0, 0.1), (-1.3, 0.0, -0.3), "Spine"),
    "Leg.L": ((0.4, 0.0, -0.9), (0.6, -0.6, -1.2), None),
    "Leg.R": ((-0.4, 0.0, -0.9), (-0.6, -0.6, -1.2), None),
}
POSE = {"Spine": (0, 0, 18), "Head": (0, 0, -38), "Arm.L": (0, 0, 75), "Arm.R": (0, 0, 20)}
"""degrees about the bone's own axes"""


def compose(meshes: FigureMeshes) -> list[Group]:
    """Return the original at rest and posed, and both ways to make it cubic."""
    (model,) = meshes.there([], instead=["bear"])
    cubic = meshes.cubified(model, CUBENESS)
    rig = _rig(model)
    posed = _posed(model, rig, model.original)
    kept = _posed(model, rig, cubic)
    mesh = model.object.data
    mesh.calc_loop_triangles()
    F = np.array([triangle.vertices for triangle in mesh.loop_triangles])
    each = stylize(posed, F, CUBENESS, proxy=ProxyOptions(), keep_rotation=True, crispness=0.0)
    pairs = (
        (model.original, "original", "grey"),
        (posed, "its pose", "grey"),
        (kept, "made cubic, then posed", "green"),
        (each.positions.astype(np.float32), "posed, then made cubic", "green"),
    )
    _unrig(model, rig)
    return [meshes.group(model, *pair) for pair in pairs]


def _rig(model: Model) -> bpy.types.Object:
    bpy.context.window.scene = model.scene
    rig = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    model.scene.collection.objects.link(rig)
    bpy.context.view_layer.objects.active = rig
    bpy.ops.object.mode_set(mode="EDIT")
    for name, (head, tail, parent) in BONES.items():
        bone = rig.data.edit_bones.new(name)
        bone.head, bone.tail = head, tail
        if parent:
            bone.parent = rig.data.edit_bones[parent]
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.object.select_all(action="DESELECT")
    model.object.select_set(True)
    rig.select_set(True)
    bpy.ops.object.parent_set(type="ARMATURE_AUTO")
    for name, angles in POSE.items():
        bone = rig.pose.bones[name]
        bone.rotation_mode = "XYZ"
        bone.rotation_euler = [math.radians(angle) for angle in angles]
    return rig


def _posed(model: Model, rig: bpy.types.Object, positions: np.ndarray) -> np.ndarray:
    """Return where the rig takes positions (n,3)."""
    mesh = model.object.data
    before = read_position(mesh)
    mesh.vertices.foreach_set("co", positions.ravel())
    mesh.update()
    depsgraph = bpy.context.evaluated_depsgraph_get()
    found = read_position(model.object.evaluated_get(depsgraph).data)
    mesh.vertices.foreach_set("co", before.ravel())
    mesh.update()
    return found


def _unrig(model: Model, rig: bpy.types.Object) -> None:
    model.object.parent = None
    model.object.modifiers.clear()
    model.object.vertex_groups.clear()
    bpy.data.armatures.remove(rig.data)
