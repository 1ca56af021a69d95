# SPDX-License-Identifier: GPL-3.0-or-later
"""Shape keys for a copy of an object that has other vertices.

Each vertex of the copy takes the offsets of the nearest place of the old surface that faces the
way it does: where two lips touch, none follows the other.
"""

from collections.abc import Mapping
from typing import Any

import bpy
import numpy as np
from mathutils.bvhtree import BVHTree

from ....solver.mesh.rest_measures import areas_and_normals
from ..access.arrays import read_key, read_position, write_key
from ..access.checks import mesh_of
from ..access.triangulation import triangles as triangles_of
from ..memory.cubic_key import find_cubic_key

_SAME, _NEAR = 1e-4, 0.02  # of the largest extent: as near as the nearest place; another layer
_SETTINGS = ("slider_min", "slider_max", "value", "mute", "vertex_group", "interpolation")


def key_offsets(mesh: bpy.types.Mesh) -> dict[str, np.ndarray]:
    """Return the offsets (n,3) of the artist's shape keys from those that they are relative to."""
    keys = mesh.shape_keys
    if keys is None or not keys.use_relative:
        return {}
    passed_over = (keys.reference_key, find_cubic_key(mesh))
    return {
        key.name: read_key(mesh, key) - read_key(mesh, key.relative_key)
        for key in keys.key_blocks
        if key not in passed_over
    }


def transfer_keys(
    source: bpy.types.Mesh,
    new: bpy.types.Object,
    positions: np.ndarray,
    triangles: np.ndarray,
    offsets: Mapping[str, np.ndarray],
) -> None:
    """Give a copy of an object the shape keys of its mesh, with their settings and drivers.

    `source`: the mesh that has the shape keys. `new`: the copy, whose mesh has none. `positions`,
    `triangles`: (n,3) and (m,3) arrays, the old surface. `offsets`: of its vertices, by the names
    of the keys; see `key_offsets`.
    """
    if not offsets:
        return
    assert source.shape_keys is not None
    mesh = mesh_of(new)
    base = read_position(mesh)
    corners, shares = places_on(mesh, positions, triangles)
    new.shape_key_add(name=source.shape_keys.reference_key.name, from_mix=False)
    made = {name: new.shape_key_add(name=name, from_mix=False) for name in offsets}
    moved = {name: np.einsum("nk,nkj->nj", shares, of[corners]) for name, of in offsets.items()}
    blocks = source.shape_keys.key_blocks
    for name, key in made.items():
        points, above = base + moved[name], blocks[name].relative_key.name
        if above in made:
            key.relative_key = made[above]
        while above in made:  # offsets are from a key that has offsets itself
            points, above = points + moved[above], blocks[above].relative_key.name
        write_key(key, points.astype(np.float32))
        for setting in _SETTINGS:
            setattr(key, setting, getattr(blocks[name], setting))
    _copy_animation(source.shape_keys, mesh.shape_keys)


def places_on(
    mesh: bpy.types.Mesh, positions: np.ndarray, triangles: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return where the vertices of a mesh are on an old surface: nearest to it, and facing alike.

    `positions`, `triangles`: (n,3) and (m,3) arrays. Returns the corners (k,3) of the triangles
    that the vertices are at, and their shares (k,3).
    """
    points = read_position(mesh)
    normals = areas_and_normals(points, triangles_of(mesh, points))[1]
    tree = BVHTree.FromPolygons(positions.tolist(), triangles.tolist())
    size = float(np.ptp(positions, axis=0).max())
    _, old_normals = areas_and_normals(positions, triangles)
    corners, shares = np.empty((len(points), 3), np.int64), np.empty((len(points), 3))
    for k, (point, normal) in enumerate(zip(points.tolist(), normals, strict=True)):
        nearest: Any = tree.find_nearest(point)
        distance = nearest[3]
        for reach in (_SAME, _NEAR):  # other layers only if the nearest faces away
            near: Any = tree.find_nearest_range(point, distance + reach * size)
            at = triangles[[number for _, _, number, _ in near]]
            of = shares_of(np.array([place for place, *_ in near]), positions[at])
            agreement = np.einsum("ck,ckj->cj", of, old_normals[at]) @ normal
            beyond = np.array([apart for *_, apart in near]) - distance
            beyond = np.floor(beyond / (1.001 * _SAME * size))
            best = np.lexsort((-agreement, beyond, agreement <= 0.0))[0]
            corners[k], shares[k] = at[best], of[best]
            if agreement[best] > 0.0:
                break
    return corners, shares


def shares_of(places: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Return the barycentric coordinates (k,3) of places (k,3) in triangles (k,3,3)."""
    opposite = [
        np.cross(corners[:, (k + 1) % 3] - places, corners[:, (k + 2) % 3] - places)
        for k in range(3)
    ]
    areas = np.linalg.norm(opposite, axis=2).T
    total = areas.sum(axis=1, keepdims=True)
    return np.where(total > 0.0, areas / np.where(total > 0.0, total, 1.0), 1.0 / 3.0)


def _copy_animation(source: bpy.types.Key, target: Any) -> None:
    animation: Any = source.animation_data
    if animation is None:
        return
    copied = target.animation_data_create()
    if animation.action is not None:
        copied.action = animation.action
        if hasattr(animation, "action_slot"):  # from Blender 4.4 on
            copied.action_slot = animation.action_slot
    names = (bpy.utils.escape_identifier(key.name) for key in target.key_blocks)
    paths = tuple(f'key_blocks["{name}"].' for name in names)
    for driver in animation.drivers:
        if driver.data_path.startswith(paths):
            copied.drivers.from_existing(src_driver=driver)
