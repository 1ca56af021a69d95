# SPDX-License-Identifier: GPL-3.0-or-later
"""A figure in a shirt: left as it is, right made cubic together, so that the shirt stays outside.

Run it with the extension enabled: blender -b -P examples/clothes.py -- clothes.png
"""

import sys
from pathlib import Path

import bmesh
import bpy

sys.path.append(str(Path(__file__).parent))
from studio import NEXT, empty_scene, figure, paint, select, take_picture

THICKNESS = 0.03  # units between the skin and the shirt


def shirt_of(body):
    """Add a shirt, which is the skin of the body's middle, moved outward; return it."""
    obj = bpy.data.objects.new("Shirt", body.data.copy())
    obj.location = body.location
    bpy.context.collection.objects.link(obj)
    cloth = bmesh.new()
    cloth.from_mesh(obj.data)
    outside = [v for v in cloth.verts if not 0.75 < v.co.z < 1.5 or abs(v.co.x) > 0.55]
    bmesh.ops.delete(cloth, geom=outside, context="VERTS")
    for vertex in cloth.verts:
        vertex.co += THICKNESS * vertex.normal
    cloth.to_mesh(obj.data)
    cloth.free()
    return obj


empty_scene()
for number, cubeness in enumerate((0.0, 0.6)):
    body = figure(number * NEXT)
    shirt = shirt_of(body)
    paint([body], 0.5, 0.2, 0.1)
    paint([shirt], 0.02, 0.1, 0.4)
    select([body, shirt])
    bpy.ops.cubic_craft.cubify(cubeness=cubeness, together="SELECTION")
take_picture()
