# SPDX-License-Identifier: GPL-3.0-or-later
"""Where Blender's Python is newer than any wheel of Taichi: what the user reads, and what works.

PACKAGE is the file of a package, PLAIN that of the extension without wheels. SciPy is there.
"""

import os
import sys

import bpy
import guidrive as gui
from preferences_area import cubify, drop, open_preferences, redraw, unpacked_wheels

ADDON = "bl_ext.user_default.cubic_craft"


def refused():
    """Install as a script does, which gets as an exception what the user reads."""
    try:
        bpy.ops.extensions.package_install_files(
            filepath=os.environ["PACKAGE"], repo="user_default", enable_on_install=True
        )
    except RuntimeError as error:
        return str(error)
    raise AssertionError("it was installed")


def test():
    yield from open_preferences()
    yield from drop(os.environ["PACKAGE"], "1_dropped.png")
    yield 2.0
    yield from redraw()
    yield from gui.screenshot("2_refused.png")
    yield from gui.keys("ESC")  # closes the report
    assert ADDON not in bpy.context.preferences.addons and not unpacked_wheels()
    text = refused()
    gui.log("the user reads:", text)
    assert "This Python version ({}.{}) isn't compatible".format(*sys.version_info) in text

    done = bpy.ops.extensions.package_install_files(
        filepath=os.environ["PLAIN"], repo="user_default", enable_on_install=True
    )
    assert done == {"FINISHED"} and ADDON in bpy.context.preferences.addons
    yield from cubify("numpy")
    yield from gui.screenshot("3_without_wheels.png")


gui.run(test)
