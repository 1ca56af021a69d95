# SPDX-License-Identifier: GPL-3.0-or-later
"""Baked objects, which play back their frames, and files of these for other programs."""

import contextlib
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from ...solver import CubicCraftError
from ...solver.console.output import replacing
from .. import hidden_source, mesh_bridge
from ..environment.curves import curves_of
from ..environment.scene_state import frame_kept, only_selected
from ..send.targets import Options, exporter, settings, target_of
from .point_cache import read_point_cache
from .properties import SOURCE

SUFFIXES = {"CACHE": ".pc2", "SHAPE_KEYS": ".pc2", "ALEMBIC": ".abc", "USD": ".usdc"}
"""of the files of each format; shape keys are read from a point cache"""
MODIFIER = "Cubic Animation"
_MOST_STRETCH = 100  # of a Mesh Cache modifier


def stretch() -> float:
    """Return how many frames of the scene pass in a frame of its animation, by Time Stretching.

    What is baked counts the former, all that plays is given the latter.

    Raises CubicCraftError: they are more than Blender can play back.
    """
    render = bpy.context.scene.render
    factor = render.frame_map_new / render.frame_map_old
    if factor > _MOST_STRETCH:
        raise CubicCraftError(
            f"Time Stretching by more than {_MOST_STRETCH} times cannot be played back"
        )
    return factor


@contextlib.contextmanager
def shown(
    source: bpy.types.Object, new: bpy.types.Object, cache: Path
) -> Iterator[bpy.types.Object]:
    """Show a new object instead of its source, or give its mesh to the one baked before.

    Its mesh has the first frame of the cache. In the block, it is made to play; after an
    exception, all is as it was, and there is no new object.
    """
    mesh = mesh_bridge.mesh_of(new)
    baked = _baked_before(source)
    view_layer = bpy.context.view_layer
    selected, active = list(bpy.context.selected_objects), view_layer.objects.active
    try:
        mesh_bridge.move_vertices(new, read_point_cache(cache)[0])
        if baked is None:
            mesh_bridge.show_beside(new, source)
            setattr(new, SOURCE, source)
            yield new
        else:
            with _mesh_exchanged(baked, mesh):
                yield baked
    except BaseException:
        mesh_bridge.remove_copy(new)
        for obj in selected:
            obj.select_set(True)
        view_layer.objects.active = active
        raise
    if baked is not None:
        bpy.data.objects.remove(new)
    hidden_source.hide(source, new if baked is None else baked)


@contextlib.contextmanager
def _mesh_exchanged(baked, mesh):
    """Give a baked object another mesh, and another playback in the block."""
    before, modifiers = mesh_bridge.mesh_of(baked), list(baked.modifiers)
    earlier = [modifier for modifier in modifiers if modifier.name.startswith(MODIFIER)]
    baked.data = mesh
    for modifier in earlier:
        modifier.show_viewport = False  # it would play instead
    try:
        yield
    except BaseException:
        baked.data = before
        for modifier in list(baked.modifiers):
            if modifier not in modifiers:
                baked.modifiers.remove(modifier)
        for modifier in earlier:
            modifier.show_viewport = True
        raise
    for modifier in earlier:
        baked.modifiers.remove(modifier)
    for modifier in baked.modifiers:
        if modifier.name.startswith(MODIFIER):
            modifier.name = MODIFIER
    if not before.users:
        bpy.data.meshes.remove(before)


def play(baked: bpy.types.Object, cache: Path, path: Path, file_format: str, start: int) -> str:
    """Make a baked object play back the frames of a point cache from a frame on.

    `cache`: the point cache, which is removed where another format plays. `path`: the file to play
    back, which is the cache itself in the format CACHE. `start`: the first frame. Returns the name
    of the file, or of the shape keys. Raises CubicCraftError: this Blender cannot write or read the
    format.
    """
    if file_format == "SHAPE_KEYS":
        _play_keys(baked, read_point_cache(cache), start)
        cache.unlink()
        return f"shape keys of {baked.name}"
    modifier = _play_cache(baked, cache, start)
    if file_format == "CACHE":
        return path.name
    frames = len(read_point_cache(cache))
    with replacing(path) as partial:
        export_frames([baked], partial, start, start + frames - 1)
    baked.modifiers.remove(modifier)
    _play_file(baked, path)
    cache.unlink()
    return path.name


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


def _baked_before(source):
    """Return the object that was baked from a source before and is still in the scene."""
    scene = bpy.context.scene
    for obj in scene.objects:
        if getattr(obj, SOURCE) == source and isinstance(obj.data, bpy.types.Mesh):
            return obj
    return None


def _play_cache(baked, cache, start):
    modifier = baked.modifiers.new(MODIFIER, "MESH_CACHE")
    assert isinstance(modifier, bpy.types.MeshCacheModifier)
    modifier.cache_format = "PC2"
    modifier.filepath = _relative(cache)
    modifier.frame_start = start
    modifier.frame_scale = stretch()
    baked.modifiers.move(len(baked.modifiers) - 1, 0)
    return modifier


def _play_file(baked, path):
    known = set(bpy.data.cache_files)
    bpy.ops.cachefile.open(filepath=_relative(path))
    file = next(file for file in bpy.data.cache_files if file not in known)
    if stretch() != 1.0:  # such a file has no factor of its own
        file.override_frame = True
        curve: Any = file.driver_add("frame")
        curve.driver.expression = f"frame * {stretch()!r}"
    modifier = baked.modifiers.new(MODIFIER, "MESH_SEQUENCE_CACHE")
    modifier.cache_file = file
    modifier.read_data = {"VERT"}
    baked.modifiers.move(len(baked.modifiers) - 1, 0)
    bpy.context.evaluated_depsgraph_get()
    paths = [found.path for found in file.object_paths]
    if not paths:
        raise CubicCraftError(f'"{path.name}" has no object to play back')
    modifier.object_path = max(paths, key=len)  # the mesh, below its transform


def _play_keys(baked, frames, start):
    baked.shape_key_clear()
    mesh = mesh_bridge.mesh_of(baked)
    for number, positions in enumerate(frames):
        key = baked.shape_key_add(name=f"Frame {start + number}", from_mix=False)
        key.interpolation = "KEY_LINEAR"
        key.points.foreach_set("co", np.ascontiguousarray(positions).ravel())
    keys = mesh.shape_keys
    keys.use_relative = False
    blocks = keys.key_blocks
    for frame, key in ((start, blocks[0]), (start + len(frames) - 1, blocks[-1])):
        keys.eval_time = key.frame
        keys.keyframe_insert("eval_time", frame=frame / stretch())
    for curve in curves_of(keys.animation_data.action):
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"


def _relative(path):
    """Return a path relative to the .blend file, if that is saved on the same drive."""
    if not bpy.data.filepath:
        return str(path)
    try:
        return bpy.path.relpath(str(path))
    except ValueError:
        return str(path)
