# SPDX-License-Identifier: GPL-3.0-or-later
"""The normals of a surface without its details, so that these ride along.

The cubic term turns the normals of the rest shape toward the form. Of a bump smaller than a given
size, it would turn each side on its own and so flatten it. If it sees the normals of the surface
below instead, the bump is carried along as it is, and what was spent on flattening it is free for
the whole. The smoothed normals solve

    (M + div(k grad)) n' = M n,    k_i = r_i^2 / 4

with the areas M and the radius r_i in which they are averaged: that of the details, but not more
than half of what the surface is thick there, or a limb would average its front and its back. The
length l_i of n'_i says how far the normals around a vertex agree; its cubeness counts
`WEIGHT` l_i^2 times, so that bumpy and tightly curved places are drawn less, and the rest more.

Nothing is averaged across sharp creases: the sides of a box keep the normals that they have.
"""

import numpy as np
import scipy.sparse as sp

WEIGHT = 1.75
"""of the cubeness where all normals agree"""
SMALL_PART = 2.0
"""times the size of the details: a smaller part that touches others is itself a detail"""
MANY = 60_000
"""vertices; of more, the normals of a coarser mesh are smoothed first"""

_TOLERANCE = 1e-2  # error of the normals, roughly
_MOST_ITERATIONS = 60
_AFTER_COARSER = 10  # iterations
_LEAST_AREA = 1e-12


def radii(size, thickness, part_sizes, is_alone):
    """Return how far the normals of each vertex are averaged, (n,).

    Parameters
    ----------
    size : (n,) array
        Of the details, in the unit box.
    thickness : (n,) array
        Of the surface, infinite where it has none.
    part_sizes : (n,) array
        Largest extent of the part of each vertex.
    is_alone : (n,) bool array
        Whether the part touches no other.
    """
    is_detail = ~is_alone & (part_sizes <= SMALL_PART * size)
    return np.where(is_detail, size, np.minimum(size, 0.5 * thickness))


def smoothed(skin, areas, normals, radius, coupling=None, coarser=None):
    """Return normals without their details, and how far they agree.

    Parameters
    ----------
    skin : SpokesAndRims
        With the cotangent Laplacian of the surface.
    areas : (n,) array
    normals : (n,3) array
    radius : (n,) array
        See `radii`.
    coupling : (n,) array, optional
        From 0 in sharp creases, across which nothing is averaged, to 1.
    coarser : (n,3) array, optional
        The solution on a coarser mesh, from which a few iterations lead to this one.

    Returns
    -------
    (n,3) array
        Unit normals, or zero.
    (n,) array
        l, between 0 and 1.
    """
    A = _operator(skin, areas, radius, coupling)
    b = (areas + _LEAST_AREA)[:, None] * normals
    near = (normals, _MOST_ITERATIONS) if coarser is None else (coarser, _AFTER_COARSER)
    found = solved(A, b, *near)
    length = np.sqrt((found * found).sum(axis=1))
    is_defined = (length > 1e-6) & normals.any(axis=1)
    unit = np.where(is_defined[:, None], found, 0.0) / np.where(is_defined, length, 1.0)[:, None]
    return unit, np.where(is_defined, np.minimum(length, 1.0), 0.0)


def _operator(skin, areas, radius, coupling):
    """Return M + div(k grad) as csr_matrix (n,n), with k at an edge the mean of its ends."""
    n, k = len(areas), 0.25 * radius * radius
    row = np.repeat(np.arange(n, dtype=np.int32), np.diff(skin.indptr))
    is_diagonal = row == skin.indices
    values = np.minimum(skin.laplacian, 0.0) * (0.5 * (k[row] + k[skin.indices]))
    if coupling is not None:
        values *= coupling[row] * coupling[skin.indices]
    values[is_diagonal] = 0.0
    values[is_diagonal] = areas + _LEAST_AREA - np.bincount(row, values, n)
    return sp.csr_matrix((values, skin.indices, skin.indptr), shape=(n, n))


def solved(A, b, near, most=_MOST_ITERATIONS):
    """Solve A x = b (n,3) from a solution near it, by conjugate gradients.

    To a hundredth of the distance, roughly, or as many iterations as there may be.
    """
    x = near.copy()
    scale = 1.0 / A.diagonal()[:, None]
    residual = b - A @ x
    z = scale * residual
    direction, rate = z.copy(), (residual * z).sum()
    goal = _TOLERANCE**2 * max(rate, 1e-300)
    for _ in range(most):
        if rate <= goal:
            break
        image = A @ direction
        step = rate / (direction * image).sum()
        x += step * direction
        residual -= step * image
        np.multiply(scale, residual, out=z)
        rate, before = (residual * z).sum(), rate
        direction *= rate / before
        direction += z
    return x
