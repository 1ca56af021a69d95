# SPDX-License-Identifier: GPL-3.0-or-later
"""Cubify every frame of an animation, into one file that other programs play back."""

import contextlib
import shutil
from argparse import Namespace
from pathlib import Path
from typing import Any

import bpy

from ....solver.console.output import InputError, replacing
from ....solver.errors import CubicCraftError
from ...animation.bake import Bake, BakeOptions
from ...animation.playback import export_frames
from ...settings.values import Settings
from ..process.progress import say, task
from ..process.quiet import captured
from ..reading.load_meshes import Loaded
from .cubify_all import check_groups, handles_of_all, settings_of_object


def bake_frames(loaded: Loaded, options: Namespace) -> dict[str, Any]:
    """Bake the frames to the file of ``--bake``, and return what there is to report.

    What is solved stays in a folder beside the file until that is written: a run that was ended
    continues there.

    Raises InputError: the file cannot be written; CubicCraftError: an object or a setting cannot be
    used in some frame.
    """
    check_groups(loaded.objects, options)
    path = options.bake
    if path.suffix == ".pc2" and len(loaded.objects) > 1:
        raise InputError(f"--bake {path}: a .pc2 has one object; name it, --object NAME")
    scene = bpy.context.scene
    start, end = options.frames or (scene.frame_start, scene.frame_end)
    folder = path.with_name(f"{path.name}.unfinished")
    handles = handles_of_all(loaded, options)

    def settings_for(obj: bpy.types.Object) -> Settings:
        return settings_of_object(obj, handles[obj.name], options, loaded)

    count = len(range(start, end + 1))
    work = Bake(settings_for, loaded.objects, BakeOptions(start, end, folder))
    try:
        with task(f"{count} frames") as shown:
            for step in work.steps():
                shown.show(step.texts[0])
            shown.summary, problems = work.write(is_alone=True)
        found = [result.frames for result in work.results]
        if problems and found != [count] * len(loaded.objects):
            raise CubicCraftError("; ".join(problems))
        _export(path, work.baked, (start, end))
        for obj in work.baked:
            _cache_of(obj).unlink()
    finally:
        work.discard()
    with contextlib.suppress(OSError):  # something else is in it
        folder.rmdir()
    say(f"wrote {path}")
    for problem in problems:  # of all frames: how steady they are
        say(problem)
    return {"frames": [start, end], "objects": [vars(found) for found in work.results]}


def _export(path, baked, frames):
    with captured(), replacing(path) as temporary:
        if path.suffix == ".pc2":
            shutil.copyfile(_cache_of(baked[0]), temporary)
        else:
            export_frames(baked, temporary, *frames)


def _cache_of(obj):
    return Path(bpy.path.abspath(obj.modifiers[0].filepath))
