# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender keeps of a mesh, as arrays."""

from typing import Any

import bpy
import numpy as np


def read(collection: Any, name: str, kind: Any = np.float32, width: int = 1) -> np.ndarray:
    """Return a property of all members of a collection, (n,) or with a width (n,width)."""
    values = np.empty(len(collection) * width, kind)
    collection.foreach_get(name, values)
    return values if width == 1 else values.reshape(-1, width)


def positions_of(mesh: bpy.types.Mesh) -> np.ndarray:
    """Return the positions, (n,3) float32, of the vertices."""
    return read(mesh.attributes["position"].data, "vector", width=3)


def distinct_rows(values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return the first of each of the rows that differ in a bit, and which of them each row is."""
    keys = np.ascontiguousarray(values).view(f"V{values.itemsize * values.shape[1]}").ravel()
    _, first, row = np.unique(keys, return_index=True, return_inverse=True)
    return first, row.ravel()
