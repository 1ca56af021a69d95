# SPDX-License-Identifier: GPL-3.0-or-later
"""Recognize whether an artist has given a mesh anything but another shape."""

import hashlib

import bpy
import numpy as np

from .attributes import is_our_name
from .checks import mesh_of

_VALUES = ("value", "vector", "color")  # what an attribute calls them, depending on its type
_DTYPES = {"FLOAT": np.float32, "INT": np.int32, "BOOLEAN": np.bool_}


def dress_of(obj: bpy.types.Object) -> str:
    """Hash the materials, attributes and weights of an object's mesh, without its shape.

    Selection, and all else whose name begins with a dot, is not counted. The mesh has no preview.

    Returns a str of 32 hexadecimal digits.
    """
    mesh = mesh_of(obj)
    found = hashlib.blake2b(digest_size=16)
    materials = [material and material.session_uid for material in mesh.materials]
    found.update(repr((materials, obj.vertex_groups.keys())).encode())
    for attribute in mesh.attributes:
        name = attribute.name
        if name != "position" and not name.startswith(".") and not is_our_name(name):
            found.update(f"{name} {attribute.domain} {attribute.data_type}".encode())
            found.update(_bytes(attribute))
    if obj.vertex_groups:
        weights = [(e.group, e.weight) for vertex in mesh.vertices for e in vertex.groups]
        found.update(np.array([len(v.groups) for v in mesh.vertices]).tobytes())
        found.update(np.array(weights, np.float32).tobytes())
    return found.hexdigest()


def _bytes(attribute):
    properties = attribute.data[0].bl_rna.properties if len(attribute.data) else ()
    for prop in properties:
        if prop.identifier in _VALUES and prop.type in _DTYPES:
            size = len(attribute.data) * (prop.array_length or 1)
            values = np.empty(size, _DTYPES[prop.type])
            attribute.data.foreach_get(prop.identifier, values)
            return values.tobytes()
    return b""
