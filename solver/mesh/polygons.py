# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangulate polygons, so that the solver can work on them; the caller keeps the faces.

Every corner is used, also those on a straight edge, which libraries for triangulation leave out:
a vertex that no triangle has would not move.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..aliases import FloatArray


def triangulate(V: FloatArray, faces: NDArray[Any]) -> NDArray[Any]:
    """Split polygons into triangles without new vertices.

    `V`: (n,3). `faces`: (k,s) int, polygons with s corners each, which may be concave. They need
    not be planar. Returns (k * (s - 2), 3) int array, in the order of the polygons, and with their
    orientation; none for s less than 3.
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
            fans[polygon] = faces[polygon][_clip_ears(V[faces[polygon]])]
    return fans.reshape(-1, 3)


def _is_concave_at_first(V, quads):
    """Return for each quad whether its diagonal from corner 0 to 2 lies outside of it.

    Blender splits quads by the same rule.
    """
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

    That takes the number of corners squared: of 5,000, three seconds. A polygon that intersects
    itself gets triangles as well, but not good ones.
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
