# SPDX-License-Identifier: GPL-3.0-or-later
"""The shape key of ours: made, found again, removed.

The artist may rename it, dial it, key it and drive it. It is found by its points, under any name.
With other points than we wrote it is the artist's, whatever it is called: it is never changed or
removed again. Only where Blender itself has moved it along with an edited Basis it stays ours.
"""

import bpy
import numpy as np

from .arrays import read_key, write_key
from .checks import mesh_of
from .fingerprint import fingerprint_of_values
from .note import read_note, write_note
from .offsets import offset_sums, same_offsets

_NAME = "Cubic"


def find_cubic_key(mesh: bpy.types.Mesh) -> bpy.types.ShapeKey | None:
    """Find the shape key of ours, or None. As reference key it would no longer be a result."""
    noted = read_note(mesh).get("key")
    if noted is None or mesh.shape_keys is None:
        return None
    reference = mesh.shape_keys.reference_key
    keys = [key for key in mesh.shape_keys.key_blocks if key != reference]
    keys.sort(key=lambda key: key.name != noted["name"])  # the most likely one first
    base = read_key(mesh, reference)

    def is_written(points: np.ndarray) -> bool:
        return fingerprint_of_values(points) == noted["fingerprint"]

    def is_shifted(points: np.ndarray) -> bool:
        return same_offsets(offset_sums(points, base), noted["offsets"])

    # While Basis is as it was, nothing has moved the key but the artist.
    tests = (
        (is_written,) if fingerprint_of_values(base) == noted["base"] else (is_written, is_shifted)
    )
    for is_ours in tests:
        for key in keys:
            points = read_key(mesh, key)
            is_fresh = np.array_equal(points, base)  # as every new key is: its name must tell
            if is_ours(points) and (key.name == noted["name"] or not is_fresh):
                return key
    return None


def write_cubic_key(obj: bpy.types.Object, positions: np.ndarray) -> None:
    """Write positions to the shape key of ours, which is made where it is missing.

    A key that is there keeps its value, its range, and what drives it. One that the artist has
    edited is no longer ours and stays; the note forgets it for the new one.
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
    assert mesh.shape_keys is not None
    base = read_key(mesh, mesh.shape_keys.reference_key)
    part = {
        "name": key.name,
        "fingerprint": fingerprint_of_values(positions),
        "base": fingerprint_of_values(base),
        "offsets": offset_sums(positions, base),
        "made_basis": made_basis,
    }
    write_note(mesh, note | {"key": part})


def remove_cubic_key(mesh: bpy.types.Mesh, key: bpy.types.ShapeKey | None) -> None:
    """Remove the shape key of ours, and Basis where we made it and no other key needs it.

    `key` is what `find_cubic_key` found before anything was written: it compares the key with
    the base. Removing it is the last that is done, as it cannot be taken back.
    """
    note = read_note(mesh)
    noted = note.pop("key", None)
    write_note(mesh, note)
    if key is None:
        return
    shape_keys = mesh.shape_keys
    assert shape_keys is not None
    # With Basis alone Blender takes it for no shape key at all.
    is_all_ours = noted["made_basis"] and len(shape_keys.key_blocks) == 2
    remove_keys(mesh, [key, shape_keys.reference_key] if is_all_ours else [key])


def remove_keys(mesh: bpy.types.Mesh, keys: list[bpy.types.ShapeKey]) -> None:
    """Remove shape keys with their drivers, on every object of the mesh.

    The active shape key is remembered per object, by number, and Blender corrects that of one
    object only. So the key is removed through a passing object, and all are corrected alike.
    """
    for key in keys:
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
