# SPDX-License-Identifier: GPL-3.0-or-later
"""A package for another Python than Blender's: what the user reads, and that nothing is installed.

OTHER is the file of the package.
"""

import os
import sys

import bpy
import guidrive as gui
from preferences_area import drop, open_preferences, redraw, unpacked_wheels

ADDON = "bl_ext.user_default.cubic_craft"


def refused():
    """Install as a script does, which gets as an exception what the user reads."""
    try:
        bpy.ops.extensions.package_install_files(
            filepath=os.environ["OTHER"], repo="user_default", enable_on_install=True
        )
    except RuntimeError as error:
        return str(error)
    raise AssertionError("it was installed")


def test():
    yield from open_preferences()
    yield from drop(os.environ["OTHER"], "1_dropped.png")
    yield 2.0
    yield from redraw()
    yield from gui.screenshot("2_refused.png")
    yield from gui.keys("ESC")  # closes the report
    assert ADDON not in bpy.context.preferences.addons and not unpacked_wheels()
    text = refused()
    gui.log("the user reads:", text)
    assert "This Python version ({}.{}) isn't compatible".format(*sys.version_info) in text


gui.run(test)
