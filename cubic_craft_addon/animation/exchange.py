# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of baked frames for other programs, by Blender's exporters."""

from collections.abc import Sequence
from pathlib import Path

import bpy

from ...solver import CubicCraftError
from ..environment.scene_state import frame_kept, only_selected
from ..send.targets import Options, exporter, settings, target_of

SUFFIXES = {"CACHE": ".pc2", "SHAPE_KEYS": ".pc2", "ALEMBIC": ".abc", "USD": ".usdc"}
"""of the files of each format; shape keys are read from a point cache"""


def export_frames(objects: Sequence[bpy.types.Object], path: Path, start: int, end: int) -> None:
    """Write frames of objects, without others, to an Alembic or USD file.

    The selection, the frame and the range of the scene come back.

    Raises CubicCraftError: nothing was written.
    """
    scene = bpy.context.scene
    before = scene.frame_start, scene.frame_end
    try:
        with frame_kept(), only_selected(objects):
            scene.frame_start, scene.frame_end = start, end
            target = target_of(path.suffix)
            options = Options(frames=(start, end), suffix=path.suffix)
            chosen = settings(target, list(objects), options, is_modified=True)
            exporter(target)(filepath=str(path), **chosen)
    except RuntimeError as error:
        raise CubicCraftError(f'"{path.name}" could not be written: {error}') from error
    finally:
        scene.frame_start, scene.frame_end = before
    if not path.exists():
        raise CubicCraftError(f'"{path.name}" could not be written')
