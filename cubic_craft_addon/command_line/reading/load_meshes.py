# SPDX-License-Identifier: GPL-3.0-or-later
"""Bring a file's mesh objects into an otherwise empty Blender."""

import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from ....solver.console.output import InputError
from ....solver.console.sources import check_content
from ...mesh_bridge import read_position
from ..process.quiet import captured
from .finite_check import refuse_infinite
from .obj_layout import ObjLayout, match_objects, read_layout
from .seen_objects import is_in_picture, show_as_meshes
from .trial import refuse_crashing
from .weld import weld

LEVELS_OF_MONKEY = 2
IMPORTERS = {
    ".obj": "wm.obj_import",
    ".blend": "wm.open_mainfile",
    ".ply": "wm.ply_import",
    ".stl": "wm.stl_import",
    ".abc": "wm.alembic_import",
    ".fbx": "wm.fbx_import",
    **dict.fromkeys((".glb", ".gltf"), "import_scene.gltf"),
    **dict.fromkeys((".usd", ".usdc", ".usda", ".usdz"), "wm.usd_import"),
}
FAR = 1000.0
"""times its largest extent: there 32 bits round to 6e-5 of the extent"""


def operator(name: str, path: Path) -> Callable[..., Any]:
    """Return an operator by its name, such as "wm.obj_import".

    Raises InputError: this Blender does not have it; ``path`` is the file that it was meant for.
    """
    group, _, verb = name.partition(".")
    if verb not in dir(getattr(bpy.ops, group)):
        message = f"{path}: this Blender was built without support for {path.suffix} files"
        raise InputError(f"{message}; choose another format")
    return getattr(getattr(bpy.ops, group), verb)


def reason(error: RuntimeError) -> str:
    """Return the first line of what an operator reported when it failed.

    Of an exception in an operator that is written in Python, it is the exception itself.
    """
    lines = str(error).strip().splitlines() or ["no reason given"]
    if "Traceback (most recent call last)" in lines[0]:
        own = [line for line in lines[1:] if not line.startswith((" ", "Location:"))]
        return own[-1].rstrip(". ") if own else "an exception in Blender"
    return lines[0].removeprefix("Error: ").rstrip(". ")


@dataclass
class Loaded:
    """The mesh objects to work on."""

    objects: list[bpy.types.Object]
    obj_layout: ObjLayout | None = None
    """the vertices of the file, if it was an .obj"""
    is_whole: bool = True
    """not just one object that was named"""
    form: bpy.types.Object | None = None
    """what the form is made from"""
    covered: list[str] = field(default_factory=list)
    """names of objects of which what is seen was taken, as nothing else would be"""


def empty_blender() -> None:
    """Open a new file with nothing in it; preferences and add-ons stay, also ours."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)


def load(
    path: Path | None, name: str | None, *, is_seen: bool = False, is_all_seen: bool = True
) -> Loaded:
    """Load the mesh objects of a file, or the subdivided monkey.

    `path`: the file, or None for the monkey. `name`: only the object of this name. `is_seen`: take
    what is seen in place of the meshes of the file. `is_all_seen`: not only of those meshes whose
    modifiers hide what they are. Returns at least one object, each with faces, in the order of the
    file. Raises InputError: the file cannot be read, or holds no such object.
    """
    if path is None:
        return Loaded(_choose([_monkey()], name, "Blender's monkey"))
    check_content(path)
    layout = read_layout(path) if path.suffix.lower() == ".obj" else None
    if path.suffix.lower() in (".ply", ".stl"):
        refuse_infinite(path)
    refuse_crashing(path, _importer(path))
    with captured():
        _import(path, layout)
        bpy.context.view_layer.update()
    covered = []
    if is_seen:
        taken = show_as_meshes(only_covered=not is_all_seen)
        covered = [] if is_all_seen else taken
    found = [obj for obj in bpy.context.scene.objects if obj.type == "MESH"]
    warn_if_rounded(path, found)
    if layout is not None:
        found = match_objects(layout, found)
    if path.suffix.lower() in (".glb", ".gltf"):
        for mesh in {obj.data for obj in found}:
            weld(mesh)
    chosen = _choose(found, name, str(path))
    covered = [obj.name for obj in chosen if obj.name in covered]
    return Loaded(chosen, layout, is_whole=name is None, covered=covered)


def _monkey() -> bpy.types.Object:
    bpy.ops.mesh.primitive_monkey_add()
    monkey = bpy.context.object
    modifier = monkey.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = LEVELS_OF_MONKEY
    bpy.ops.object.modifier_apply(modifier=modifier.name)
    bpy.ops.object.shade_smooth()
    return monkey


def _importer(path: Path) -> str:
    suffix = path.suffix.lower()
    if suffix == ".fbx" and "fbx_import" not in dir(bpy.ops.wm):  # before Blender 4.5
        return "import_scene.fbx"
    return IMPORTERS[suffix]


def _import(path: Path, layout: ObjLayout | None) -> None:
    how = {}
    if layout is not None:
        how = {"use_split_objects": layout.is_split, "import_vertex_groups": True}
    elif path.suffix.lower() == ".blend":
        how = {"load_ui": False, "use_scripts": False}  # nothing in a file runs
    try:
        result = operator(_importer(path), path)(filepath=str(path.resolve()), **how)
    except RuntimeError as error:
        message = f"{path}: cannot be read ({reason(error)}); export it again"
        raise InputError(message) from error
    if "FINISHED" not in result:
        raise InputError(f"{path}: cannot be read (not a {path.suffix} file); export it again")


def _choose(found: list[bpy.types.Object], name: str | None, source: str) -> list[bpy.types.Object]:
    """Take the object of that name, or all that can be cubified."""
    if name is not None:
        chosen = [obj for obj in found if obj.name == name]
        if not chosen:
            there = ", ".join(f'"{obj.name}"' for obj in found[:8]) or "no mesh object at all"
            raise InputError(f"--object {name}: {source} has no such mesh object; it has {there}")
        return chosen
    chosen = [obj for obj in found if obj.data.polygons and is_in_picture(obj)]
    if not chosen:
        what = "only meshes that are hidden, are not rendered or have no faces"
        if not any(obj.data.polygons for obj in found):
            what = "only meshes without faces" if found else "no mesh"
        raise InputError(f"{source}: holds {what}; export it again with a visible mesh with faces")
    for obj in found:
        if obj not in chosen:
            print(
                f'"{obj.name}" is left out: it is hidden, is not rendered or has no faces',
                file=sys.stderr,
            )
    return chosen


def warn_if_rounded(path: Path, objects: list[bpy.types.Object]) -> None:
    """Say that meshes are so far from their origins that their shapes were rounded to 32 bits."""
    boxes = [(p.min(axis=0), p.max(axis=0)) for o in objects if len(p := read_position(o.data))]
    extent = max((float((high - low).max()) for low, high in boxes), default=0.0)
    away = max((float(np.abs(low + high).max()) / 2 for low, high in boxes), default=0.0)
    if away > FAR * extent > 0.0:
        print(
            f"{path}: lies {away:.3g} from its origin, where Blender rounds coordinates to "
            f"{np.spacing(np.float32(away)):.2g}; move it to the origin",
            file=sys.stderr,
        )
