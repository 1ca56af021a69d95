# SPDX-License-Identifier: GPL-3.0-or-later
"""All shapes of a mesh: positions, shape keys and free normals, and how keys follow the base."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import bpy
import numpy as np

from .arrays import mark_moved, read_key, read_position, write_key, write_position
from .free_normals import read_free_normals, write_free_normals


@dataclass(frozen=True)
class Shapes:
    """The shapes of a mesh as plain arrays, each (n,3) float32.

    `keys` and `relative` go by the names of the shape keys. Every key but the reference (the
    first) is in `relative`, in an order in which the key that it is relative to comes before it.
    `normals` are the free normals (see `free_normals`), None if there are none, or to leave them.
    """

    position: np.ndarray
    keys: dict[str, np.ndarray]
    reference: str | None
    relative: dict[str, str]
    normals: np.ndarray | None = None

    @property
    def base(self) -> np.ndarray:
        """The effective shape: the reference key if there are shape keys."""
        return self.position if self.reference is None else self.keys[self.reference]


def read_shapes(mesh: bpy.types.Mesh, skip: bpy.types.ShapeKey | None = None) -> Shapes:
    """Read all shapes of a mesh, without the shape key `skip`."""
    position = read_position(mesh)
    blocks = mesh.shape_keys.key_blocks if mesh.shape_keys is not None else ()
    keys = {key.name: read_key(mesh, key) for key in blocks if key != skip}
    return replace(assembled(mesh, position, keys), normals=read_free_normals(mesh))


def assembled(mesh: bpy.types.Mesh, position: np.ndarray, keys: dict[str, np.ndarray]) -> Shapes:
    """Make Shapes from arrays, with the relations of the mesh's shape keys of these names."""
    if mesh.shape_keys is None:
        return Shapes(position, {}, None, {})
    reference = mesh.shape_keys.reference_key.name
    blocks = [mesh.shape_keys.key_blocks[name] for name in keys]
    relative = {key.name: key.relative_key.name for key in blocks if key.name != reference}
    return Shapes(position, keys, reference, _ordered(relative, reference))


def write_shapes(mesh: bpy.types.Mesh, shapes: Shapes) -> None:
    """Write shapes back to the mesh that they were read from."""
    if mesh.shape_keys is not None:
        for name, points in shapes.keys.items():
            write_key(mesh.shape_keys.key_blocks[name], points)
    write_position(mesh, shapes.position)
    if shapes.normals is not None:
        write_free_normals(mesh, shapes.normals)
    mark_moved(mesh)


def carry(
    shapes: Shapes,
    base: np.ndarray,
    rotations: np.ndarray,
    known: Mapping[str, np.ndarray] | None = None,
) -> Shapes:
    """Move the base, and every shape key with it.

    Each key keeps its offset from the key that it is relative to, turned by the rotation of its
    vertex. Where nothing moves and nothing turns, a key keeps its bits. The free normals are left
    out.

    `shapes`: the shapes before. `base`: (n,3) float32, the new base; also the new ``position``,
    because Blender itself keeps that equal to the reference key. `rotations`: (n,3,3). `known`:
    dict from names of keys to their new points, if already known.
    """
    if shapes.reference is None:
        return Shapes(base, {}, None, {})
    known = known or {}
    keys = {shapes.reference: base}
    for name, other in shapes.relative.items():
        keys[name] = (
            known[name]
            if name in known
            else carried(shapes.keys[name], shapes.keys[other], keys[other], rotations)
        )
    return Shapes(base, keys, shapes.reference, shapes.relative)


def carried(
    key: np.ndarray, other: np.ndarray, new_other: np.ndarray, matrices: np.ndarray
) -> np.ndarray:
    """Carry one key along with the key `other` that it is relative to.

    `key`, `other`, `new_other`: (n,3) float32. `matrices`: (n,3,3), what the offsets are turned by.
    Returns (n,3) float32; the bits of `key` where nothing moves and nothing turns.
    """
    offset = key.astype(np.float64) - other
    with np.errstate(over="ignore"):  # infinities are refused when the result is written
        turned = (new_other + np.einsum("nij,nj->ni", matrices, offset)).astype(np.float32)
    unturned = (matrices == np.eye(3)).all(axis=(1, 2))
    unmoved = unturned & (new_other == other).all(axis=1)
    return np.where(unmoved[:, None], key, turned)


def _ordered(relative: Mapping[str, str], reference: str) -> dict[str, str]:
    """Sort keys so that each comes after the key that it is relative to.

    A key in a cycle (for example relative to itself), or relative to an omitted key, is
    treated as relative to the reference.
    """
    ordered: dict[str, str] = {}
    pending = dict(relative)
    while pending:
        ready = {n: o for n, o in pending.items() if o == reference or o in ordered}
        if not ready:
            ready = {next(iter(pending)): reference}
        ordered |= ready
        pending = {n: o for n, o in pending.items() if n not in ready}
    return ordered
