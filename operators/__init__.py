# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators, one file each, named by its verb."""

import bpy

from .apply import CUBIC_CRAFT_OT_apply
from .auto_orient import CUBIC_CRAFT_OT_auto_orient
from .bake_animation import CUBIC_CRAFT_OT_bake_animation, CUBIC_CRAFT_OT_bake_process
from .bake_normal_map import CUBIC_CRAFT_OT_bake_normal_map
from .busy import CUBIC_CRAFT_OT_busy
from .cubify import CUBIC_CRAFT_OT_cubify
from .cubify_cancel import CUBIC_CRAFT_OT_cubify_cancel
from .flatten import CUBIC_CRAFT_OT_flatten
from .form_from_selection import CUBIC_CRAFT_OT_form_from_selection
from .handle_add import CUBIC_CRAFT_OT_handle_add
from .handle_follow import CUBIC_CRAFT_OT_handle_follow
from .handle_move import CUBIC_CRAFT_OT_handle_move
from .handle_pin_selection import CUBIC_CRAFT_OT_handle_pin_selection
from .handle_remove import CUBIC_CRAFT_OT_handle_remove
from .handle_reset_pose import CUBIC_CRAFT_OT_handle_reset_pose
from .live import CUBIC_CRAFT_OT_live, CUBIC_CRAFT_OT_live_cancel
from .paint_map import CUBIC_CRAFT_OT_paint_map
from .preset_add import CUBIC_CRAFT_OT_preset_add
from .preset_remove import CUBIC_CRAFT_OT_preset_remove
from .region_add import CUBIC_CRAFT_OT_region_add
from .region_from_selection import CUBIC_CRAFT_OT_region_from_selection
from .region_remove import CUBIC_CRAFT_OT_region_remove
from .reset import CUBIC_CRAFT_OT_reset
from .restore import CUBIC_CRAFT_OT_restore
from .restore_first import CUBIC_CRAFT_OT_restore_first
from .select_crossing import CUBIC_CRAFT_OT_select_crossing
from .select_worn import CUBIC_CRAFT_OT_select_worn
from .send_to import CUBIC_CRAFT_OT_send_to
from .show_source import CUBIC_CRAFT_OT_show_source

register, unregister = bpy.utils.register_classes_factory(
    (
        CUBIC_CRAFT_OT_cubify,
        CUBIC_CRAFT_OT_cubify_cancel,
        CUBIC_CRAFT_OT_busy,
        CUBIC_CRAFT_OT_bake_animation,
        CUBIC_CRAFT_OT_bake_process,
        CUBIC_CRAFT_OT_bake_normal_map,
        CUBIC_CRAFT_OT_send_to,
        CUBIC_CRAFT_OT_restore,
        CUBIC_CRAFT_OT_restore_first,
        CUBIC_CRAFT_OT_apply,
        CUBIC_CRAFT_OT_show_source,
        CUBIC_CRAFT_OT_flatten,
        CUBIC_CRAFT_OT_select_crossing,
        CUBIC_CRAFT_OT_select_worn,
        CUBIC_CRAFT_OT_auto_orient,
        CUBIC_CRAFT_OT_form_from_selection,
        CUBIC_CRAFT_OT_live,
        CUBIC_CRAFT_OT_live_cancel,
        CUBIC_CRAFT_OT_paint_map,
        CUBIC_CRAFT_OT_preset_add,
        CUBIC_CRAFT_OT_preset_remove,
        CUBIC_CRAFT_OT_reset,
        CUBIC_CRAFT_OT_handle_add,
        CUBIC_CRAFT_OT_handle_remove,
        CUBIC_CRAFT_OT_handle_move,
        CUBIC_CRAFT_OT_handle_pin_selection,
        CUBIC_CRAFT_OT_handle_follow,
        CUBIC_CRAFT_OT_handle_reset_pose,
        CUBIC_CRAFT_OT_region_add,
        CUBIC_CRAFT_OT_region_remove,
        CUBIC_CRAFT_OT_region_from_selection,
    )
)
