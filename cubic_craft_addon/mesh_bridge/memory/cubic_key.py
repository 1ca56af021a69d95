# SPDX-License-Identifier: GPL-3.0-or-later
"""Our shape key: made, found again, removed.

The artist may rename it, change its value, animate it and drive it. It is found by its points,
under any name. With points other than those we wrote, it is the artist's, whatever its name: it is
never changed or removed again. It only remains ours if Blender itself has moved it with an edited
Basis, or transformed it with the whole mesh. For the latter, attributes hold its points and those
of Basis as we wrote them.
"""

from collections.abc import Callable

import bpy
import numpy as np

from ..access.arrays import read_key, write_key
from ..access.attributes import KEY, add_attribute, our_attributes, read_attribute, remove_attribute
from ..access.checks import mesh_of
from ..access.note import fingerprint_of_values, read_note, write_note
from .affine import fit

_NAME = "Cubic"
_BASE = f"{KEY}.base"
_STROKES = f"{KEY}.strokes"  # that are in the key, see `strokes`
_ROUNDING = 2.0**-24  # of float32, relative
_MARGIN = 16.0  # several edits of Basis in a row, each of a rounding


def find_cubic_key(mesh: bpy.types.Mesh) -> bpy.types.ShapeKey | None:
    """Find our shape key, or None. As reference key it would no longer be a result."""
    noted = read_note(mesh).get("key")
    if noted is None or mesh.shape_keys is None:
        return None
    reference = mesh.shape_keys.reference_key
    keys = [key for key in mesh.shape_keys.key_blocks if key != reference]
    keys.sort(key=lambda key: key.name != noted["name"])  # the most likely one first
    base = read_key(mesh, reference)

    def is_written(points: np.ndarray) -> bool:
        return fingerprint_of_values(points) == noted["fingerprint"]

    # While Basis is unchanged, only the artist can have moved the key.
    is_base_moved = fingerprint_of_values(base) != noted["base"]
    tests = [is_written, *(_moved_with_basis(mesh, base) if is_base_moved else ())]
    for is_ours in tests:
        for key in keys:
            points = read_key(mesh, key)
            is_fresh = np.array_equal(points, base)  # as every new key does: its name must decide
            if is_ours(points) and (key.name == noted["name"] or not is_fresh):
                return key
    return None


def _moved_with_basis(mesh: bpy.types.Mesh, base: np.ndarray) -> list[Callable[..., bool]]:
    """Return tests whether points are the key as Blender moves it: with edits, or transforms."""
    written, written_base = read_attribute(mesh, KEY, 3), read_attribute(mesh, _BASE, 3)
    if written is None or written_base is None:
        return []
    transform, offsets = fit(written_base, base), written.astype(np.float64) - written_base
    size = max(np.abs(array).max(initial=0.0) for array in (written, written_base, base))

    def is_shifted(points: np.ndarray) -> bool:
        change = points.astype(np.float64) - base - offsets
        return bool(np.abs(change).max(initial=0.0) <= _MARGIN * _ROUNDING * size)

    def is_transformed(points: np.ndarray) -> bool:
        return transform is not None and bool(transform.agrees(written, points).all())

    return [is_shifted, is_transformed]


def key_strokes(mesh: bpy.types.Mesh) -> np.ndarray | None:
    """Read the strokes (n,3) float32 in our shape key, transformed with Basis; None for none."""
    strokes, written = read_attribute(mesh, _STROKES, 3), read_attribute(mesh, _BASE, 3)
    if strokes is None or written is None or mesh.shape_keys is None:
        return strokes
    way = fit(written, read_key(mesh, mesh.shape_keys.reference_key))
    if way is None or way.is_identity:
        return strokes
    return (strokes @ way.linear.T).astype(np.float32)


def write_cubic_key(
    obj: bpy.types.Object,
    positions: np.ndarray,
    key: bpy.types.ShapeKey | None,
    strokes: np.ndarray | None = None,
) -> None:
    """Write positions, with the strokes in them, to our shape key; it is created if it is missing.

    `key` is what `find_cubic_key` found before anything was written. It keeps its value, range
    and drivers. A key that the artist has edited is no longer ours and is kept; the note then
    refers to the new one.
    """
    mesh = mesh_of(obj)
    note = read_note(mesh)
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
    for name, points in ((KEY, positions), (_BASE, base), (_STROKES, strokes)):
        if points is not None:
            add_attribute(mesh, name, points)
    part = {
        "name": key.name,
        "fingerprint": fingerprint_of_values(positions),
        "base": fingerprint_of_values(base),
        "offsets": [],  # version 0.1.0 takes a note without them for somebody else's
        "made_basis": made_basis,
    }
    write_note(mesh, note | {"key": part})


def remove_cubic_key(mesh: bpy.types.Mesh, key: bpy.types.ShapeKey | None) -> None:
    """Remove our shape key, and Basis if we made it and no other key needs it.

    `key` is what `find_cubic_key` found before anything was written: it compares the key with
    the base. Removing it is the last step, because it cannot be undone.
    """
    for name in our_attributes(mesh, (KEY,)):
        remove_attribute(mesh, name)
    note = read_note(mesh)
    noted = note.pop("key", None)
    write_note(mesh, note)
    if key is None:
        return
    shape_keys = mesh.shape_keys
    assert shape_keys is not None
    # Blender treats a mesh with Basis alone like one without shape keys.
    is_all_ours = noted["made_basis"] and len(shape_keys.key_blocks) == 2
    remove_keys(mesh, [key, shape_keys.reference_key] if is_all_ours else [key])


def remove_keys(mesh: bpy.types.Mesh, keys: list[bpy.types.ShapeKey]) -> None:
    """Remove shape keys with their drivers, on every object of the mesh.

    The active shape key is remembered per object, by number, and Blender corrects that of one
    object only. So the key is removed through a temporary object, and all are corrected alike.
    """
    for key in keys:
        shape_keys = mesh.shape_keys
        assert shape_keys is not None
        place = shape_keys.key_blocks.find(key.name)
        active = {obj: obj.active_shape_key_index for obj in bpy.data.objects if obj.data == mesh}
        animation = shape_keys.animation_data
        if animation is not None:  # Blender 4.2 would keep them, without a target
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
