# SPDX-License-Identifier: GPL-3.0-or-later
"""A program: import Blender alone and print the time of day when that is done."""

import os
import time

import bpy  # noqa: F401

print(f"done at {time.time()}", flush=True)
os._exit(0)
