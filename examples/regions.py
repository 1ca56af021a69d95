# SPDX-License-Identifier: GPL-3.0-or-later
"""A monkey whose upper half becomes an octahedron, and whose lower half becomes a cube.

Run it with the extension enabled: blender -b -P examples/regions.py -- regions.png
"""

import sys
from pathlib import Path

import bpy

sys.path.append(str(Path(__file__).parent))
from studio import NEXT, empty_scene, monkey, paint, take_picture

empty_scene()
paint([monkey()], 0.5, 0.2, 0.1)
cubic = monkey(NEXT)
paint([cubic], 0.02, 0.3, 0.25)

top = cubic.vertex_groups.new(name="Top")
for vertex in cubic.data.vertices:
    weight = min(max(0.5 + 2.0 * vertex.co.z, 0.0), 1.0)  # blends where it is between 0 and 1
    top.add([vertex.index], weight, "REPLACE")

bpy.ops.cubic_craft.region_add(group="Top")
region = cubic.cubic_craft.regions[0]
region.form = "OCTAHEDRON"
region.cubeness = 0.8
bpy.ops.cubic_craft.cubify(cubeness=0.6)
take_picture()
