# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators, one file each, named by its verb."""

import bpy

from .apply import CUBIC_CRAFT_OT_apply
from .auto_orient import CUBIC_CRAFT_OT_auto_orient
from .cubify import CUBIC_CRAFT_OT_cubify
from .live import CUBIC_CRAFT_OT_live, CUBIC_CRAFT_OT_live_cancel
from .preset_add import CUBIC_CRAFT_OT_preset_add
from .restore import CUBIC_CRAFT_OT_restore

register, unregister = bpy.utils.register_classes_factory(
    (
        CUBIC_CRAFT_OT_cubify,
        CUBIC_CRAFT_OT_restore,
        CUBIC_CRAFT_OT_apply,
        CUBIC_CRAFT_OT_auto_orient,
        CUBIC_CRAFT_OT_live,
        CUBIC_CRAFT_OT_live_cancel,
        CUBIC_CRAFT_OT_preset_add,
    )
)
