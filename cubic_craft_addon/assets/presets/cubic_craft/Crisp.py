# SPDX-License-Identifier: GPL-3.0-or-later
# pyright: reportAttributeAccessIssue=false
"""Edges as if cut with a knife; faces and other details stay."""

import bpy

bpy.context.object.cubic_craft.cubeness = 0.6
bpy.context.object.cubic_craft.crispness = 1.0
bpy.context.object.cubic_craft.solidity = 0.3
bpy.context.object.cubic_craft.keep_pose = True
bpy.context.object.cubic_craft.detail = 0.05
bpy.context.object.cubic_craft.detail_strength = 1.0
bpy.context.object.cubic_craft.keep_apart = True
bpy.context.object.cubic_craft.together = "SELECTION"
bpy.context.object.cubic_craft.refine = "AUTO"
bpy.context.object.cubic_craft.rotation = "KEEP"
bpy.context.object.cubic_craft.keep_symmetric = True
bpy.context.object.cubic_craft.hold_rest = True
