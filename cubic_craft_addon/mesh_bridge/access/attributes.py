# SPDX-License-Identifier: GPL-3.0-or-later
"""Our point attributes on a mesh, added and removed without affecting the artist's.

Adding or removing an attribute shifts the others inside Blender's list, and Blender remembers
the active one by its place in that list. It also frees the RNA pointers to all of them, so none
may be kept across a call to these functions.

To Blender, vertex groups are attributes too, and a group may get the name of one of our attributes
(see `group_names`). Blender may then return the group for that name. Attributes are therefore
created and removed under a unique name.
"""

import re
import uuid
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import bpy
import numpy as np

from ....solver.errors import CubicCraftError

# Point attributes with these names, or with one of the endings, are ours, even if Blender has
# copied them from another mesh, for example by joining.
ORIGINAL = "cubic_craft_original"
ROTATION = "cubic_craft_rotation"
LIVE = "cubic_craft_live"
KEY = "cubic_craft_key"
FIRST = "cubic_craft_first"

RESULT_KINDS = (ORIGINAL, ROTATION, LIVE, KEY)
"""what belongs to the result that is there; FIRST outlives it"""

_VALUES = {"FLOAT_VECTOR": "vector", "FLOAT_COLOR": "color_srgb"}  # which files then hold
"""what attributes call their values, by their type; all others say "value" """
_NORMALS = ".normals"  # as `free_normals`, on points, corners or faces; all others are on points
_ENDINGS = r"\.position|\.normals|\.key\d+|\.written|\.mark|\.base|\.rotation|\.strokes"
_NAMES = re.compile(rf"({ORIGINAL}|{ROTATION}|{LIVE}|{KEY}|{FIRST})({_ENDINGS})?")


def is_our_name(name: str) -> bool:
    """Return whether a name is one of our attribute names."""
    return _NAMES.fullmatch(name) is not None


def our_attributes(
    mesh: bpy.types.Mesh, kinds: tuple[str, ...] = (*RESULT_KINDS, FIRST)
) -> list[str]:
    """List the names of our attributes on a mesh, of all kinds or of some."""
    return [
        attribute.name
        for attribute in mesh.attributes
        if (match := _NAMES.fullmatch(attribute.name)) and match[1] in kinds and _is_ours(attribute)
    ]


def check_names(mesh: bpy.types.Mesh) -> None:
    """Check that our names are free or ours; those of vertex groups do not matter here.

    Raises CubicCraftError: a UV map, a color attribute or another attribute of the artist has such
    a name.
    """
    for attribute in mesh.attributes:
        if is_our_name(attribute.name) and not _is_ours(attribute):
            raise CubicCraftError(
                f'Mesh "{mesh.name}" has an attribute "{attribute.name}" that is not CubicCraft\'s '
                "own: rename or remove it first (Object Data > UV Maps, Color Attributes or "
                "Attributes)"
            )


def add_attribute(
    mesh: bpy.types.Mesh, name: str, values: np.ndarray, domain: Any = "POINT", kind: Any = None
) -> None:
    """Add an attribute.

    `mesh`: the mesh, not in Edit Mode, without an attribute of that name. `values`: float32.
    `domain`: what they belong to. `kind`: the type of the attribute; by default (n,3) are vectors
    and (n,4) quaternions.
    """
    kind = kind or ("FLOAT_VECTOR" if values.shape[1] == 3 else "QUATERNION")
    with active_kept(mesh):
        attribute: Any = mesh.attributes.new(free_name(), kind, domain)
        attribute.data.foreach_set(_VALUES.get(kind, "value"), np.ravel(values))
        attribute.name = name


def remove_attribute(mesh: bpy.types.Mesh, name: str) -> None:
    """Remove an attribute by name."""
    with active_kept(mesh):
        free = free_name()
        mesh.attributes[name].name = free
        mesh.attributes.remove(mesh.attributes[free])


def read_attribute(
    mesh: bpy.types.Mesh, name: str, size: int, domain: str = "POINT"
) -> np.ndarray | None:
    """Read an attribute of vectors (size 3) or quaternions (size 4).

    Returns (n,size) float32, or None if there is no such attribute of that kind.
    """
    attribute = mesh.attributes.get(name)
    if attribute is None or attribute.domain != domain:
        return None
    values = np.empty((len(attribute.data), size), np.float32)
    if size == 3 and isinstance(attribute, bpy.types.FloatVectorAttribute):
        attribute.data.foreach_get("vector", values.reshape(-1))
    elif size == 4 and isinstance(attribute, bpy.types.QuaternionAttribute):
        attribute.data.foreach_get("value", values.reshape(-1))
    else:
        return None
    return values


@contextmanager
def active_kept(mesh: bpy.types.Mesh) -> Iterator[None]:
    """Keep the same attribute active although its place in the list changes."""
    place = mesh.attributes.active_index or 0
    name = mesh.attributes[place].name if 0 <= place < len(mesh.attributes) else ""
    try:
        yield
    finally:
        found = mesh.attributes.find(name) if name else -1
        mesh.attributes.active_index = found if found >= 0 else place


def _is_ours(attribute: bpy.types.Attribute) -> bool:
    is_in_domain = attribute.domain == "POINT" or attribute.name.endswith(_NORMALS)
    return is_in_domain and attribute.data_type in ("FLOAT_VECTOR", "QUATERNION")


def free_name() -> str:
    """Return a name that no attribute or vertex group has."""
    return uuid.uuid4().hex


@contextmanager
def carried_attributes(
    mesh: bpy.types.Mesh, values: Mapping[str, np.ndarray], *, are_colors: bool
) -> Iterator[None]:
    """Add point attributes, and remove them however the block ends.

    `mesh`: the mesh, not in Edit Mode, whose names of attributes are not among those of `values`.
    `values`: (n,) float32 for each name. `are_colors`: whether they are gray colors instead of
    plain numbers.
    """
    kind = "FLOAT_COLOR" if are_colors else "FLOAT"
    try:
        for name, numbers in values.items():
            gray = np.column_stack([numbers] * 3 + [np.ones_like(numbers)])
            add_attribute(mesh, name, gray if are_colors else numbers, kind=kind)
        mesh.update()
        yield
    finally:
        with active_kept(mesh):
            for name in values:
                found = [a for a in mesh.attributes if (a.name, a.data_type) == (name, kind)]
                if found:  # a vertex group may have its name
                    found[0].name = free = free_name()
                    mesh.attributes.remove(mesh.attributes[free])
            mesh.update()
