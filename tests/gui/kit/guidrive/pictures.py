# SPDX-License-Identifier: GPL-3.0-or-later
"""Screenshots, into the output folder of the run (GUIDRIVE_SHARE)."""

import os
import pathlib
import shutil
import subprocess

import bpy

from .screen import in_region, x_window
from .waiting import wait_redraw


def screenshot(name):
    """Redraw the viewport, save the window as PNG <output folder>/<name> and return its path."""
    yield from wait_redraw()
    return save_screen(name)


def save_screen(name):
    """Save the window as it is now; see screenshot."""
    path = pathlib.Path(os.environ["GUIDRIVE_SHARE"]) / name
    path.parent.mkdir(parents=True, exist_ok=True)
    x_id = x_window()
    if x_id and shutil.which("import"):
        subprocess.run(["import", "-window", x_id, str(path)], check=True)
    else:  # reads the front buffer, which is black in Xvfb
        with in_region():
            bpy.ops.screen.screenshot(filepath=str(path))
    return str(path)
