# SPDX-License-Identifier: GPL-3.0-or-later
"""A low-poly version of a cubic mesh, with a normal map that has the details of the cubic one."""

from __future__ import annotations

import contextlib
import itertools
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from ...solver import CubicCraftError
from ...solver.pieces.placement import Placement
from .. import hidden_source, mesh_bridge
from ..environment.file_names import file_stem
from ..measure.facets import settings_of_run
from ..read.object_frame import placement_alone
from . import low_poly
from .bake import Studio, bake_normals, check_cycles, studio
from .few_polygons import few_polygons
from .properties import MapOptions
from .split import OldSurface


class MapMaterials:
    """The materials of a low-poly mesh, with the image as a node that is not connected yet.

    Baking needs the node, and must not find it connected: the map would depend on itself.
    """

    def __init__(self, mesh: bpy.types.Mesh, image: bpy.types.Image):
        self._mesh = mesh
        self._image = image
        self._made: list[bpy.types.Material] = []
        self._nodes: list[tuple[bpy.types.Material, Any]] = []

    def add(self, name: str) -> None:
        """Put copies on the mesh, and one of this name where there is no material."""
        slots: Any = self._mesh.materials
        if not slots:
            slots.append(None)
        copies: dict[Any, bpy.types.Material] = {}
        for number, source in enumerate(list(slots)):
            if source not in copies:
                copies[source] = self._add(source, name)
            slots[number] = copies[source]

    def connect(self, uv_map: str, *, is_rendered: bool) -> list[str]:
        """Let all shaders use the map; return the materials without a shader that could.

        `is_rendered`: whether it is the UV map that textures use when they name none.
        """
        plain = []
        for material, texture in self._nodes:
            tree: Any = material.node_tree
            shaders = [
                node
                for node in tree.nodes
                if node.bl_idname.startswith("ShaderNodeBsdf") and "Normal" in node.inputs
            ]
            if not shaders:
                plain.append(material.name)
                continue
            x, y = shaders[0].location
            texture.location = x - 560, y - 400
            normal = tree.nodes.new("ShaderNodeNormalMap")
            normal.location = x - 220, y - 400
            normal.uv_map = uv_map
            tree.links.new(texture.outputs["Color"], normal.inputs["Color"])
            for shader in shaders:
                tree.links.new(normal.outputs["Normal"], shader.inputs["Normal"])
            if not is_rendered:
                places = tree.nodes.new("ShaderNodeUVMap")
                places.location = x - 780, y - 400
                places.uv_map = uv_map
                tree.links.new(places.outputs["UV"], texture.inputs["Vector"])
        return plain

    def remove(self) -> None:
        """Remove them."""
        for material in self._made:
            bpy.data.materials.remove(material)

    def _add(self, source: bpy.types.Material | None, name: str) -> bpy.types.Material:
        material: Any = bpy.data.materials.new(name) if source is None else source.copy()
        self._made.append(material)
        if source is not None:
            material.name = f"{source.name} Low"
        if bpy.app.version < (5, 0):  # later, all materials use nodes
            material.use_nodes = True
        texture = material.node_tree.nodes.new("ShaderNodeTexImage")
        texture.image = self._image
        for node in material.node_tree.nodes:
            node.select = node == texture
        material.node_tree.nodes.active = texture
        self._nodes.append((material, texture))
        return material


@dataclass(frozen=True)
class NormalMap:
    """A low-poly object and its normal map."""

    object: bpy.types.Object
    image: bpy.types.Image
    apart: float
    """largest distance between the surfaces, in the world"""
    problems: list[str]
    """what the artist should know"""


def make_normal_map(obj: bpy.types.Object, options: MapOptions) -> NormalMap:
    """Make a low-poly version of a result beside it, and bake what it lacks to an image.

    The result is not changed, but hidden: the new object lies at the same place.

    `obj`: an object with a result, in Object Mode. Raises CubicCraftError: there is no result or no
    Cycles, or something else is missing. After any exception, nothing is left.
    """
    with contextlib.ExitStack() as undo:
        made = _make(undo, obj, _placement(obj), options)
        made.problems.extend(_keep(made.image))
        _show_instead(undo, obj, made.object)
        undo.pop_all()
    return made


@contextlib.contextmanager
def passing_normal_map(
    obj: bpy.types.Object, placement: Placement, options: MapOptions
) -> Iterator[NormalMap]:
    """Give what `make_normal_map` makes during the block, with its image packed; nothing is hidden.

    `placement`: in which its shape was solved. Raises CubicCraftError: as `make_normal_map`.
    """
    with contextlib.ExitStack() as undo:
        made = _make(undo, obj, placement, options)
        made.image.pack()
        mesh_bridge.link_beside(obj, made.object)
        yield made


def _placement(obj: bpy.types.Object) -> Placement | None:
    """Return where the sides of a result face, None if what they faced is not there anymore."""
    run = mesh_bridge.last_run(obj)
    if run is None:
        raise CubicCraftError(f'"{obj.name}" has no result to bake: cubify it first')
    try:
        return placement_alone(obj, settings_of_run(obj, run))
    except CubicCraftError:
        return None


def _make(
    undo: contextlib.ExitStack,
    obj: bpy.types.Object,
    placement: Placement | None,
    options: MapOptions,
) -> NormalMap:
    """Make all that stays, but for its place in the scene; `undo` removes it again."""
    check_cycles()
    mesh_bridge.check_usable(obj)
    mesh_bridge.end_preview(mesh_bridge.mesh_of(obj))
    present = mesh_bridge.result_positions(obj)
    with studio() as stage, contextlib.ExitStack() as passing:
        high_mesh = _mesh_of_result(stage, obj, present)
        passing.callback(bpy.data.meshes.remove, high_mesh)
        high = passing.enter_context(_stand_in(stage, obj, high_mesh))
        seen = mesh_bridge.read_positions(high_mesh)
        triangles = mesh_bridge.triangles(high_mesh, seen)
        offsets = mesh_bridge.key_offsets(mesh_bridge.mesh_of(obj))
        keys = _keys_as_seen(stage, obj, present, offsets, seen)
        surface = OldSurface(seen, triangles, keys)
        low_mesh = _low_mesh(stage, obj, present, placement, options.triangles, surface)
        undo.callback(bpy.data.meshes.remove, low_mesh)
        low = passing.enter_context(_stand_in(stage, obj, low_mesh))
        rendered = next((layer.name for layer in low_mesh.uv_layers if layer.active_render), "")
        uv_map = low_poly.choose_uv(stage, low, options.resolution, obj.name)
        low_poly.set_hard_edges(low_mesh, uv_map)
        image = bpy.data.images.new(
            f"{obj.name} Normal", options.resolution, options.resolution, is_data=True
        )
        undo.callback(bpy.data.images.remove, image)
        materials = MapMaterials(low_mesh, image)
        undo.callback(materials.remove)
        materials.add(f"{obj.name} Low")
        baked_mesh = _with_only(low_mesh, uv_map)
        passing.callback(bpy.data.meshes.remove, baked_mesh)
        baked = passing.enter_context(_stand_in(stage, obj, baked_mesh))
        apart = bake_normals(stage, high, baked, image)
        plain = materials.connect(uv_map, is_rendered=rendered in ("", uv_map))
        problems = [f'material "{name}" has no shader that takes a normal map' for name in plain]
        missing = offsets.keys() - keys
        problems += [f'shape key "{name}" gives its modifiers other vertices' for name in missing]
    new = obj.copy()
    assert new is not None
    undo.callback(bpy.data.objects.remove, new)
    _pose(new, low_mesh, f"{obj.name} Low")
    mesh_bridge.transfer_keys(mesh_bridge.mesh_of(obj), new, seen, triangles, keys)
    return NormalMap(new, image, apart, problems)


def _mesh_of_result(
    stage: Studio, obj: bpy.types.Object, positions: np.ndarray, *, has_own_normals: bool = True
) -> bpy.types.Mesh:
    """Return a new mesh: the result with its modifiers, but not posed."""
    copy = stage.take(mesh_bridge.plain_copy(obj, positions))
    try:
        _remove_modifiers(copy, are_armatures=True)
        if not has_own_normals:
            low_poly.forget_normals(stage, copy)
        return stage.evaluated_mesh(copy)
    finally:
        mesh_bridge.remove_copy(copy)


def _keys_as_seen(
    stage: Studio,
    obj: bpy.types.Object,
    present: np.ndarray,
    offsets: dict[str, np.ndarray],
    seen: np.ndarray,
) -> dict[str, np.ndarray]:
    """Return the offsets of shape keys from the result with its modifiers, seen (n,3).

    One with which they make another number of vertices, as a weld may, is left out.
    """
    found = {}
    for name, moved in offsets.items():
        mesh = _mesh_of_result(stage, obj, present + moved)
        positions = mesh_bridge.read_positions(mesh)
        bpy.data.meshes.remove(mesh)
        if len(positions) == len(seen):
            found[name] = positions - seen
    return found


def _low_mesh(
    stage: Studio,
    obj: bpy.types.Object,
    positions: np.ndarray,
    placement: Placement | None,
    triangles: int,
    surface: OldSurface,
) -> bpy.types.Mesh:
    """Return a new mesh: the result with its modifiers, not posed, in few triangles.

    `surface`: the result with its modifiers, and its shape keys.
    """
    present = _mesh_of_result(stage, obj, positions, has_own_normals=False)
    try:
        if placement is not None:
            few_polygons(present, placement, triangles)
        with _stand_in(stage, obj, present) as reduced:
            mesh = low_poly.decimated(stage, reduced, triangles, surface)
    finally:
        bpy.data.meshes.remove(present)
    mesh.name = f"{obj.name} Low"
    return mesh


@contextlib.contextmanager
def _stand_in(
    stage: Studio, obj: bpy.types.Object, mesh: bpy.types.Mesh
) -> Iterator[bpy.types.Object]:
    """Show a mesh in the studio where an object is in the scene."""
    new = bpy.data.objects.new(obj.name, mesh)
    try:
        stage.take(new)
        new.matrix_world = obj.matrix_world
        stage.view_layer.update()
        yield new
    finally:
        bpy.data.objects.remove(new)


def _pose(new: bpy.types.Object, mesh: bpy.types.Mesh, name: str) -> None:
    """Give a copy of an object another mesh, which has all its modifiers but armatures."""
    new.data = mesh
    new.name = name
    for slot in new.material_slots:
        slot.link = "DATA"
    _remove_modifiers(new, are_armatures=False)


def _remove_modifiers(obj: bpy.types.Object, *, are_armatures: bool) -> None:
    for modifier in list(obj.modifiers):
        if (modifier.type == "ARMATURE") == are_armatures:
            obj.modifiers.remove(modifier)


def _with_only(mesh: bpy.types.Mesh, uv_map: str) -> bpy.types.Mesh:
    """Return a copy of a mesh with one UV map, so that there is no question which is baked to."""
    copy = mesh.copy()
    assert copy is not None
    for name in [layer.name for layer in copy.uv_layers if layer.name != uv_map]:
        copy.uv_layers.remove(copy.uv_layers[name])
    return copy


def _keep(image: bpy.types.Image) -> list[str]:
    """Save an image beside the .blend file, or in it; return what went wrong.

    No file is ever replaced: it may be one of the artist's.
    """
    if not bpy.data.filepath:
        image.pack()
        return []
    stem = file_stem(image.name)
    folder = Path(bpy.path.abspath("//"))
    names = itertools.chain([f"{stem}.png"], (f"{stem}_{n}.png" for n in itertools.count(2)))
    path = next(folder / name for name in names if not (folder / name).exists())
    image.file_format = "PNG"
    image.filepath_raw = str(path)
    try:
        image.save()
    except RuntimeError:
        image.filepath_raw = ""
        path.unlink(missing_ok=True)
        image.pack()
        return [f'"{path.name}" could not be written, so the image is packed into the .blend file']
    image.filepath_raw = f"//{path.name}"
    image.source = "FILE"
    return []


def _show_instead(undo: contextlib.ExitStack, obj: bpy.types.Object, new: bpy.types.Object) -> None:
    """Show the new object, selected and active, in place of the old one."""
    view_layer = bpy.context.view_layer
    undo.callback(setattr, view_layer.objects, "active", view_layer.objects.active)
    undo.callback(hidden_source.as_it_was(obj))
    mesh_bridge.link_beside(obj, new)
    mesh_bridge.select_instead(obj, new)
    hidden_source.hide(obj, new)
