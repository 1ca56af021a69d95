# SPDX-License-Identifier: GPL-3.0-or-later
"""Where Blender's Python is newer than any wheel of Taichi: what the user reads, and what works.

PACKAGE is the file of the package for Linux, PLAIN that of the extension without wheels.
"""

import os
import sys

import bpy
import guidrive as gui
from preferences_area import open_preferences, redraw, unpacked_wheels

ADDON = "bl_ext.user_default.cubic_craft"


def drop(path):
    """Do what happens when a zip is dropped on the window, and confirm."""
    with gui.in_region():
        bpy.ops.extensions.package_install_files("INVOKE_DEFAULT", url=path)
    for _ in range(20):
        yield


def test():
    yield from open_preferences()
    yield from drop(os.environ["PACKAGE"])
    yield from gui.screenshot("1_dropped.png")
    yield from gui.keys("ESC")
    try:
        bpy.ops.extensions.package_install_files(
            filepath=os.environ["PACKAGE"], repo="user_default", enable_on_install=True
        )
    except RuntimeError as error:
        gui.log("the user reads:", error)
        assert "Python version (%d.%d)" % sys.version_info[:2] in str(error), error
    else:
        raise AssertionError("it was installed")
    assert ADDON not in bpy.context.preferences.addons and not unpacked_wheels()
    yield from redraw()
    yield from gui.screenshot("2_refused.png")

    done = bpy.ops.extensions.package_install_files(
        filepath=os.environ["PLAIN"], repo="user_default", enable_on_install=True
    )
    assert done == {"FINISHED"} and ADDON in bpy.context.preferences.addons
    with gui.in_region():
        bpy.ops.object.select_all(action="SELECT")
        bpy.ops.object.delete()
        bpy.ops.mesh.primitive_monkey_add()
    yield from gui.open_sidebar("Cubic Craft")
    button = yield from gui.find_button("cubic_craft.cubify")
    yield from gui.click(button)
    for _ in range(20):
        yield
    yield from gui.wait_until(lambda: not gui.running_operators(), timeout=120.0, what="Cubify")
    status = bpy.context.view_layer.objects.active.cubic_craft.status
    gui.log("status:", status)
    yield from gui.screenshot("3_without_wheels.png")
    assert "numpy" in status, status


gui.run(test)
