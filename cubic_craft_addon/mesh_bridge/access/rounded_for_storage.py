# SPDX-License-Identifier: GPL-3.0-or-later
"""The solver's arrays prepared for writing: rounded and checked, with no needless changes."""

from dataclasses import replace

import bpy
import numpy as np

from ....solver.errors import CubicCraftError
from .free_normals import turned
from .shapes import Shapes, carry


def quaternions_from_matrices(rotations: np.ndarray) -> np.ndarray:
    """Convert rotation matrices to unit quaternions.

    `rotations`: (n,3,3). Returns (n,4) float32 of w, x, y, z; exactly 1, 0, 0, 0 for the exact
    identity.

    All ten products of two components follow from sums of matrix entries. The row of products
    with the largest component is the quaternion times that component: no cancellation
    (Shepperd 1978).
    """
    m = np.asarray(rotations, np.float64)
    products = np.empty((len(m), 4, 4))
    xx, yy, zz = m[:, 0, 0], m[:, 1, 1], m[:, 2, 2]
    products[:, 0, 0] = 1 + xx + yy + zz
    products[:, 1, 1] = 1 + xx - yy - zz
    products[:, 2, 2] = 1 - xx + yy - zz
    products[:, 3, 3] = 1 - xx - yy + zz
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        products[:, 0, i + 1] = products[:, i + 1, 0] = m[:, k, j] - m[:, j, k]
        products[:, i + 1, j + 1] = products[:, j + 1, i + 1] = m[:, i, j] + m[:, j, i]
    largest = np.argmax(np.diagonal(products, axis1=1, axis2=2), axis=1)
    rows = products[np.arange(len(m)), largest]
    return (rows / np.linalg.norm(rows, axis=1, keepdims=True)).astype(np.float32)


def matrices_from_quaternions(quaternions: np.ndarray) -> np.ndarray:
    """Convert quaternions, unit up to rounding, to rotation matrices.

    Offsets of shape keys are rotated and rotated back by the stored ones, so that both are inverse
    to each other even after the .blend was saved.

    `quaternions`: (n,4) of w, x, y, z, none of them zero. Returns (n,3,3).
    """
    q = np.asarray(quaternions, np.float64)
    w, x, y, z = q.T
    s = 2 / np.sum(q * q, axis=1)
    matrices = np.empty((len(q), 3, 3))
    for i, row in enumerate(
        (
            (1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)),
            (s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)),
            (s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)),
        )
    ):
        matrices[:, i] = np.stack(row, axis=1)
    return matrices


def rounded_for_storage(
    mesh: bpy.types.Mesh, positions: np.ndarray, base: np.ndarray, loose: np.ndarray
) -> np.ndarray:
    """Round positions for storage; unmoved and loose vertices keep their bits.

    `mesh`: their mesh, named in messages. `positions`: (n,3), object space. `base`: (n,3) float32,
    the original positions. `loose`: (n,) bool, see `loose_vertices`. Returns (n,3) float32. Raises
    CubicCraftError: as `check_shape`.
    """
    check_shape(mesh, positions, base.shape, "positions")
    with np.errstate(over="ignore"):
        rounded = np.asarray(positions, np.float32)
    same = rounded == base
    # By columns: reducing along so short an axis would take as long as all the rest.
    stays = (same[:, 0] & same[:, 1] & same[:, 2]) | loose
    result = np.where(stays[:, None], base, rounded)
    check_shape(mesh, result, base.shape, "positions")
    return result


def rotations_for_storage(
    mesh: bpy.types.Mesh, rotations: np.ndarray, loose: np.ndarray
) -> np.ndarray:
    """Round rotations for storage; vertices in no face do not turn.

    `mesh`: their mesh, named in messages. `rotations`: (n,3,3). `loose`: (n,) bool. Returns (n,4)
    float32 of quaternions. Raises CubicCraftError: as `check_shape`.
    """
    check_shape(mesh, rotations, (len(loose), 3, 3), "rotations")
    quaternions = quaternions_from_matrices(rotations)
    quaternions[loose] = (1, 0, 0, 0)
    return quaternions


def matrices_for_storage(
    mesh: bpy.types.Mesh, rotations: np.ndarray | None, loose: np.ndarray
) -> np.ndarray:
    """Return the rotations (n,3,3) as they are stored; those of None turn nothing.

    Parameters and errors are those of `rotations_for_storage`.
    """
    if rotations is None:
        return np.broadcast_to(np.eye(3), (len(loose), 3, 3))
    return matrices_from_quaternions(rotations_for_storage(mesh, rotations, loose))


def carry_finite(
    mesh: bpy.types.Mesh, original: Shapes, base: np.ndarray, rotations: np.ndarray
) -> Shapes:
    """Do what `carry` does, turn the free normals, and refuse shape keys that became infinite.

    Raises CubicCraftError: as `check_shape`.
    """
    carried = carry(original, base, rotations)
    for name, points in carried.keys.items():
        check_shape(mesh, points, base.shape, f'shape key "{name}"')
    if original.normals is None:
        return carried
    return replace(carried, normals=turned(mesh, original.normals, rotations))


def check_shape(mesh: bpy.types.Mesh, array: np.ndarray, shape: tuple[int, ...], what: str) -> None:
    """Check that an array to be written fits the mesh and is finite.

    Raises CubicCraftError: the message names the array, `what`.
    """
    if np.shape(array) != shape:
        raise CubicCraftError(
            f'The result does not fit mesh "{mesh.name}": its {what} have the shape '
            f"{np.shape(array)} instead of {shape}; cubify it again"
        )
    if not np.isfinite(array).all():
        raise CubicCraftError(
            f'The result for mesh "{mesh.name}" is not finite in its {what}: nothing was written; '
            "try a smaller cubeness, or clean up degenerate faces (Mesh > Clean Up)"
        )
