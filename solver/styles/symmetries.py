# SPDX-License-Identifier: GPL-3.0-or-later
"""The rotations and reflections that map a form to itself, which therefore change nothing.

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


def symmetries(body: Polytope):
    """Return the rotations that map a body to itself.

    Parameters
    ----------
    body : Polytope

    Returns
    -------
    (k,3,3) numpy array
        A group, the identity first. The array is shared and cannot be written to.

    See Also
    --------
    mirror_symmetry : Returns a map that is not a rotation.
    nearest_to_identity : Chooses among equivalent rotations.

    Examples
    --------
    >>> from solver.styles.forms import dodecahedron, prism
    >>> from solver.styles.symmetries import symmetries
    >>> len(symmetries(dodecahedron())), len(symmetries(prism(5)))
    (60, 10)
    """
    return _rotations(*_key(body))


def mirror_symmetry(body: Polytope):
    """Return a map of a body to itself that turns left into right.

    Parameters
    ----------
    body : Polytope

    Returns
    -------
    (3,3) numpy array or None
        An orthogonal matrix with determinant -1, a reflection at a plane if there is one. None if
        the body is chiral, so that its mirror image is another body. The array is shared and cannot
        be written to.

    See Also
    --------
    symmetries : Returns the rotations.

    Examples
    --------
    >>> import numpy as np
    >>> from solver.styles.forms import pyramid
    >>> from solver.styles.symmetries import mirror_symmetry
    >>> mirror = mirror_symmetry(pyramid(3))
    >>> bool(np.allclose(mirror @ mirror, np.eye(3))), round(np.linalg.det(mirror))
    (True, -1)
    """
    return _mirror(*_key(body))


def nearest_to_identity(Q, body: Polytope):
    """Return the rotation nearest to the identity that is equivalent to Q for a body.

    Parameters
    ----------
    Q : (3,3) numpy array
        Rotation into the frame of the body.
    body : Polytope

    Returns
    -------
    (3,3) numpy array
        S Q for one of the body's symmetries S.

    See Also
    --------
    cube.nearest_to_identity : Does so for the cube.
    symmetries : Returns the rotations S.

    Examples
    --------
    >>> import numpy as np
    >>> from solver.styles.forms import octahedron
    >>> from solver.styles.symmetries import nearest_to_identity
    >>> quarter_turn = np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 1]])
    >>> bool(np.allclose(nearest_to_identity(quarter_turn, octahedron()), np.eye(3)))
    True
    """
    same = symmetries(body) @ Q
    return same[np.argmax(np.trace(same, axis1=1, axis2=2))]


def _key(body):
    """Return normals and offsets as bytes, so that equal bodies share what is remembered."""
    normals, offsets = (np.asarray(a, np.float64) for a in (body.normals, body.offsets))
    return normals.tobytes(), offsets.tobytes()


@lru_cache(maxsize=KEPT)
def _rotations(normals, offsets):
    found = _maps(normals, offsets, 1.0)
    traces = np.trace(found, axis1=1, axis2=2)
    others = np.delete(found, traces.argmax(), axis=0)
    found = np.concatenate([np.eye(3)[None], others])
    found.setflags(write=False)
    return found


@lru_cache(maxsize=KEPT)
def _mirror(normals, offsets):
    found = _maps(normals, offsets, -1.0)
    if not len(found):
        return None
    # A reflection at a plane has the largest trace, 1; among equals, rounding must not choose.
    mirror = found[np.trace(found, axis1=1, axis2=2).round(6).argmax()].copy()
    mirror.setflags(write=False)
    return mirror


def _maps(normals, offsets, determinant):
    """Return the orthogonal matrices (k,3,3) with this determinant that map a body to itself.

    They are in the order of the images of the two chosen facets.
    """
    n = np.frombuffer(normals).reshape(-1, 3)
    offsets = np.frombuffer(offsets)
    r = offsets / offsets.max()
    cosines = n @ n.T
    alike = _alike(r, cosines)
    i, j = _two_facets(cosines, alike.sum(axis=1))
    is_image = np.abs(cosines - cosines[i, j]) < 2.0 * MATCHING
    a, b = np.nonzero(is_image & alike[i][:, None] & alike[j])
    maps = _frames(n, a, b, determinant) @ _frames(n, [i], [j], 1.0).swapaxes(1, 2)
    parts = np.array_split(maps, len(maps) * len(n) ** 2 // PART + 1)
    return np.concatenate([_verified(part, n, r, determinant) for part in parts])


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


def _frames(n, a, b, determinant):
    """Return frames (k,3,3), their axes in columns, of the pairs of facets a and b (k,)."""
    x = n[a]
    z = np.cross(x, n[b])
    z /= np.linalg.norm(z, axis=1, keepdims=True)
    return np.stack([x, np.cross(z, x), determinant * z], axis=2)


def _verified(maps, n, r, determinant):
    """Return those of the maps (k,3,3) that take each facet to one, fitted to all facets."""
    turned = n @ maps.swapaxes(1, 2)
    image = (turned @ n.T).argmax(axis=2)
    # The frames of two facets pass on their rounding, more so if these are almost parallel.
    is_near = np.abs(turned - n[image]).max(axis=(1, 2)) < 10.0 * MATCHING
    is_as_far = np.abs(r[image] - r).max(axis=1) < MATCHING
    is_all = (np.sort(image, axis=1) == np.arange(len(n))).all(axis=1)
    image = image[is_near & is_as_far & is_all]
    u, _, vt = np.linalg.svd(n[image].swapaxes(1, 2) @ n)
    u[:, :, 2] *= (determinant * np.linalg.det(u @ vt))[:, None]
    return u @ vt
