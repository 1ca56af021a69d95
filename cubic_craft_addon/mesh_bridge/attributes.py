# SPDX-License-Identifier: GPL-3.0-or-later
"""Point attributes of ours on a mesh, added and removed without disturbing the artist's.

Adding or removing an attribute shifts the others inside Blender's list, and Blender remembers
the active one by its place in that list. It also frees the RNA pointers to all of them, so none
may be kept across a call to these functions.
"""

from collections.abc import Iterator
from contextlib import contextmanager

import bpy
import numpy as np

# Attributes called so, or so with something after a dot, are ours, also where Blender has brought
# them along from another mesh, by joining for one.
ORIGINAL = "cubic_craft_original"
ROTATION = "cubic_craft_rotation"
LIVE = "cubic_craft_live"


def our_attributes(
    mesh: bpy.types.Mesh, kinds: tuple[str, ...] = (ORIGINAL, ROTATION, LIVE)
) -> list[str]:
    """List the names of the attributes of ours on a mesh, of all kinds or of some."""
    names = (attribute.name for attribute in mesh.attributes)
    return [name for name in names if name.partition(".")[0] in kinds]


def add_attribute(mesh: bpy.types.Mesh, name: str, values: np.ndarray) -> None:
    """Add a point attribute.

    Parameters
    ----------
    mesh : the mesh, not in Edit Mode, without an attribute of that name
    name : name of the attribute
    values : (n,3) numpy float32 array of vectors, or (n,4) of quaternions
    """
    with active_kept(mesh):
        data_type = "FLOAT_VECTOR" if values.shape[1] == 3 else "QUATERNION"
        attribute = mesh.attributes.new(name, data_type, "POINT")
        if isinstance(attribute, bpy.types.FloatVectorAttribute):
            attribute.data.foreach_set("vector", np.ravel(values))
        elif isinstance(attribute, bpy.types.QuaternionAttribute):
            attribute.data.foreach_set("value", np.ravel(values))


def remove_attribute(mesh: bpy.types.Mesh, name: str) -> None:
    """Remove an attribute by name."""
    with active_kept(mesh):
        mesh.attributes.remove(mesh.attributes[name])


def read_attribute(mesh: bpy.types.Mesh, name: str, size: int) -> np.ndarray | None:
    """Read a point attribute of vectors (size 3) or quaternions (size 4).

    Returns
    -------
    (n,size) numpy float32 array, or None where there is no such attribute of that kind
    """
    attribute = mesh.attributes.get(name)
    if attribute is None or attribute.domain != "POINT":
        return None
    values = np.empty((len(mesh.vertices), size), np.float32)
    if size == 3 and isinstance(attribute, bpy.types.FloatVectorAttribute):
        attribute.data.foreach_get("vector", values.reshape(-1))
    elif size == 4 and isinstance(attribute, bpy.types.QuaternionAttribute):
        attribute.data.foreach_get("value", values.reshape(-1))
    else:
        return None
    return values


@contextmanager
def active_kept(mesh: bpy.types.Mesh) -> Iterator[None]:
    """Keep the active attribute the same one, although its place in the list changes."""
    place = mesh.attributes.active_index or 0
    name = mesh.attributes[place].name if 0 <= place < len(mesh.attributes) else ""
    try:
        yield
    finally:
        found = mesh.attributes.find(name) if name else -1
        mesh.attributes.active_index = found if found >= 0 else place
