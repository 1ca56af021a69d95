# SPDX-License-Identifier: GPL-3.0-or-later
"""Where results are sent to: `TARGETS` has the exporter of Blender for each, and its settings."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import bpy

from ...solver import CubicCraftError


@dataclass(frozen=True)
class Options:
    """What can be chosen."""

    with_modifiers: bool = True
    with_animation: bool = True
    with_groups: bool = True
    scale: float = 1000.0
    """of an STL file: millimeters per unit of Blender"""


def exporter(target: str) -> Any:
    """Return the operator of Blender that writes the format of one of `TARGETS`.

    Raises
    ------
    CubicCraftError
        This Blender has none.
    """
    module, name = TARGETS[target].operator.split(".")
    operator = getattr(getattr(bpy.ops, module), name)
    try:
        operator.get_rna_type()
    except KeyError as error:
        add_on = TARGETS[target].add_on
        where = f'enable the add-on "{add_on}"' if add_on else "update it"
        raise CubicCraftError(f"this Blender cannot write {target} files: {where}") from error
    return operator


def settings(
    target: str, objects: list[bpy.types.Object], options: Options, *, is_modified: bool
) -> dict[str, Any]:
    """Return the settings of the exporter; those that this version does not know are left out.

    Parameters
    ----------
    target : one of `TARGETS`
    objects : list of bpy.types.Object
        The meshes that are written.
    options : Options
    is_modified : bool
        Whether modifiers are applied.
    """
    wanted = TARGETS[target].settings(objects, options, is_modified)
    known = exporter(target).get_rna_type().properties
    return {name: value for name, value in wanted.items() if name in known}


def with_suffix(path: str, target: str) -> str:
    """Return a path that ends as the kind of file does."""
    own = TARGETS[target].suffix
    for suffix in (other.suffix for other in TARGETS.values()):
        if path.lower().endswith(suffix) and suffix != own:
            path = path[: -len(suffix)]
    return bpy.path.ensure_ext(path, own) if Path(path).name else path


def _gltf(objects: list[bpy.types.Object], options: Options, is_modified: bool) -> dict[str, Any]:
    return {
        "export_format": "GLB",
        "use_selection": True,
        "export_yup": True,
        "export_apply": is_modified,
        "export_attributes": True,
        "export_texcoords": True,
        "export_normals": True,
        "export_tangents": any(has_normal_map(obj) for obj in objects),
        "export_materials": "EXPORT",
        "export_skins": True,
        "export_morph": True,
        "export_morph_normal": True,
        "export_animations": options.with_animation,
        "export_current_frame": True,  # the shape and place that are seen
        "export_extras": False,
        "export_cameras": False,
        "export_lights": False,
        "will_save_settings": False,
    }


def _fbx(objects: list[bpy.types.Object], options: Options, is_modified: bool) -> dict[str, Any]:
    return {
        "use_selection": True,
        "object_types": {"MESH", "ARMATURE"},
        "axis_forward": "-Z",
        "axis_up": "Y",
        "apply_unit_scale": True,
        "apply_scale_options": "FBX_SCALE_ALL",  # a scale of 1 in Unity and in Unreal
        "use_mesh_modifiers": is_modified,
        "use_mesh_modifiers_render": False,  # what is seen in the viewport
        "mesh_smooth_type": "FACE",
        "use_triangles": False,  # the faces of the artist
        "colors_type": "SRGB",
        "prioritize_active_color": True,
        "use_custom_props": False,
        "add_leaf_bones": False,
        "use_armature_deform_only": False,
        "bake_anim": options.with_animation,
        "path_mode": "COPY",
        "embed_textures": True,
    }


def _stl(objects: list[bpy.types.Object], options: Options, is_modified: bool) -> dict[str, Any]:
    return {
        "export_selected_objects": True,
        "ascii_format": False,
        "global_scale": options.scale,
        "use_scene_unit": False,  # is part of the scale
        "forward_axis": "Y",
        "up_axis": "Z",
        "apply_modifiers": is_modified,
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
    description: str
    button: str
    """text of its button in the panel"""
    icon: str
    suffix: str
    operator: str
    """of Blender, which writes it"""
    settings: Callable[[list[bpy.types.Object], Options, bool], dict[str, Any]]
    """makes the settings of the operator, of the meshes, and whether modifiers are applied"""
    add_on: str = ""
    """of Blender, which has the operator"""
    groups: Literal["", "ATTRIBUTES", "COLORS"] = ""
    """as what vertex groups are written"""
    keeps_vertices: bool = True
    """whether vertices come back in their order without being numbered"""
    is_printed: bool = False
    """whether it is a solid of a size in millimeters, and nothing else"""


TARGETS = {
    "GLTF": Target(
        "glTF",
        "A .glb file for game engines and the web",
        button="Game Engine (glTF)",
        icon="WORLD",
        suffix=".glb",
        operator="export_scene.gltf",
        settings=_gltf,
        add_on="glTF 2.0 format",
        groups="ATTRIBUTES",
        keeps_vertices=False,
    ),
    "FBX": Target(
        "FBX",
        "A .fbx file for Unity, Unreal, Maya and others",
        button="Unity, Unreal, Maya (FBX)",
        icon="EXPORT",
        suffix=".fbx",
        operator="export_scene.fbx",
        settings=_fbx,
        add_on="FBX format",
        groups="COLORS",
    ),
    "STL": Target(
        "STL",
        "A .stl file for 3D printers, in millimeters",
        button="3D Print (STL)",
        icon="MESH_ICOSPHERE",
        suffix=".stl",
        operator="wm.stl_export",
        settings=_stl,
        is_printed=True,
    ),
}
ITEMS = tuple((key, target.name, target.description) for key, target in TARGETS.items())
