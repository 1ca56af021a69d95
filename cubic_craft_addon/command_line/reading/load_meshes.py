# SPDX-License-Identifier: GPL-3.0-or-later
"""Bring a file's mesh objects into an otherwise empty Blender."""

import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import bmesh
import bpy
import numpy as np

from ....solver.console.output import InputError
from ...mesh_bridge import read_position, read_values
from ..process.quiet import captured
from .finite_check import refuse_infinite
from .obj_layout import ObjLayout, match_objects, read_layout
from .seen_objects import is_in_picture, show_as_meshes


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
    capture: bpy.types.Object | None = None
    """what the normal capture is made from"""
    covered: list[str] = field(default_factory=list)
    """names of objects of which what is seen was taken, as nothing else would be"""


def empty_blender() -> None:
    """Open a new file with nothing in it; preferences and add-ons stay, also ours."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)


def load(
    path: Path | None,
    name: str | None,
    verbose: bool,
    *,
    is_seen: bool = False,
    is_all_seen: bool = True,
) -> Loaded:
    """Load the mesh objects of a file, or the subdivided monkey.

    Parameters
    ----------
    path : the file, or None for the monkey
    name : only the object of this name
    verbose : show what Blender prints
    is_seen : take what is seen in place of the meshes of the file
    is_all_seen : not only of those meshes whose modifiers hide what they are

    Returns
    -------
    Loaded
        At least one object, each with faces, in the order of the file.

    Raises
    ------
    InputError
        The file cannot be read, or holds no such object.
    """
    if path is None:
        return Loaded(_choose([_monkey()], name, "Blender's monkey"))
    layout = read_layout(path) if path.suffix.lower() == ".obj" else None
    if path.suffix.lower() in (".ply", ".stl"):
        refuse_infinite(path)
    with captured(verbose):
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


FAR = 1000.0
"""times its largest extent: there 32 bits round to 6e-5 of the extent"""


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


def weld(mesh: bpy.types.Mesh) -> None:
    """Join vertices with bit-identical coordinates; UVs and normals of the faces stay.

    glTF keeps one normal and one UV per vertex, so every sharp edge and every seam is cut open in
    the file, and would fall apart. The importer's own merging looks at normals, too.
    """
    positions = read_position(mesh) + np.float32(0.0)  # no -0.0, which has other bits
    keys = np.ascontiguousarray(positions).view("V12").ravel()
    _, first, place = np.unique(keys, return_index=True, return_inverse=True)
    if len(first) == len(positions):
        return
    normals = read_values(mesh.corner_normals, "vector", width=3)
    edited = bmesh.new()
    try:
        edited.from_mesh(mesh)
        edited.verts.ensure_lookup_table()
        targets = first[place.ravel()].tolist()
        bmesh.ops.weld_verts(
            edited,
            targetmap={
                edited.verts[number]: edited.verts[target]
                for number, target in enumerate(targets)
                if number != target
            },
        )
        edited.to_mesh(mesh)
    finally:
        edited.free()
    if len(mesh.loops) == len(normals):  # no face has collapsed
        mesh.normals_split_custom_set(normals.tolist())


class FormMesh(NamedTuple):
    """All meshes of a file as one, in the axes of the scene, about its origin."""

    points: np.ndarray
    """(n,3)"""
    triangles: np.ndarray
    """(m,3) int"""


def read_form(path: Path, verbose: bool) -> FormMesh:
    """Read the meshes of a file; Blender is empty afterwards.

    Raises InputError: the file cannot be read, or holds no mesh.
    """
    points, triangles, count = [], [], 0
    for obj in load(path, None, verbose).objects:
        mesh = obj.data
        mesh.calc_loop_triangles()
        matrix = np.array(obj.matrix_world)
        own = read_values(mesh.vertices, "co", width=3).astype(np.float64)
        points.append(own @ matrix[:3, :3].T + matrix[:3, 3])
        corners = read_values(mesh.loop_triangles, "vertices", np.int32, width=3)
        triangles.append(corners[:, ::-1] if np.linalg.det(matrix[:3, :3]) < 0 else corners)
        triangles[-1] = triangles[-1] + count
        count += len(own)
    empty_blender()
    return FormMesh(np.concatenate(points), np.concatenate(triangles))


def make_form(form: FormMesh, name: str = "Form") -> bpy.types.Object:
    """Make an object that is in no scene, so that nothing of it is written."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(form.points.tolist(), [], form.triangles.tolist())
    return bpy.data.objects.new(name, mesh)
