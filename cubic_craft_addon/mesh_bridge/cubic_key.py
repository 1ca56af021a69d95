# SPDX-License-Identifier: GPL-3.0-or-later
"""The shape key of ours: made, found again, removed.

The artist may rename it, dial it, key it and drive it. It is found by its name, and under another
name by its points.
"""

import bpy
import numpy as np

from .arrays import read_key, write_key
from .checks import mesh_of
from .fingerprint import fingerprint
from .note import read_note, write_note

_NAME = "Cubic"


def find_cubic_key(mesh: bpy.types.Mesh) -> bpy.types.ShapeKey | None:
    """Find the shape key of ours, or None. As reference key it would no longer be a result."""
    noted = read_note(mesh).get("key")
    if noted is None or mesh.shape_keys is None:
        return None
    reference = mesh.shape_keys.reference_key
    keys = [key for key in mesh.shape_keys.key_blocks if key != reference]
    named = next((key for key in keys if key.name == noted["name"]), None)
    if named is not None and fingerprint(read_key(mesh, named)) == noted["fingerprint"]:
        return named
    renamed = (key for key in keys if fingerprint(read_key(mesh, key)) == noted["fingerprint"])
    # Under its name but with other points: editing Basis in Edit Mode moves the keys along.
    return next(renamed, named)


def write_cubic_key(obj: bpy.types.Object, positions: np.ndarray) -> None:
    """Write positions to the shape key of ours, which is made where it is missing.

    A key that is there keeps its value, its range, and what drives it.
    """
    mesh = mesh_of(obj)
    note = read_note(mesh)
    key = find_cubic_key(mesh)
    made_basis = note["key"]["made_basis"] if key is not None else False
    if key is None:
        if mesh.shape_keys is None:
            obj.shape_key_add(name="Basis", from_mix=False)
            made_basis = True
        key = obj.shape_key_add(name=_NAME, from_mix=False)
        key.value = 1.0  # what a new key starts with differs between versions of Blender
    write_key(key, positions)
    part = {"name": key.name, "fingerprint": fingerprint(positions), "made_basis": made_basis}
    write_note(mesh, note | {"key": part})


def remove_cubic_key(mesh: bpy.types.Mesh) -> None:
    """Remove the shape key of ours, and Basis where we made it and no other key needs it."""
    note = read_note(mesh)
    key = find_cubic_key(mesh)
    noted = note.pop("key", None)
    if key is not None:
        remove_key(mesh, key)
        shape_keys = mesh.shape_keys
        if noted["made_basis"] and shape_keys is not None and len(shape_keys.key_blocks) == 1:
            remove_key(mesh, shape_keys.reference_key)
    write_note(mesh, note)


def remove_key(mesh: bpy.types.Mesh, key: bpy.types.ShapeKey) -> None:
    """Remove a shape key with its drivers, on every object of the mesh.

    The active shape key is remembered per object, by number, and Blender corrects that of one
    object only. So the key is removed through a passing object, and all are corrected alike.
    """
    shape_keys = mesh.shape_keys
    assert shape_keys is not None
    place = shape_keys.key_blocks.find(key.name)
    active = {obj: obj.active_shape_key_index for obj in bpy.data.objects if obj.data == mesh}
    animation = shape_keys.animation_data
    if animation is not None:  # Blender 4.2 would leave them behind, pointing nowhere
        path = key.path_from_id() + "."
        for driver in [d for d in animation.drivers if d.data_path.startswith(path)]:
            animation.drivers.remove(driver)
    passing = bpy.data.objects.new(key.name, mesh)
    try:
        passing.shape_key_remove(key)
    finally:
        bpy.data.objects.remove(passing)
    for obj, index in active.items():
        if index and index >= place:
            obj.active_shape_key_index = index - 1
