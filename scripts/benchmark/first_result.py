# SPDX-License-Identifier: GPL-3.0-or-later
"""Programs of `startup`: each ends its process at once when it has its first result.

The end is not measured, and that of Blender 4.2 is a crash. `click` alone ends in the regular way,
which is when the engine writes its kernels to disk.
"""

import json
import os
import time
from itertools import pairwise


def monkey():
    """Cubify Blender's monkey."""
    import bpy

    from cubic_craft import registered

    with registered():
        bpy.ops.mesh.primitive_monkey_add()
        state = bpy.ops.cubic_craft.cubify()
        os._exit(0 if state == {"FINISHED"} else 1)


def click():
    """Cubify the monkey after all that the panel loads ahead, and print the seconds as JSON."""
    import bpy

    from cubic_craft import registered
    from cubic_craft.solver import loading_steps

    with registered():
        bpy.ops.mesh.primitive_monkey_add()
        ends = [time.perf_counter()]
        for _ in loading_steps():
            ends.append(time.perf_counter())
        assert bpy.ops.cubic_craft.cubify() == {"FINISHED"}
        seconds = {"click": time.perf_counter() - ends[-1], "ahead": ends[-1] - ends[0]}
        longest = max(after - before for before, after in pairwise(ends))
        print(json.dumps(seconds | {"longest": longest}))


def bpy():
    """Import Blender, and nothing else."""
    import bpy  # noqa: F401

    os._exit(0)


def solver():
    """Stylize a sphere without Blender."""
    from solver import PAPER, stylize

    from .shapes import sphere

    stylize(*sphere(32, 16), 0.4, proxy=PAPER)
    os._exit(0)
