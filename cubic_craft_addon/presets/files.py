# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets: those that are included, and those of the artist as files.

A file has Python assignments like Blender's own presets, which are never executed.
"""

from __future__ import annotations

import ast
import math
import os
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import bpy

from ...solver import CubicCraftError
from ...solver.console.sources import folded
from ...solver.method import LOOK
from ..object_properties import PROPERTY
from .included import INCLUDED

PICTURES = Path(__file__).parents[1] / "assets" / "presets"
"""of the included ones"""
_SUBFOLDER = "cubic_craft"
_PREFIX = "bpy.context.object.cubic_craft."
_FORBIDDEN = str.maketrans({char: "_" for char in " !@#$%^&*(){}:\";'[]<>,.\\/?|`~=+\n\t"})


@dataclass(frozen=True)
class Preset:
    """A look with a name."""

    identifier: str
    """the name of the file without its suffix"""
    description: str
    values: Mapping[str, Any]
    """the values of the `LOOK` that it sets"""
    path: Path | None = None
    """None for those that are included with the extension"""

    @property
    def name(self):
        """The display name."""
        return bpy.path.display_name(self.identifier, title_case=False)

    @property
    def is_included(self):
        """Whether it is included with the extension."""
        return self.path is None

    @property
    def picture(self):
        """The path of its picture, which may not exist."""
        return (self.path or PICTURES / self.identifier).with_suffix(".png")

    def is_of(self, properties: Any) -> bool:
        """Return whether the properties have its values."""
        return all(_is_like(getattr(properties, name), v) for name, v in self.values.items())


def presets() -> list[Preset]:
    """Return all presets: included ones, then those of the artist, each from its first file."""
    return _presets_of(tuple(map(_stamp_of, bpy.utils.preset_paths(_SUBFOLDER))))


@lru_cache(maxsize=1)
def _presets_of(stamp: tuple) -> list[Preset]:
    found = {name: Preset(name, *look) for name, look in INCLUDED.items()}
    paths = (Path(path) for files in stamp for path, *_ in files)
    for path in sorted(paths, key=lambda path: path.stem.lower()):
        preset = _read(path)
        if preset is not None:
            found.setdefault(preset.identifier, preset)
    return list(found.values())


def find(identifier: str) -> Preset:
    """Return a preset by its identifier or its name.

    Raises CubicCraftError: there is none.
    """
    for preset in presets():
        if identifier in (preset.identifier, preset.name):
            return preset
    raise CubicCraftError(f'there is no preset "{identifier}"')


def save(name: str, properties: Any) -> Path:
    """Save settings under a name, and replace the preset of that name, if any.

    Raises CubicCraftError: the name is invalid, or gives the file of another one, or that cannot be
    written.
    """
    stem = name.strip().translate(_FORBIDDEN).strip("_")
    if not stem:
        raise CubicCraftError("a preset needs a name")
    taken = {preset.identifier.lower() for preset in presets() if preset.is_included}
    if stem.lower() in {*taken, "custom"}:  # which is shown where no preset fits
        raise CubicCraftError(f'"{name}" is included with CubicCraft; choose another name')
    shown = name.strip().replace("_", " ")
    for preset in presets():
        if folded(preset.identifier) == folded(stem) and preset.name != shown:
            raise CubicCraftError(f'"{name}" would replace "{preset.name}"; choose another name')
    lines = [f"{_PREFIX}{name} = {_plain(getattr(properties, name))!r}\n" for name in LOOK]
    folder = bpy.utils.user_resource("SCRIPTS", path=f"presets/{_SUBFOLDER}", create=True)
    path = Path(folder) / f"{stem}.py"
    try:
        path.write_text("".join(["import bpy\n\n", *lines]), encoding="utf-8")
    except OSError as error:
        raise CubicCraftError(f"{path} cannot be written: {error.strerror}") from error
    _presets_of.cache_clear()  # the clock of the file may not have gone on
    return path


def remove(preset: Preset) -> None:
    """Delete the file of a preset, and its picture.

    Raises CubicCraftError: it is an included preset, or cannot be deleted.
    """
    if preset.path is None:
        raise CubicCraftError(f'"{preset.name}" is included with CubicCraft and cannot be removed')
    try:
        preset.path.unlink()
        preset.picture.unlink(missing_ok=True)
    except OSError as error:
        raise CubicCraftError(f"{preset.path} cannot be deleted: {error.strerror}") from error
    finally:
        _presets_of.cache_clear()


def _stamp_of(folder):
    """Return the files of a folder, and what changes where one is edited in place."""
    with os.scandir(folder) as entries:
        files = [(e.path, e.stat()) for e in entries if e.name.endswith(".py") and e.is_file()]
    return tuple((path, about.st_mtime_ns, about.st_size) for path, about in files)


def _read(path):
    """Return the preset of a file, None if it has no known setting."""
    try:
        tree = ast.parse(path.read_text(encoding="utf-8"))
    except (OSError, SyntaxError, ValueError):
        return None
    values: dict[str, Any] = dict(_assignments(tree))
    description = (ast.get_docstring(tree) or "").rstrip(".")  # Blender sets one
    return Preset(path.stem, description, values, path) if values else None


def _assignments(tree):
    """Yield the names and values that can be set; a newer CubicCraft may have written others."""
    declaration: Any = bpy.types.Object.bl_rna.properties[PROPERTY]
    group = declaration.fixed_type
    for node in tree.body:
        if not isinstance(node, ast.Assign) or not isinstance(node.value, ast.Constant):
            continue
        name, value = ast.unparse(node.targets[0]).removeprefix(_PREFIX), node.value.value
        if name in LOOK and _can_be(group.properties[name], value):
            yield name, value


def _can_be(declaration, value):
    if declaration.type == "ENUM":
        return isinstance(value, str) and value in declaration.enum_items
    if declaration.type == "BOOLEAN" or isinstance(value, bool):
        return declaration.type == "BOOLEAN" and isinstance(value, bool)
    is_number = isinstance(value, int | float) and math.isfinite(value)
    return is_number and declaration.hard_min <= value <= declaration.hard_max


def _plain(value):
    """Return a value without meaningless digits: properties are 32-bit numbers."""
    return float(f"{value:.7g}") if isinstance(value, float) else value


def _is_like(value, other):
    if isinstance(value, float) and isinstance(other, int | float):
        return abs(value - other) <= 1e-6 * max(1.0, abs(other))
    return value == other
