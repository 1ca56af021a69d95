# SPDX-License-Identifier: GPL-3.0-or-later
"""Programs of `startup`: each ends its process at once when it has its first result.

The end is not measured, and that of Blender 4.2 is a crash.
"""

import os


def monkey():
    """Cubify Blender's monkey."""
    import bpy
    from headless.extension import registered

    from .startup import ROOT

    with registered(ROOT):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        bpy.ops.mesh.primitive_monkey_add()
        state = bpy.ops.cubic_craft.cubify()
        os._exit(0 if state == {"FINISHED"} else 1)


def bpy():
    """Import Blender, and nothing else."""
    import bpy  # noqa: F401

    os._exit(0)


def solver():
    """Stylize a sphere without Blender."""
    from solver import stylize

    from .shapes import sphere

    stylize(*sphere(32, 16), 0.4)
    os._exit(0)
