# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether a result is seen: modifiers and pinned shape keys may show a shape of their own.

Some are known to, and can be named before anything is done. For all others, also those of later
versions of Blender, what is seen is compared before and after.
"""

from collections.abc import Callable
from typing import Any

import bpy
import numpy as np

from ....solver.errors import CubicCraftError
from ..access.arrays import read_key, read_position
from ..access.checks import mesh_of
from ..access.triangulation import read_evaluated_points
from ..memory.cubic_key import find_cubic_key

REMEDY = "use Cubify What You See"
LEAST_SHARE = 0.2
"""of how far the points of the mesh have moved; if less is seen, the result is covered"""
_ROUNDING = 1e-5  # of the largest extent


def covers(obj: bpy.types.Object) -> list[str]:
    """Return the names of the modifiers in view that are known to show a shape of their own."""
    return [
        modifier.name
        for modifier in obj.modifiers
        if modifier.show_viewport and _KNOWN.get(modifier.type, lambda _: False)(modifier)
    ]


def cover_problem(obj: bpy.types.Object) -> str:
    """Return why an object will not show a result, as far as that is known before, or nothing."""
    found = covers(obj)
    return f'"{obj.name}" shows the shape of "{found[0]}" instead; {REMEDY}' if found else ""


class Look:
    """What is seen of an object, and what it will be compared with.

    `obj`: a mesh. `result`: {"MESH", "SHAPE_KEY", "NEW_OBJECT"}, where the positions will be
    written.
    """

    def __init__(self, obj: bpy.types.Object, result: str):
        self._is_plain = not obj.show_only_shape_key and not any(
            modifier.show_viewport for modifier in obj.modifiers
        )
        if self._is_plain:
            return
        mesh = mesh_of(obj)
        key = find_cubic_key(mesh) if result == "SHAPE_KEY" else None
        self._own = read_position(mesh) if key is None else read_key(mesh, key)
        self._seen = _seen(obj)

    def problem(self, obj: bpy.types.Object, positions: np.ndarray) -> str:
        """Return why an object does not show the positions (n,3) written to it, or nothing."""
        if self._is_plain or len(self._own) != len(positions):
            return ""
        moved = distance(positions, self._own)
        if moved < _ROUNDING * np.ptp(positions, axis=0).max():
            return ""
        now = _seen(obj)
        if self._seen is None or now is None:
            return ""
        named = ", ".join(f'"{name}"' for name in covers(obj))
        is_old = is_still(self._seen, now, moved)
        if named and now.shape == positions.shape:
            is_old |= distance(now, positions) > (1.0 - LEAST_SHARE) * moved
        if not is_old:
            return ""
        if not named:
            is_pinned = obj.show_only_shape_key
            named = "the pinned shape key" if is_pinned else "one of its modifiers"
        return f'"{obj.name}" still shows the old shape, which {named} brings; {REMEDY}'


def _seen(obj):
    try:
        return read_evaluated_points(obj)[0]
    except CubicCraftError:
        return None


def is_still(before: np.ndarray, now: np.ndarray, moved: float) -> bool:
    """Return whether points (k,3) that are seen do not follow those that have moved so far."""
    return before.shape == now.shape and distance(before, now) < LEAST_SHARE * moved


def distance(one: np.ndarray, other: np.ndarray) -> float:
    """Return the root mean square of the differences of points (n,3)."""
    return float(np.sqrt(np.mean((one - other).astype(np.float64) ** 2))) if len(one) else 0.0


_KNOWN: dict[str, Callable[[Any], bool]] = {
    "CAST": lambda cast: cast.factor != 0.0,
    "CLOTH": lambda cloth: cloth.point_cache.is_baked,
    "CORRECTIVE_SMOOTH": lambda smooth: smooth.rest_source == "BIND" and smooth.is_bind,
    "LAPLACIANDEFORM": lambda deform: deform.is_bind,
    "MESH_CACHE": lambda cache: bool(cache.filepath) and cache.factor > 0.0,
    "MESH_SEQUENCE_CACHE": lambda c: c.cache_file is not None and "VERT" in c.read_data,
    "MULTIRES": lambda multires: multires.total_levels > 0,
    "SHRINKWRAP": lambda shrinkwrap: shrinkwrap.target is not None,
    "SOFT_BODY": lambda body: body.point_cache.is_baked,
    "SURFACE_DEFORM": lambda deform: deform.is_bound,
}
