# SPDX-License-Identifier: GPL-3.0-or-later
"""Attributes that are on a mesh only while it is written to a file."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import bpy
import numpy as np

from .attributes import active_kept, free_name


@contextmanager
def carried_attributes(
    mesh: bpy.types.Mesh, values: Mapping[str, np.ndarray], *, are_colors: bool
) -> Iterator[None]:
    """Add point attributes, and remove them however the block ends.

    `mesh`: the mesh, not in Edit Mode, whose names of attributes are not among those of `values`.
    `values`: (n,) float32 for each name. `are_colors`: whether they are gray colors instead of
    plain numbers.
    """
    free = {name: free_name() for name in values}
    try:
        with active_kept(mesh):
            for name, numbers in values.items():
                _add(mesh, free[name], name, numbers, are_colors)
            mesh.update()
        yield
    finally:
        with active_kept(mesh):
            for name in values:
                found = _find(mesh, name, are_colors) or mesh.attributes.get(free[name])
                if found is not None:
                    found.name = free[name]  # a vertex group may have its name
                    mesh.attributes.remove(mesh.attributes[free[name]])
            mesh.update()


def _add(mesh: bpy.types.Mesh, free: str, name: str, numbers: np.ndarray, are_colors: bool) -> None:
    attribute: Any = mesh.attributes.new(free, _kind(are_colors), "POINT")
    if are_colors:
        colors = np.ones((len(numbers), 4), np.float32)
        colors[:, :3] = numbers[:, None]
        attribute.data.foreach_set("color_srgb", colors.ravel())  # files then hold the numbers
    else:
        attribute.data.foreach_set("value", numbers.astype(np.float32))
    attribute.name = name


def _find(mesh: bpy.types.Mesh, name: str, are_colors: bool) -> bpy.types.Attribute | None:
    """Return the attribute of that name that is no vertex group."""
    for attribute in mesh.attributes:
        is_ours = attribute.domain == "POINT" and attribute.data_type == _kind(are_colors)
        if attribute.name == name and is_ours:
            return attribute
    return None


def _kind(are_colors: bool) -> Any:
    return "FLOAT_COLOR" if are_colors else "FLOAT"
