# SPDX-License-Identifier: GPL-3.0-or-later
# pyright: reportAttributeAccessIssue=false
"""Only the energy of Liu and Jacobson, as in their paper."""

import bpy

bpy.context.object.cubic_craft.crispness = 0.0
bpy.context.object.cubic_craft.solidity = 0.0
bpy.context.object.cubic_craft.keep_pose = False
bpy.context.object.cubic_craft.detail = 0.0
bpy.context.object.cubic_craft.detail_strength = 1.0
bpy.context.object.cubic_craft.keep_apart = False
bpy.context.object.cubic_craft.together = "OFF"
bpy.context.object.cubic_craft.refine = "OFF"
bpy.context.object.cubic_craft.rotation = "FREE"
bpy.context.object.cubic_craft.keep_symmetric = False
bpy.context.object.cubic_craft.hold_rest = False
