# SPDX-License-Identifier: GPL-3.0-or-later
"""Screenshots, into the output folder of the run (GUIDRIVE_SHARE)."""

import os
import pathlib
import shutil
import subprocess

import bpy

from .screen import in_region, smooth_viewport, x_window
from .waiting import wait_redraw

_QUICK = 11  # ImageMagick's quality of a PNG: half the time of the default, and as sharp
_SMALL = 75
_SAMPLES = 5  # of smooth_viewport: Blender draws the view so often, each time a bit smoother


def screenshot(name):
    """Redraw the viewport, save the window as PNG <output folder>/<name> and return its path."""
    yield from wait_redraw()
    return save_screen(name)


def smooth_screenshot(name):
    """Do what screenshot does, with smooth edges: for pictures that people look at."""
    smooth_viewport()
    for _ in range(_SAMPLES):
        yield from wait_redraw()
    path = save_screen(name, _SMALL)
    smooth_viewport(False)
    return path


def save_screen(name, quality=_QUICK):
    """Save the window as it is now; see screenshot."""
    path = pathlib.Path(os.environ["GUIDRIVE_SHARE"]) / name
    path.parent.mkdir(parents=True, exist_ok=True)
    x_id = x_window()
    if x_id and shutil.which("import"):
        subprocess.run(["import", "-window", x_id, "-quality", str(quality), str(path)], check=True)
    else:  # reads the front buffer, which is black in Xvfb
        with in_region():
            bpy.ops.screen.screenshot(filepath=str(path))
    return str(path)
