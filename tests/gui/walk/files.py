# SPDX-License-Identifier: GPL-3.0-or-later
"""Files saved, opened and begun, whatever runs."""

import pathlib
import tempfile

import bpy
import guidrive as gui

from .actions import action, turns

_FOLDER = pathlib.Path(tempfile.mkdtemp())


@action(2)
def save(rng):
    path = _FOLDER / f"{rng.choice('ab')}.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=rng.random() < 0.3)
    yield from turns(2)
    return path.name


@action(1.5, goes_back=True)
def load(rng):
    saved = sorted(_FOLDER.glob("*.blend"))
    if not saved:
        return None
    path = rng.choice(saved)
    bpy.ops.wm.open_mainfile(filepath=str(path))
    yield from gui.wait_redraw()
    yield from turns(3)
    return path.name


@action(0.3, reshapes=True)
def new_file(_rng):
    bpy.ops.wm.read_homefile()
    yield from gui.wait_redraw()
    gui.simplify_viewport()
    yield from turns(3)
    return "new"
