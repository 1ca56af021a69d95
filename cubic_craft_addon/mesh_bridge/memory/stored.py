# SPDX-License-Identifier: GPL-3.0-or-later
"""An original and what was made from it, stored on the mesh: written, recognized, and read back."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import bpy
import numpy as np

from ..access.attributes import add_attribute, our_attributes, read_attribute
from ..access.free_normals import domain_of_free_normals, turned
from ..access.note import fingerprint, read_note, write_note
from ..access.rounded_for_storage import matrices_from_quaternions, quaternions_from_matrices
from ..access.shapes import Shapes, carried
from .recognition import UNCHANGED, Recognized, make_marks, recognize

_ROUNDING = 2.0**-24  # of float32, relative
_MARGIN = 32.0
_UNTURNED = (1, 0, 0, 0)


@dataclass(frozen=True)
class _Turned:
    """Maps that carry the offsets of shape keys back, each (n,3,3)."""

    with_mesh: np.ndarray
    """for keys that were transformed with the mesh"""
    alone: np.ndarray
    """for keys that were kept while the base was transformed, as in Edit Mode"""


def carry_back(
    present: Shapes,
    recognized: Recognized,
    base: np.ndarray,
    quaternions: np.ndarray | None,
    known: Mapping[str, np.ndarray],
    stored: Mapping[str, np.ndarray],
) -> dict[str, np.ndarray]:
    """Return the points that all shape keys had before a result, transformed with the mesh since.

    Edits of the artist are kept: the keys are carried with their offsets. If the result equals the
    stored points up to rounding, the stored points are used.

    `present`: the shapes, with shape keys. `recognized`: the state of the vertices. `base`: (n,3)
    float32, the original base, transformed. `quaternions`: (n,4) float32 or None, the rotations
    that the result was written with. `known`: by names of keys, the stored points that they get.
    `stored`: by names of keys, including the reference, their stored points. Returns (n,3) float32
    by names.
    """
    assert present.reference is not None
    keys = {present.reference: base}
    if not present.relative:
        return keys
    back = ways_back(recognized, quaternions, len(base))
    is_flattened = _is_flattened(recognized, len(base))
    for name, other in present.relative.items():
        if name in known:
            keys[name] = known[name]
            continue
        key, under = present.keys[name], present.keys[other]
        points = carried(key, under, keys[other], back.with_mesh)
        if name in stored:
            reach = _MARGIN * _ROUNDING * _sizes(key, back.with_mesh)
            target = recognized.moved(stored[name], points)
            is_met = is_flattened | _is_near(points, target, reach)
            if other in stored and not is_met.all():
                shifted = carried(key, under, keys[other], back.alone)
                offset = stored[name].astype(np.float64) - stored[other]
                is_shifted = is_flattened | _is_near(shifted, keys[other] + offset, reach)
                if is_shifted.sum() > is_met.sum():
                    keys[name] = shifted
                    continue
            points = np.where(is_met[:, None], target, points)
        keys[name] = points
    return keys


def ways_back(recognized: Recognized, quaternions: np.ndarray | None, count: int) -> _Turned:
    """Return the maps that carry offsets back, which a result was written with (n,4) rotations."""
    alone = np.broadcast_to(np.eye(3), (count, 3, 3))
    if quaternions is not None:
        # Vertices of meshes that were joined, or made in between, may have no rotation.
        is_none = np.square(quaternions).sum(axis=1) < 1e-6
        rotations = matrices_from_quaternions(np.where(is_none[:, None], (1, 0, 0, 0), quaternions))
        alone = rotations.transpose(0, 2, 1)
    with_mesh = alone.copy()
    for part in recognized.parts:
        if not part.map.is_identity:
            linear = part.map.linear
            with_mesh[part.rows] = linear @ alone[part.rows] @ np.linalg.inv(linear)
    return _Turned(with_mesh, alone)


def _sizes(points: np.ndarray, back: np.ndarray) -> np.ndarray:
    """Return the magnitudes that the rounding of each carried offset is relative to."""
    return np.abs(points).max(initial=0.0) * (1.0 + np.abs(back).sum(axis=2).max(axis=1))


def _is_near(points: np.ndarray, target: np.ndarray, reach: np.ndarray) -> np.ndarray:
    return np.all(np.abs(points.astype(np.float64) - target) <= reach[:, None], axis=1)


def _is_flattened(recognized: Recognized, count: int) -> np.ndarray:
    """Return whose offsets have lost an extent, so that they cannot be carried back."""
    is_flattened = np.zeros(count, bool)
    for part in recognized.parts:
        is_flattened[part.rows] = part.map.is_flattened
    return is_flattened


@dataclass(frozen=True)
class Stored:
    """Where they are stored: the names of the attributes, and the part of the note.

    "Written" is the shape that the original is known for: a mesh that has it has this original.
    """

    original: str
    """the original base; the names of the other attributes begin with it"""
    rotation: str
    """the rotations from the original to what was written"""
    part: str

    def is_on(self, mesh: bpy.types.Mesh) -> bool:
        """Return whether it is on the mesh, valid or stale. Cheap: it reads no positions."""
        return self.original in our_attributes(mesh, (self.original,))

    def recognize(self, mesh: bpy.types.Mesh, base: np.ndarray) -> Recognized | None:
        """Recognize what was written in the base (n,3); None if its original is unknown."""
        if not self.is_on(mesh):
            return None
        stored = read_note(mesh).get(self.part)
        if stored is not None and fingerprint(base) == stored["fingerprint"]:
            return UNCHANGED
        marks = read_attribute(mesh, f"{self.original}.mark", 3)
        written = self.written(mesh)
        if marks is None or written is None:
            return None  # deleted, or by a version that had none
        if stored is not None and _has_other_reference(mesh, stored):
            return None
        return recognize(marks, written, base)

    def base(self, mesh: bpy.types.Mesh) -> np.ndarray:
        """Read the original base as found by `recognize`."""
        values = read_attribute(mesh, self.original, 3)
        assert values is not None
        return values

    def written(self, mesh: bpy.types.Mesh) -> np.ndarray | None:
        """Read the base that was written, (n,3); None if it was deleted."""
        return read_attribute(mesh, f"{self.original}.written", 3)

    def shapes_before(
        self, mesh: bpy.types.Mesh, present: Shapes, recognized: Recognized
    ) -> Shapes:
        """Return all shapes as they were before, where `present` is what the mesh has now.

        Shape keys that are still as we wrote them get their original bits, also under another
        name. Those that the artist has added or edited since are carried back onto the original.
        """
        shapes = self._positions_before(mesh, present, recognized)
        return replace(shapes, normals=self._normals_before(mesh, present, recognized))

    def rotations(self, mesh: bpy.types.Mesh, recognized: Recognized) -> np.ndarray:
        """Return the rotations as quaternions (n,4), turned with what has been transformed."""
        quaternions = read_attribute(mesh, self.rotation, 4)
        if quaternions is None:
            return np.tile(np.array(_UNTURNED, np.float32), (len(mesh.vertices), 1))
        quaternions[np.square(quaternions).sum(axis=1) < 1e-6] = _UNTURNED
        for part in recognized.parts:
            if not part.map.is_identity:
                linear = part.map.linear
                rotations = matrices_from_quaternions(quaternions[part.rows])
                U, _, Vt = np.linalg.svd(linear @ rotations @ np.linalg.inv(linear))
                quaternions[part.rows] = quaternions_from_matrices(U @ Vt)
        return quaternions

    def ways_back(self, mesh: bpy.types.Mesh, recognized: Recognized) -> np.ndarray:
        """Return the maps (n,3,3) that carry offsets from what is there back to the original."""
        quaternions = read_attribute(mesh, self.rotation, 4)
        return ways_back(recognized, quaternions, len(mesh.vertices)).with_mesh

    def write(
        self, mesh: bpy.types.Mesh, original: Shapes, written: Shapes, quaternions: np.ndarray
    ) -> None:
        """Store the original in attributes of the mesh and describe it in the note.

        `mesh`: a mesh where this is not stored. `original`, `written`: the shapes before and after,
        of the same shape keys. `quaternions`: (n,4) float32, the rotations from the first to the
        second.
        """
        name = self.original
        add_attribute(mesh, name, original.base)
        add_attribute(mesh, self.rotation, quaternions)
        add_attribute(mesh, f"{name}.written", written.base)
        add_attribute(mesh, f"{name}.mark", make_marks(original.base, written.base))
        if original.position.tobytes() != original.base.tobytes():  # only then
            add_attribute(mesh, f"{name}.position", original.position)
        entries = []
        for number, key in enumerate(original.relative, start=1):
            # By number: the name of a key may be longer than that of an attribute.
            attribute = f"{name}.key{number}"
            add_attribute(mesh, attribute, original.keys[key])
            seen = fingerprint(written.keys[key])
            entries.append({"name": key, "fingerprint": seen, "attribute": attribute})
        part = {"fingerprint": fingerprint(written.base), "keys": entries, "normals": ""}
        if original.normals is not None and written.normals is not None:
            domain = domain_of_free_normals(mesh)
            add_attribute(mesh, f"{name}.normals", original.normals, domain)
            part["normals"] = fingerprint(written.normals)
        write_note(mesh, read_note(mesh) | {self.part: part})

    def _positions_before(self, mesh, present, recognized):
        stored_base = self.base(mesh)
        base = recognized.moved(stored_base, present.base)
        if present.reference is None:
            return Shapes(base, {}, None, {})
        entries = read_note(mesh).get(self.part, {}).get("keys", [])
        points = {e["name"]: read_attribute(mesh, e["attribute"], 3) for e in entries}
        stored = {name: values for name, values in points.items() if values is not None}
        keys = carry_back(
            present,
            recognized,
            base,
            read_attribute(mesh, self.rotation, 4),
            _known_keys(mesh, entries, present) if recognized.is_in_place else {},
            stored | {present.reference: stored_base},
        )
        position = None
        if recognized.is_whole:
            position = read_attribute(mesh, f"{self.original}.position", 3)
        position = base if position is None else recognized.moved(position, present.position)
        return Shapes(position, keys, present.reference, present.relative)

    def _normals_before(self, mesh, present, recognized):
        """Return the free normals as they were before; those that are new are turned back."""
        noted = read_note(mesh).get(self.part, {}).get("normals")
        if present.normals is None or noted is None:  # a version that did not turn them wrote it
            return present.normals
        name = f"{self.original}.normals"
        stored = read_attribute(mesh, name, 3, domain_of_free_normals(mesh) or "")
        if stored is not None and noted == fingerprint(present.normals):
            return stored
        return turned(mesh, present.normals, self.ways_back(mesh, recognized))


def _has_other_reference(mesh: bpy.types.Mesh, stored: dict[str, Any]) -> bool:
    """Return whether the artist has deleted Basis, so that another key has become the base."""
    if mesh.shape_keys is None:
        return False
    return mesh.shape_keys.reference_key.name in {entry["name"] for entry in stored["keys"]}


def _known_keys(
    mesh: bpy.types.Mesh, entries: list[dict[str, Any]], present: Shapes
) -> dict[str, np.ndarray]:
    by_print = {entry["fingerprint"]: entry for entry in entries}
    by_both = {(entry["name"], entry["fingerprint"]): entry for entry in entries}
    known = {}
    for name in present.relative:
        seen = fingerprint(present.keys[name])
        entry = by_both.get((name, seen)) or by_print.get(seen)
        points = entry and read_attribute(mesh, entry["attribute"], 3)
        if points is not None:
            known[name] = points
    return known
