# SPDX-License-Identifier: GPL-3.0-or-later
# pyright: reportAttributeAccessIssue=false
"""Flat sides; necks and limbs melt into one block."""

import bpy

bpy.context.object.cubic_craft.cubeness = 1.0
bpy.context.object.cubic_craft.crispness = 1.0
bpy.context.object.cubic_craft.solidity = 0.0
bpy.context.object.cubic_craft.keep_pose = False
bpy.context.object.cubic_craft.detail = 0.0
bpy.context.object.cubic_craft.detail_strength = 1.0
bpy.context.object.cubic_craft.keep_apart = True
bpy.context.object.cubic_craft.together = "SELECTION"
bpy.context.object.cubic_craft.refine = "AUTO"
bpy.context.object.cubic_craft.rotation = "KEEP"
bpy.context.object.cubic_craft.keep_symmetric = True
bpy.context.object.cubic_craft.hold_rest = True
