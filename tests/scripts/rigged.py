# SPDX-License-Identifier: GPL-3.0-or-later
"""A file with two balls that bend, for tests of ``--bake``."""

import numpy as np
from headless import make_blend

FRAMES = 6
_RIGGED = f"""
import math, sys, bpy
bpy.ops.wm.read_factory_settings(use_empty=True)
for name, x in (("Ball", 0.0), ("Other", 4.0)):
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=3, location=(x, 0, 0))
    ball = bpy.context.object
    ball.name = name
    bend = ball.modifiers.new("Bend", "SIMPLE_DEFORM")
    bend.deform_method, bend.deform_axis = "BEND", "X"
    for frame, angle in ((1, 0.0), ({FRAMES}, 0.8)):
        bend.angle = angle
        bend.keyframe_insert("angle", frame=frame)
bpy.context.scene.frame_end = {FRAMES}
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[1])
"""


def make_rigged(path):
    """Write the file, and return its path."""
    return make_blend(_RIGGED, path)


def read_pc2(path):
    """Return the positions (frames,n,3) of a point cache."""
    values = np.frombuffer(path.read_bytes(), "<f4", offset=32)
    return values.reshape(*np.frombuffer(path.read_bytes(), "<i4", count=8)[[7, 4]], 3)
