# SPDX-License-Identifier: GPL-3.0-or-later
"""Shape keys under a result, carried back to their shapes before it."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from ..access.rotations import matrices_from_quaternions
from ..access.shapes import Shapes, carried
from .recognition import Recognized

_ROUNDING = 2.0**-24  # of float32, relative
_MARGIN = 32.0


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

    Parameters
    ----------
    present : the shapes, with shape keys
    recognized : the state of the vertices
    base : (n,3) numpy float32 array, the original base, transformed
    quaternions : (n,4) numpy float32 array or None, the rotations that the result was written with
    known : dict from names of keys to the stored points that they get
    stored : dict from names of keys, including the reference, to their stored points

    Returns
    -------
    dict from names to (n,3) float32 arrays
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
