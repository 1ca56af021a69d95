# SPDX-License-Identifier: GPL-3.0-or-later
"""The rotations that map a form to itself, which therefore change nothing.

Such a map takes each facet to one that is equally far from the origin and sees the others under
the same angles. It is known from the images of two facets: all pairs are tried that may be images
of two chosen ones.
"""

from functools import lru_cache

import numpy as np

from .polytope import Polytope

MATCHING = 1e-5
"""largest difference of normals, and of offsets relative to the largest; more than the rounding of
single precision"""
KEPT = 64
"""bodies whose symmetries are remembered"""
PART = 2_000_000
"""cosines that are computed at a time"""


@lru_cache(maxsize=KEPT)
def symmetries(body: Polytope):
    """Return the rotations (k,3,3) that map a body to itself, the first is 1; read-only."""
    found = _maps(body.normals, body.offsets / body.offsets.max())
    traces = np.trace(found, axis1=1, axis2=2)
    others = np.delete(found, traces.argmax(), axis=0)
    found = np.concatenate([np.eye(3)[None], others])
    found.setflags(write=False)
    return found


def nearest_to_identity(Q, body: Polytope):
    """Return S Q (3,3) nearest to the identity, for a rotation Q and the symmetries S of a body."""
    same = symmetries(body) @ Q
    return same[np.argmax(np.trace(same, axis1=1, axis2=2))]


def _maps(n, r):
    cosines = n @ n.T
    alike = _alike(r, cosines)
    i, j = _two_facets(cosines, alike.sum(axis=1))
    is_image = np.abs(cosines - cosines[i, j]) < 2.0 * MATCHING
    a, b = np.nonzero(is_image & alike[i][:, None] & alike[j])
    maps = _frames(n, a, b) @ _frames(n, [i], [j]).swapaxes(1, 2)
    parts = np.array_split(maps, len(maps) * len(n) ** 2 // PART + 1)
    return np.concatenate([_verified(part, n, r) for part in parts])


def _alike(r, cosines):
    """Return which facets (f,f) may be images: equally far, with the same angles to others."""
    seen = np.sort(cosines, axis=1)
    return np.array(
        [
            (np.abs(r - r[k]) < MATCHING) & (np.abs(seen - seen[k]).max(axis=1) < 2.0 * MATCHING)
            for k in range(len(r))
        ]
    )


def _two_facets(cosines, counts):
    """Return two facets that are not parallel and like which there are few others."""
    i = int(counts.argmin())
    sines = 1.0 - cosines[i] ** 2
    return i, int(np.where(sines >= 0.5 * sines.max(), counts, len(counts) + 1).argmin())


def _frames(n, a, b):
    """Return frames (k,3,3), their axes in columns, of the pairs of facets a and b (k,)."""
    x = n[a]
    z = np.cross(x, n[b])
    z /= np.linalg.norm(z, axis=1, keepdims=True)
    return np.stack([x, np.cross(z, x), z], axis=2)


def _verified(maps, n, r):
    """Return those of the maps (k,3,3) that take each facet to one, fitted to all facets."""
    turned = n @ maps.swapaxes(1, 2)
    image = (turned @ n.T).argmax(axis=2)
    # The frames of two facets pass on their rounding, more so if these are almost parallel.
    is_near = np.abs(turned - n[image]).max(axis=(1, 2)) < 10.0 * MATCHING
    is_as_far = np.abs(r[image] - r).max(axis=1) < MATCHING
    is_all = (np.sort(image, axis=1) == np.arange(len(n))).all(axis=1)
    image = image[is_near & is_as_far & is_all]
    u, _, vt = np.linalg.svd(n[image].swapaxes(1, 2) @ n)
    u[:, :, 2] *= np.linalg.det(u @ vt)[:, None]
    return u @ vt
