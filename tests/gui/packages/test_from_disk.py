# SPDX-License-Identifier: GPL-3.0-or-later
"""A package dropped on the window of a Blender without network and with nothing of our code.

PACKAGE is its file, FIRST_VERSION its version, EXPECT_DEVICE what it computes with. It is used,
disabled, enabled, removed and installed again.
"""

import os
import sys

import bpy
import guidrive as gui
from preferences_area import (
    ENGINE,
    cubify,
    drop,
    extensions,
    open_preferences,
    remove,
    wait_installed,
)

REPOSITORY = "user_default"
ADDON = f"bl_ext.{REPOSITORY}.cubic_craft"
DEVICE = os.environ["EXPECT_DEVICE"]


def install(picture):
    yield from drop(os.environ["PACKAGE"], picture)
    yield from wait_installed(REPOSITORY, os.environ["FIRST_VERSION"])


def test():
    assert ENGINE not in sys.modules and not bpy.app.online_access
    yield from open_preferences()
    yield from install("disk_1_dropped.png")
    yield from cubify(DEVICE)
    yield from gui.screenshot("disk_2_cubified.png")
    for name in (ENGINE, "scipy", "cholespy"):
        assert sys.modules[name].__file__.startswith(str(extensions())), sys.modules[name]

    assert bpy.ops.preferences.addon_disable(module=ADDON) == {"FINISHED"}
    assert not hasattr(bpy.types.Object, "cubic_craft")
    assert bpy.ops.preferences.addon_enable(module=ADDON) == {"FINISHED"}
    yield from cubify(DEVICE)

    yield from remove(REPOSITORY)
    yield from gui.screenshot("disk_3_removed.png")
    yield from install("disk_4_dropped_again.png")
    yield from cubify(DEVICE)
    yield from gui.screenshot("disk_5_cubified_again.png")


gui.run(test)
