# SPDX-License-Identifier: GPL-3.0-or-later
"""Write meshes to a file of another program; nothing of the scene changes."""

import contextlib
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import bpy
import numpy as np

from ...solver import CubicCraftError
from ...solver.console.output import InputError, replacing
from .. import mesh_bridge
from ..environment.scene_state import frame_kept, only_selected
from .marks import armatures_of, marks_of
from .targets import TARGETS, Options, exporter, settings

_MILLIMETERS = 1000.0  # in a meter
SCALES = (
    ("SCENE", "Scene Unit", "As large as in the scene: a meter becomes 1000 mm"),
    ("MILLIMETERS", "Millimeters", "A unit of Blender becomes a millimeter"),
    ("SIZE", "Longest Side", "The longest side of everything that is written has a given length"),
)


@dataclass
class Ready:
    """What can be written now."""

    write: Callable[[Path], object]
    """runs Blender's exporter"""
    facts: list[str]
    """about what is written"""
    problems: list[str]
    """what the artist should know, one line each"""


def send(target: str, objects: list[bpy.types.Object], path: Path, options: Options):
    """Write mesh objects, and the armatures that pose them, to one file.

    The file is complete, or as it was before. Selection, meshes and frame are kept.

    `target`: one of `TARGETS`. `objects`: meshes in Object Mode. `path`: pathlib.Path, with the
    suffix of the target. Returns one line about the file, and the problems. Raises CubicCraftError:
    there is nothing to write, or no way to write it there.
    """
    exporter(target)
    if path.is_dir():
        raise CubicCraftError(f'"{path.name}" is a folder; type the name of a file')
    if not path.parent.is_dir():
        raise CubicCraftError(f'there is no folder "{path.parent}"; create it or choose another')
    with ready(target, objects, options) as it:
        size = _write(it.write, path)
    return f'Wrote "{path.name}": {", ".join(it.facts)}, {size / 1e6:,.2f} MB', it.problems


@contextlib.contextmanager
def ready(target: str, objects: list[bpy.types.Object], options: Options) -> Iterator[Ready]:
    """Have mesh objects, and the armatures that pose them, ready to be written during the block.

    `target`, `objects`, `options`: as of `send`. Raises CubicCraftError: there is nothing to write.
    """
    run, kind = exporter(target), TARGETS[target]
    for obj in objects:
        mesh_bridge.end_preview(mesh_bridge.mesh_of(obj))
        if not mesh_bridge.mesh_of(obj).polygons:
            raise CubicCraftError(f'"{obj.name}" has no faces to write')
    problems: list[str] = []
    is_modified = kind.is_printed or _can_apply(objects, options, problems)
    facts = [f"{len(objects)} object{'s' * (len(objects) > 1)}"]
    if kind.is_printed:
        sides = (f"{side:,.4g}" for side in extent(objects) * options.scale)
        facts.append(f"{' x '.join(sides)} mm")
    chosen = settings(target, objects, options, is_modified=is_modified)
    posed = [] if kind.is_printed else objects
    armatures = {armature for obj in posed for armature in armatures_of(obj)}
    with contextlib.ExitStack() as stack:
        for obj in {obj.data: obj for obj in objects}.values():
            values, own = marks_of(kind, obj, with_groups=options.with_groups)
            problems += own
            mesh = mesh_bridge.mesh_of(obj)
            stack.enter_context(
                mesh_bridge.carried_attributes(mesh, values, are_colors=kind.groups == "COLORS")
            )
        stack.enter_context(frame_kept())
        missing = stack.enter_context(only_selected([*objects, *armatures]))
        problems += [f'"{name}" cannot be selected: it was not written' for name in missing]
        yield Ready(lambda path: run(filepath=str(path), **chosen), facts, problems)


def _can_apply(objects: list[bpy.types.Object], options: Options, problems: list[str]) -> bool:
    """Return whether modifiers are applied: they are not where shape keys would be lost."""
    if not options.with_modifiers:
        return False
    if not any(mesh_bridge.mesh_of(obj).shape_keys for obj in objects):
        return True
    names = [
        f'"{obj.name}"'
        for obj in objects
        if any(mod.show_viewport and mod.type != "ARMATURE" for mod in obj.modifiers)
    ]
    if names:
        problems.append(
            f"shape keys were written, so the modifiers of {', '.join(names)} were not: write"
            " meshes with shape keys to a file of their own"
        )
    return False


def extent(objects: list[bpy.types.Object]) -> np.ndarray:
    """Return the sides (3,) of the box around objects, as they are seen in the world."""
    return np.ptp(np.concatenate([_points_in_world(obj) for obj in objects]), axis=0)


def _points_in_world(obj):
    points = mesh_bridge.read_evaluated_points(obj)[0]
    matrix = np.array(obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world)
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def _write(run: Callable[[Path], object], path: Path) -> int:
    """Write under another name first, and return the size of the file."""
    try:
        with replacing(path) as partial:
            run(partial)
    except RuntimeError as error:
        reason = str(error).strip().splitlines()[-1].removeprefix("Error: ")
        raise CubicCraftError(f'"{path.name}" cannot be written: {reason}') from error
    except InputError as error:
        raise CubicCraftError(str(error)) from error
    return path.stat().st_size


def scale_of(
    scale: str, size: float, scene: bpy.types.Scene, objects: list[bpy.types.Object]
) -> float:
    """Return how many millimeters a unit of Blender becomes.

    `scale`: one of `SCALES`. `size`: length of the longest side in millimeters, for SIZE. `scene`:
    it has the units. `objects`: all that are written.
    """
    if scale == "SIZE":
        return size / max(float(extent(objects).max()), 1e-12)
    if scale == "MILLIMETERS":
        return 1.0
    units = scene.unit_settings
    return _MILLIMETERS * (units.scale_length if units.system != "NONE" else 1.0)
