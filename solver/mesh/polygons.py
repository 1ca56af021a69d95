# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangulate polygons, so that the solver can work on them; the caller keeps the faces.

Every corner is used, also those on a straight edge, which libraries for triangulation leave out:
a vertex that no triangle has would not move.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..aliases import FloatArray
from ..errors import CubicCraftError
from ..optional_packages import optional_package

MANY = 100
"""corners: up to so many the best ear is cut off each time, which takes their number squared"""
STRAIGHT = 1e-6
"""sine of the angle at a corner that is on a straight edge"""
BEND = 1e-4
"""how far the middle of a straight edge with corners on it is bent inward, of its length"""


def triangulate(V: FloatArray, faces: NDArray[Any]) -> NDArray[Any]:
    """Split polygons into triangles without new vertices.

    `V`: (n,3). `faces`: (k,s) int, polygons with s corners each, which may be concave. They need
    not be planar. Returns (k * (s - 2), 3) int array, in the order of the polygons, and with their
    orientation; none for s less than 3. Raises CubicCraftError: a concave one has more than `MANY`
    corners, and mapbox-earcut is not installed.
    """
    count, size = faces.shape
    if size <= 3:
        return faces[:, :3] if size == 3 else np.empty((0, 3), faces.dtype)
    if size == 4:
        faces = np.where(_is_concave_at_first(V, faces)[:, None], np.roll(faces, -1, 1), faces)
    inner = np.arange(1, size - 1)
    fans = np.stack([np.broadcast_to(faces[:, :1], (count, size - 2)), faces[:, inner]], axis=-1)
    fans = np.concatenate([fans, faces[:, inner + 1, None]], axis=-1)
    if size > 4:
        for polygon in np.flatnonzero(~_is_fan(V, fans)):
            corners = V[faces[polygon]]
            clipped = _clip_ears(corners) if size <= MANY else _clip_many_ears(corners)
            fans[polygon] = faces[polygon][clipped]
    return fans.reshape(-1, 3)


def _is_concave_at_first(V, quads):
    """Return which diagonals from corner 0 to 2 lie outside: the rule of Blender."""
    a, b, c, d = (V[quads[:, corner]] for corner in range(4))
    return (np.cross(b - a, c - a) * np.cross(d - a, c - a)).sum(axis=1) > 0.0


def _is_fan(V, fans):
    """Return for each polygon whether its triangles (k,s,3) around one corner face one way."""
    a, b, c = (V[fans[..., corner]] for corner in range(3))
    areas = np.cross(b - a, c - a)
    along = (areas * areas.sum(axis=1, keepdims=True)).sum(axis=-1)
    return (along > 0.0).all(axis=1)


def _clip_ears(points):
    """Return the triangles (s-2,3) of a polygon (s,3): its best ear is cut off until none is left.

    A polygon that intersects itself gets triangles as well, but not good ones.
    """
    flat = _in_plane(points)
    left, triangles = np.arange(len(flat)), []
    while len(left) > 3:
        before, after = np.roll(left, 1), np.roll(left, -1)
        a, b, c = flat[before], flat[left], flat[after]
        areas = _cross(b - a, c - a)
        lengths = ((b - a) ** 2 + (c - b) ** 2 + (a - c) ** 2).sum(axis=1)
        quality = areas / np.maximum(lengths, 1e-300)
        order = np.argsort(-quality, kind="stable")
        ears = (ear for ear in order if quality[ear] > 1e-12 and _is_empty(flat, left, ear))
        ear = next(ears, order[0])
        triangles.append((before[ear], left[ear], after[ear]))
        left = np.delete(left, ear)
    return np.array([*triangles, left])


def _clip_many_ears(points):
    """Return the triangles (s-2,3) of a polygon (s,3) with many corners, in near to linear time.

    One that is not simple, of which not all corners are used, gets a fan.
    """
    size = len(points)
    earcut = optional_package("mapbox_earcut")
    if earcut is None:
        raise CubicCraftError(
            f"a face has {size} corners; for more than {MANY}, install mapbox-earcut"
        )
    flat = _bent_inward(_in_plane(points))
    triangles = earcut.triangulate_float64(flat, np.array([size], np.uint32))
    triangles = triangles.reshape(-1, 3).astype(np.int64)
    if len(triangles) != size - 2:
        inner = np.arange(1, size - 1)
        return np.stack([np.zeros_like(inner), inner, inner + 1], axis=1)
    a, b, c = (flat[triangles[:, corner]] for corner in range(3))
    return triangles if _cross(b - a, c - a).sum() > 0.0 else triangles[:, ::-1]


def _bent_inward(flat):
    """Return a polygon (s,2), counter-clockwise, whose straight edges are parabolas.

    So no corner lies on a line between others, where it would be left out, and each is joined to
    one on the other side, not to its neighbors only.
    """
    before, after = flat - np.roll(flat, 1, axis=0), np.roll(flat, -1, axis=0) - flat
    lengths = np.linalg.norm(before, axis=1) * np.linalg.norm(after, axis=1)
    is_straight = np.abs(_cross(before, after)) <= STRAIGHT * lengths
    is_straight &= (before * after).sum(axis=1) >= 0.0
    (ends,) = np.nonzero(~is_straight)
    if len(ends) in (0, len(flat)):
        return flat
    edge = np.searchsorted(ends, np.arange(len(flat)), side="right") - 1  # -1 is the last
    first, last = ends[edge], ends[(edge + 1) % len(ends)]
    t = ((np.arange(len(flat)) - first) % len(flat)) / ((last - first - 1) % len(flat) + 1)
    across = (flat[last] - flat[first]) @ [[0.0, 1.0], [-1.0, 0.0]]
    return flat + (4.0 * BEND * t * (1.0 - t))[:, None] * across


def _in_plane(points):
    """Return the points (s,3) in the plane of Newell's normal, as (s,2), counter-clockwise."""
    centerd = points - points.mean(axis=0)
    normal = np.cross(centerd, np.roll(centerd, -1, axis=0)).sum(axis=0)
    length = np.linalg.norm(normal)
    normal = normal / length if length > 0.0 else np.array([0.0, 0.0, 1.0])
    x = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    x /= np.linalg.norm(x)
    return np.stack([centerd @ x, centerd @ np.cross(normal, x)], axis=1)


def _is_empty(flat, left, ear):
    """Return whether no other corner lies in the triangle of an ear, or on its edge."""
    a, b, c = flat[left[ear - 1]], flat[left[ear]], flat[left[(ear + 1) % len(left)]]
    others = flat[left]
    is_inside = np.ones(len(others), bool)
    for start, end in ((a, b), (b, c), (c, a)):
        is_inside &= _cross(end - start, others - start) >= 0.0
    for corner in (a, b, c):  # also where the polygon comes back to the same place
        is_inside &= (others != corner).any(axis=1)
    return not is_inside.any()


def _cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
