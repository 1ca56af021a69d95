# SPDX-License-Identifier: GPL-3.0-or-later
"""The solver's arrays prepared for writing: rounded and checked, with no needless changes."""

from dataclasses import replace

import bpy
import numpy as np

from ....solver.errors import CubicCraftError
from .free_normals import turned
from .rotations import matrices_from_quaternions, quaternions_from_matrices
from .shapes import Shapes, carry


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
