# SPDX-License-Identifier: GPL-3.0-or-later
"""The kinds of files that results are written to: `TARGETS`, for Send, Bake and the command line.

This imports no bpy, as the command line asks for the formats before Blender starts.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from ...solver.errors import CubicCraftError

if TYPE_CHECKING:
    import bpy


@dataclass(frozen=True)
class Options:
    """What can be chosen."""

    with_modifiers: bool = True
    with_animation: bool = True
    with_groups: bool = True
    scale: float = 1000.0
    """of an STL file: millimeters per unit of Blender"""
    frames: tuple[int, int] = (1, 1)
    """of a file that only holds frames"""
    suffix: str = ""
    """of the file, for a kind with several"""


def exporter(target: str) -> Any:
    """Return the operator of Blender that writes the format of one of `TARGETS`.

    Raises CubicCraftError: this Blender has none.
    """
    import bpy

    module, name = TARGETS[target].operator.split(".")
    operator = getattr(getattr(bpy.ops, module), name)
    try:
        operator.get_rna_type()
    except KeyError as error:
        add_on = TARGETS[target].add_on
        where = f'enable the add-on "{add_on}"' if add_on else "choose another format"
        raise CubicCraftError(f"this Blender cannot write {target} files: {where}") from error
    return operator


def check_exporter(suffix: str) -> None:
    """Raise a CubicCraftError if this Blender cannot write files that end so."""
    target = target_of(suffix)
    if TARGETS[target].operator:
        exporter(target)


def target_of(suffix: str) -> str:
    """Return the one of `TARGETS` whose files end so."""
    return next(key for key, target in TARGETS.items() if suffix.lower() in target.suffixes)


def settings(
    target: str, objects: list[bpy.types.Object], options: Options, *, is_modified: bool
) -> dict[str, Any]:
    """Return the settings of the exporter that are not Blender's own defaults.

    Those that this version does not know are left out.

    `target`: one of `TARGETS`. `objects`: the meshes that are written. `is_modified`: whether
    modifiers are applied.
    """
    make = TARGETS[target].settings
    wanted = make(objects, options, is_modified) if make else {}
    known = exporter(target).get_rna_type().properties
    return {name: value for name, value in wanted.items() if name in known}


def with_suffix(path: str, target: str) -> str:
    """Return a path that ends as the kind of file does."""
    import bpy

    own = TARGETS[target].suffix
    for suffix in (TARGETS[sent].suffix for sent in SENT):
        if path.lower().endswith(suffix) and suffix != own:
            path = path[: -len(suffix)]
    return bpy.path.ensure_ext(path, own) if Path(path).name else path


def _gltf(objects: list[bpy.types.Object], options: Options, is_modified: bool) -> dict[str, Any]:
    return {
        "export_format": "GLB",
        "use_selection": True,
        "export_apply": is_modified,
        "export_attributes": True,
        "export_tangents": any(has_normal_map(obj) for obj in objects),
        "export_animations": options.with_animation,
        "export_current_frame": True,  # the shape and place that are seen
    }


def _fbx(objects: list[bpy.types.Object], options: Options, is_modified: bool) -> dict[str, Any]:
    return {
        "use_selection": True,
        "object_types": {"MESH", "ARMATURE"},
        "apply_scale_options": "FBX_SCALE_ALL",  # a scale of 1 in Unity and in Unreal
        "use_mesh_modifiers": is_modified,
        "use_mesh_modifiers_render": False,  # what is seen in the viewport
        "mesh_smooth_type": "FACE",
        "prioritize_active_color": True,
        "add_leaf_bones": False,
        "bake_anim": options.with_animation,
        "path_mode": "COPY",
        "embed_textures": True,
    }


def _stl(objects: list[bpy.types.Object], options: Options, is_modified: bool) -> dict[str, Any]:
    return {
        "export_selected_objects": True,
        "global_scale": options.scale,
        "apply_modifiers": is_modified,
    }


def _obj(objects: list[bpy.types.Object], options: Options, is_modified: bool) -> dict[str, Any]:
    meshes: Any = objects
    return {
        "export_selected_objects": True,
        "apply_modifiers": is_modified,
        "export_normals": any(obj.data.has_custom_normals for obj in meshes),
        "export_materials": any(slot.material for obj in meshes for slot in obj.material_slots),
        "path_mode": "RELATIVE",
    }


def _ply(objects: list[bpy.types.Object], options: Options, is_modified: bool) -> dict[str, Any]:
    return {
        "export_selected_objects": True,
        "apply_modifiers": is_modified,
        "export_uv": False,  # a .ply knows one UV per vertex: seams would split vertices
    }


def _alembic(
    objects: list[bpy.types.Object], options: Options, is_modified: bool
) -> dict[str, Any]:
    start, end = options.frames
    return {
        "selected": True,
        "start": start,
        "end": end,
        "evaluation_mode": "VIEWPORT",
    }


def _usd(objects: list[bpy.types.Object], options: Options, is_modified: bool) -> dict[str, Any]:
    return {
        "selected_objects_only": True,
        "export_animation": options.with_animation,
        "export_materials": not options.with_animation,
        "evaluation_mode": "VIEWPORT",
        "convert_world_material": False,
        # no folder of textures beside the file; a .usdz has them in it
        **({} if options.suffix == ".usdz" else {"export_textures_mode": "KEEP"}),
    }


def has_normal_map(obj: bpy.types.Object) -> bool:
    """Return whether a material of the object has a normal map, which needs tangents."""
    trees = [slot.material and slot.material.node_tree for slot in obj.material_slots]
    return any(
        node.bl_idname == "ShaderNodeNormalMap"
        for tree in filter(None, trees)
        for node in tree.nodes
    )


@dataclass(frozen=True)
class Target:
    """A kind of file, and what is different about it."""

    name: str
    suffixes: tuple[str, ...]
    operator: str = ""
    """of Blender, which writes it; none for what we write ourselves"""
    settings: Callable[[list[bpy.types.Object], Options, bool], dict[str, Any]] | None = None
    """makes the settings of the operator, of the meshes, and whether modifiers are applied"""
    description: str = ""
    button: str = ""
    """text of its button in the panel, if it has one"""
    icon: str = "NONE"
    add_on: str = ""
    """of Blender, which has the operator"""
    groups: Literal["", "ATTRIBUTES", "COLORS"] = ""
    """as what vertex groups are written"""
    keeps_vertices: bool = True
    """whether vertices come back in their order without being numbered"""
    is_printed: bool = False
    """whether it is a solid of a size in millimeters, and nothing else"""
    is_animated: bool = False
    """whether it can hold the vertices of each frame"""

    @property
    def suffix(self) -> str:
        """What its files usually end in."""
        return self.suffixes[0]

    @property
    def is_for_engines(self) -> bool:
        """Whether it holds all of an object: materials, textures, bones and shape keys."""
        return bool(self.groups)


TARGETS = {
    "GLTF": Target(
        "glTF",
        (".glb",),
        "export_scene.gltf",
        _gltf,
        description="A .glb file for game engines and the web",
        button="Game Engine (glTF)",
        icon="WORLD",
        add_on="glTF 2.0 format",
        groups="ATTRIBUTES",
        keeps_vertices=False,
    ),
    "FBX": Target(
        "FBX",
        (".fbx",),
        "export_scene.fbx",
        _fbx,
        description="An .fbx file for Unity, Unreal, Maya and others",
        button="Unity, Unreal, Maya (FBX)",
        icon="EXPORT",
        add_on="FBX format",
        groups="COLORS",
    ),
    "STL": Target(
        "STL",
        (".stl",),
        "wm.stl_export",
        _stl,
        description="An .stl file for 3D printers, in millimeters",
        button="3D Print (STL)",
        icon="MESH_ICOSPHERE",
        is_printed=True,
    ),
    "OBJ": Target("OBJ", (".obj",), "wm.obj_export", _obj),
    "PLY": Target("PLY", (".ply",), "wm.ply_export", _ply),
    "USD": Target(
        "USD", (".usd", ".usdc", ".usda", ".usdz"), "wm.usd_export", _usd, is_animated=True
    ),
    "ALEMBIC": Target("Alembic", (".abc",), "wm.alembic_export", _alembic, is_animated=True),
    "CACHE": Target("Point Cache", (".pc2",), is_animated=True),
    "BLEND": Target("Blender", (".blend",)),
}
SENT = [key for key, target in TARGETS.items() if target.button]
"""those with a button in the panel"""
ITEMS = tuple((key, TARGETS[key].name, TARGETS[key].description) for key in SENT)
