# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of baked frames for other programs, by Blender's exporters."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import bpy

from ...solver import CubicCraftError
from ..environment.scene_state import frame_kept, only_selected

SUFFIXES = {"CACHE": ".pc2", "SHAPE_KEYS": ".pc2", "ALEMBIC": ".abc", "USD": ".usdc"}
"""of the files of each format; shape keys are read from a point cache"""
_NAMES = {".abc": "Alembic", ".usd": "USD", ".usdc": "USD", ".usda": "USD"}


def check_format(suffix: str) -> None:
    """Raise a CubicCraftError if this Blender cannot write files that end so."""
    name = _NAMES.get(suffix)
    if name is not None and not getattr(bpy.app.build_options, name.lower()):
        raise CubicCraftError(f"this Blender was built without {name}; choose another format")


def export_frames(objects: Sequence[bpy.types.Object], path: Path, start: int, end: int) -> None:
    """Write frames of objects, without others, to an Alembic or USD file.

    The selection, the frame and the range of the scene come back.

    Raises
    ------
    CubicCraftError
        Nothing was written.
    """
    scene = bpy.context.scene
    before = scene.frame_start, scene.frame_end
    try:
        with frame_kept(), only_selected(objects):
            scene.frame_start, scene.frame_end = start, end
            _write(path, start, end)
    except RuntimeError as error:
        raise CubicCraftError(f'"{path.name}" could not be written: {error}') from error
    finally:
        scene.frame_start, scene.frame_end = before
    if not path.exists():
        raise CubicCraftError(f'"{path.name}" could not be written')


def _write(path, start, end):
    if path.suffix == ".abc":
        bpy.ops.wm.alembic_export(
            filepath=str(path),
            start=start,
            end=end,
            selected=True,
            as_background_job=False,
            evaluation_mode="VIEWPORT",
        )
    else:
        bpy.ops.wm.usd_export(
            filepath=str(path),
            selected_objects_only=True,
            export_animation=True,
            evaluation_mode="VIEWPORT",
            export_materials=False,
        )
