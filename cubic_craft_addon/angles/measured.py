# SPDX-License-Identifier: GPL-3.0-or-later
"""The angles that remain between the surface of an object, as it is seen, and its form."""

from __future__ import annotations  # the solver is loaded when it is needed, not for its names

from dataclasses import dataclass
from functools import cached_property

import bpy
import numpy as np

from ... import solver
from ...solver.pieces.placement import Placement
from .. import mesh_bridge
from ..measure.facets import directions_at
from ..regions.region import region_shares
from ..settings.values import Settings

ALIGNED = 6.0
"""degrees; what is not farther from a side of the form seems to lie in it"""
_AT_ONCE = 1 << 16  # triangles; all at once would take memory for each side of the form


@dataclass(frozen=True)
class Angles:
    """Triangles with their angles, without those that have no area or are not finite."""

    corners: np.ndarray
    """(m,3,3) float32 corners of each triangle, object space"""
    degrees: np.ndarray
    """(m,) between the normal of each triangle and the nearest direction of the form"""
    areas: np.ndarray
    """(m,) as they are seen: with the object's scale"""

    @cached_property
    def aligned(self) -> float:
        """The share of the area with at most `ALIGNED` degrees; 0 if there is no area."""
        total = self.areas.sum()
        return float(self.areas[self.degrees <= ALIGNED].sum() / total) if total else 0.0


def remaining_angles(obj: bpy.types.Object, placement: Placement, settings: Settings) -> Angles:
    """Measure the angles on the surface of an object with its modifiers.

    `placement`: of the object solved alone; its coordinates have the angles that are seen.
    `settings`: those of the object, for its regions. Raises CubicCraftError: the object has no
    surface.
    """
    points, triangles = mesh_bridge.read_evaluated(obj)
    with np.errstate(invalid="ignore", over="ignore"):
        areas, normals = solver.triangle_areas_and_normals(placement.place(points), triangles)
    is_seen = np.isfinite(areas) & (areas > 0.0)
    if not is_seen.all():
        triangles, areas, normals = triangles[is_seen], areas[is_seen], normals[is_seen]
    shares = _shares(obj, settings, len(points))
    cosines = _cosines(normals, *directions_at(placement, triangles, shares))
    degrees = np.degrees(np.arccos(np.clip(cosines, -1.0, 1.0)))
    return Angles(points[triangles], degrees, areas)


def _shares(obj, settings, count):
    """Return the shares (count,1+r) of the regions, None without any.

    Where a modifier has made vertices, the sides of all regions count everywhere.
    """
    shares = region_shares(obj, settings.regions)
    if shares is None or len(shares) == count:
        return shares
    return np.ones((count, shares.shape[1]))


def _cosines(normals: np.ndarray, directions: np.ndarray, counts: np.ndarray | None):
    """Return the cosine (m,) of the angle from each normal to the nearest direction that counts."""
    nearest = np.empty(len(normals))
    for start in range(0, len(normals), _AT_ONCE):
        part = slice(start, start + _AT_ONCE)
        cosines = directions @ normals[part].T
        if counts is not None:
            cosines[~counts[part].T] = -1.0
        nearest[part] = cosines.max(axis=0)
    return nearest
