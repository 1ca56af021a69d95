# SPDX-License-Identifier: GPL-3.0-or-later
"""From the coordinates of an object to the shape as it is seen, and to the frame of the cube."""

import math

import bpy
import numpy as np
from mathutils import Euler, Matrix

from .. import solver
from ..solver import CubicCraftError
from .settings import Settings

_SMALLEST_STRETCH = 1e-4  # relative; an object flatter than this is solved as if it were not scaled
_DIGITS = 5  # of the stretch; the world matrix is made of 32 bit numbers


def stretch_and_orientation(obj: bpy.types.Object, settings: Settings):
    """Return the object's stretch and the orientation of the cube.

    The world matrix of the object, W = T S, is split (polar decomposition) into a rotation or
    mirroring T and a symmetric stretch S. The mesh is solved as it is seen, that is with positions
    S v, and the cube's frame is given in the same coordinates. So an object scaled flat becomes as
    cubic as the same mesh modelled flat.

    Returns
    -------
    stretch : (3,3) array
        S, invertible.
    orientation : (3,3) array
        The rotation Q that maps stretched object coordinates into the cube's frame.

    Raises
    ------
    CubicCraftError
        The space is FRAME and no frame object is set, or the object's matrix is not finite.
    """
    turn, stretch = _turn_and_stretch(obj)
    axes = np.array(Euler(settings.orientation).to_matrix(), dtype=np.float64)
    return stretch, _proper(axes.T @ _into_space(obj, settings, turn))


def world_axes(obj: bpy.types.Object, settings: Settings):
    """Return the axes of the cube in world space, as the columns of a (3,3) array.

    Raises
    ------
    CubicCraftError
        As `stretch_and_orientation`.
    """
    turn, _ = _turn_and_stretch(obj)
    _, orientation = stretch_and_orientation(obj, settings)
    return turn @ orientation.T


def angles_of(obj: bpy.types.Object, settings: Settings, orientation):
    """Return the Euler angles (radians) that give the orientation, the inverse of the above.

    Of the 24 that are the same for a cube, these are the smallest.
    """
    turn, _ = _turn_and_stretch(obj)
    axes = _proper(_into_space(obj, settings, turn) @ orientation.T)
    return Matrix(solver.nearest_to_identity(axes.T).T).to_euler()


def _turn_and_stretch(obj):
    world = np.array(obj.matrix_world.to_3x3(), dtype=np.float64)
    if not np.isfinite(world).all():
        raise CubicCraftError(f'"{obj.name}" has a scale or rotation that is not finite; clear it')
    U, sizes, Vt = np.linalg.svd(world)
    if sizes[-1] > _SMALLEST_STRETCH * max(sizes[0], 1e-30):
        return U @ Vt, _rounded(Vt.T @ np.diag(sizes) @ Vt)
    return np.array(obj.matrix_world.to_quaternion().to_matrix(), dtype=np.float64), np.eye(3)


def _rounded(stretch):
    """Drop the last digits, so that turning the object alone leaves the stretch bit for bit."""
    unit = 10.0 ** (math.floor(math.log10(np.abs(stretch).max())) - _DIGITS)
    return np.round(stretch / unit) * unit + 0.0  # no negative zeros


def _into_space(obj, settings, turn):
    """Return the matrix from stretched object coordinates into what the angles are relative to."""
    if settings.space == "OBJECT":
        return np.eye(3)
    if settings.space == "WORLD":
        return turn
    if settings.frame is None:
        raise CubicCraftError(
            f'"{obj.name}" takes its orientation from a frame object, but none is set;'
            " pick one or choose another space"
        )
    frame = settings.frame.matrix_world.to_quaternion().to_matrix()
    return np.array(frame, dtype=np.float64).T @ turn


def _proper(matrix):
    """Return the rotation that is the same for a cube, which looks alike in a mirror."""
    return matrix if np.linalg.det(matrix) > 0.0 else -matrix
