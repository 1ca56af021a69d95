# SPDX-License-Identifier: GPL-3.0-or-later
"""What exporters look at in the scene, set for a while and put back."""

import contextlib
from collections.abc import Iterator, Sequence

import bpy

from ...solver.errors import CubicCraftError


@contextlib.contextmanager
def only_selected(objects: Sequence[bpy.types.Object]) -> Iterator[list[str]]:
    """Select these objects and no others; yields the names of those that cannot be.

    Raises CubicCraftError: the first of them cannot be.
    """
    view_layer = bpy.context.view_layer
    before, active = list(view_layer.objects.selected), view_layer.objects.active
    shown = [obj for obj in objects if obj.name in view_layer.objects and obj.hide_get()]
    try:
        for obj in before:
            obj.select_set(False)
        for obj in shown:
            obj.hide_set(False)
        for obj in objects:
            if obj.name in view_layer.objects:
                obj.select_set(True)
        view_layer.objects.active = objects[0]
        missing = [obj.name for obj in objects if obj not in list(view_layer.objects.selected)]
        if objects[0].name in missing:
            raise CubicCraftError(
                f'"{objects[0].name}" is hidden: show it and its collection first'
            )
        yield missing
    finally:
        for obj in list(view_layer.objects.selected):
            obj.select_set(False)
        for obj in before:
            obj.select_set(True)
        for obj in shown:
            obj.hide_set(True)
        view_layer.objects.active = active


@contextlib.contextmanager
def frame_kept() -> Iterator[None]:
    """Go back to the frame if an exporter has gone through others."""
    scene = bpy.context.scene
    before = scene.frame_current, scene.frame_subframe
    try:
        yield
    finally:
        if (scene.frame_current, scene.frame_subframe) != before:
            scene.frame_set(before[0], subframe=before[1])
