# SPDX-License-Identifier: GPL-3.0-or-later
# pyright: reportAttributeAccessIssue=false
"""Clearly cubic, with wide round edges."""

import bpy

bpy.context.object.cubic_craft.cubeness = 0.25
bpy.context.object.cubic_craft.crispness = 0.0
bpy.context.object.cubic_craft.solidity = 0.1
bpy.context.object.cubic_craft.keep_pose = True
bpy.context.object.cubic_craft.detail = 0.05
bpy.context.object.cubic_craft.detail_strength = 1.0
bpy.context.object.cubic_craft.keep_apart = True
bpy.context.object.cubic_craft.together = "SELECTION"
bpy.context.object.cubic_craft.refine = "AUTO"
bpy.context.object.cubic_craft.rotation = "KEEP"
bpy.context.object.cubic_craft.keep_symmetric = True
bpy.context.object.cubic_craft.hold_rest = True
