# SPDX-License-Identifier: GPL-3.0-or-later
"""Write the materials of a result beside its .obj, as no file that was read has them for it."""

import os
from pathlib import Path
from typing import Any

import bpy
from bpy_extras.node_shader_utils import PrincipledBSDFWrapper

from ....solver.console.temporary import replacing
from ..reading.obj_copy import in_file

SUFFIXES = {"JPEG": ".jpg", "TARGA": ".tga", "OPEN_EXR": ".exr", "TIFF": ".tif"}
"""of packed images; of others .png"""
TEXTURES = {
    "map_Kd": "base_color_texture",
    "map_Ns": "roughness_texture",
    "map_d": "alpha_texture",
    "map_Ke": "emission_color_texture",
    "norm": "normalmap_texture",
}
"""keyword: as Blender's wrapper of materials has it"""


def write_mtl(path: Path, meshes: list[bpy.types.Mesh]) -> list[str]:
    """Write the materials of meshes; return the name of the file, if they have some.

    Images that are files are named as they lie, packed ones are written beside.

    `path`: of the .obj. Raises InputError: the file cannot be written.
    """
    materials = {m.name: m for mesh in meshes for m in mesh.materials if m}
    if not materials:
        return []
    lines = [line for each in materials.values() for line in _lines(each, path)]
    library = path.with_suffix(".mtl")
    with replacing(library) as temporary:
        text = "\n".join(lines) + "\n"
        temporary.write_text(text, encoding="utf-8", errors="surrogateescape")
    return [library.name]


def relative(target: Path, folder: Path) -> str:
    """Path of the target as seen from the folder, with forward slashes."""
    try:
        return Path(os.path.relpath(target.resolve(), folder.resolve())).as_posix()
    except ValueError:  # on another drive
        return target.resolve().as_posix()


def _lines(material: bpy.types.Material, path: Path) -> list[str]:
    wrapper: Any = PrincipledBSDFWrapper
    shader = wrapper(material, is_readonly=True)
    color = " ".join(f"{value:.6g}" for value in shader.base_color[:3])
    lines = [f"newmtl {in_file(material.name, 'utf-8')}", f"Kd {color}", f"d {shader.alpha:.6g}"]
    for keyword, name in TEXTURES.items():
        texture = getattr(shader, name, None)
        if texture is not None and texture.image is not None:
            place = _place(texture.image, path)
            lines += [f"{keyword} {place}"] * bool(place)
    return lines


def _place(image: bpy.types.Image, path: Path) -> str:
    """Return where an image is as seen from the result; a packed one is written beside it."""
    if image.packed_file is not None:
        suffix = SUFFIXES.get(image.file_format, ".png")
        name = bpy.path.clean_name(Path(image.name).stem)
        own = path.with_name(f"{path.stem}_{name}{suffix}")
        with replacing(own) as temporary:
            temporary.write_bytes(image.packed_file.data)
        return own.name
    file = Path(bpy.path.abspath(image.filepath))
    return relative(file, path.parent) if image.filepath and file.is_file() else ""
