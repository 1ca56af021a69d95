# SPDX-License-Identifier: GPL-3.0-or-later
"""A figure that walks: left as it is, in the middle cubic and then posed, right every frame cubic.

Run it with the extension enabled: blender -b -P examples/walk.py -- walk.png
The baked frames are written beside the picture.
"""

import math
import sys
from pathlib import Path

import bpy

sys.path.append(str(Path(__file__).parent))
from studio import NEXT, empty_scene, figure, paint, picture_path, select, take_picture

BONES = {  # name: head, tail, parent, degrees that it swings by
    "Body": ((0.0, 0.0, 0.8), (0.0, 0.0, 2.1), None, 0.0),
    "Leg.L": ((0.16, 0.0, 0.75), (0.28, 0.0, 0.0), "Body", 30.0),
    "Leg.R": ((-0.16, 0.0, 0.75), (-0.28, 0.0, 0.0), "Body", -30.0),
    "Arm.L": ((0.25, 0.0, 1.35), (0.95, 0.0, 1.0), "Body", -25.0),
    "Arm.R": ((-0.25, 0.0, 1.35), (-0.95, 0.0, 1.0), "Body", 25.0),
}
LAST_FRAME = 6


def rig(body):
    """Give the body bones that swing from the first frame to the last."""
    armature = bpy.data.objects.new("Rig", bpy.data.armatures.new("Rig"))
    armature.location = body.location
    bpy.context.collection.objects.link(armature)
    select([armature])
    bpy.ops.object.mode_set(mode="EDIT")
    bones = armature.data.edit_bones
    for name, (head, tail, parent, _) in BONES.items():
        bone = bones.new(name)
        bone.head, bone.tail = head, tail
        bone.parent = bones.get(parent) if parent else None
    bpy.ops.object.mode_set(mode="OBJECT")
    select([armature, body])
    bpy.ops.object.parent_set(type="ARMATURE_AUTO")
    for name, (*_, swing) in BONES.items():
        bone = armature.pose.bones[name]
        bone.rotation_mode = "XYZ"
        for frame, angle in ((1, 0.0), (LAST_FRAME, math.radians(swing))):
            bone.rotation_euler.x = angle
            bone.keyframe_insert("rotation_euler", frame=frame)


empty_scene()
scene = bpy.context.scene
scene.frame_start, scene.frame_end = 1, LAST_FRAME
bodies = [figure(number * NEXT) for number in range(3)]
for body in bodies:
    rig(body)
paint(bodies[:1], 0.5, 0.2, 0.1)
paint(bodies[1:], 0.02, 0.3, 0.25)
scene.frame_set(1)

select([bodies[1]])
bpy.ops.cubic_craft.cubify(cubeness=0.6)

select([bodies[2]])
bodies[2].cubic_craft.cubeness = 0.6
folder = picture_path().parent if picture_path() else bpy.app.tempdir
bpy.ops.cubic_craft.bake_animation(folder=str(folder), format="CACHE")

scene.frame_set(LAST_FRAME)
take_picture()
