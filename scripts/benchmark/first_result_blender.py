# SPDX-License-Identifier: GPL-3.0-or-later
"""A program: cubify Blender's monkey and print the time of day when that is done.

Run as ``python first_result_blender.py SCRIPTS ROOT``, in a process of its own.
"""

import os
import sys
import time
from pathlib import Path

import bpy

SCRIPTS, ROOT = map(Path, sys.argv[1:])
sys.path.insert(0, str(SCRIPTS))

from headless.extension import registered  # noqa: E402

with registered(ROOT):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.mesh.primitive_monkey_add()
    state = bpy.ops.cubic_craft.cubify()
    if state != {"FINISHED"}:
        sys.exit(f"cubify returned {state}")
    print(f"done at {time.time()}", flush=True)
    os._exit(0)  # Blender 4.2 crashes at its end, and the end is not measured
