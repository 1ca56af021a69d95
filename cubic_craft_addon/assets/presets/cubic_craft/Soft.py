# SPDX-License-Identifier: GPL-3.0-or-later
# pyright: reportAttributeAccessIssue=false
"""A hint of a cube: the shape stays as it is, its sides become a little flatter."""

import bpy

bpy.context.object.cubic_craft.cubeness = 0.1
bpy.context.object.cubic_craft.solidity = 0.3
bpy.context.object.cubic_craft.keep_pose = True
bpy.context.object.cubic_craft.detail = 0.1
bpy.context.object.cubic_craft.keep_apart = True
bpy.context.object.cubic_craft.together = "SELECTION"
bpy.context.object.cubic_craft.refine = "AUTO"
bpy.context.object.cubic_craft.rotation = "KEEP"
bpy.context.object.cubic_craft.hold_rest = True
