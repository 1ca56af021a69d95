# SPDX-License-Identifier: GPL-3.0-or-later
"""Start a large mesh from the cubic version of a coarser one.

The iteration moves details at once and the whole only slowly, the more slowly the finer the mesh
is. On a mesh of an eighth of the vertices an iteration costs an eighth, and fewer are needed; its
rotations bring the fine mesh so near to its end that it takes about half of the iterations from the
rest shape (figures: `docs/benchmarks_explained.md`). The coarse mesh is started in the same way.

The problem has many minima, and this start may lead to another one than the start from rest. No
part may turn as a whole on a coarse mesh: there it would soon find the orientation in which the
energy is least, up to half a right angle away from how the artist has oriented shape and cube. Thin
tubes may become flatter. So only meshes that would take too long from rest are started like this.
"""

import numpy as np
import scipy.sparse as sp

from ..algebra import columns, cross, dot
from ..rotation_fit import orthonormalize

LEAST_VERTICES = 60_000
"""Meshes of smaller components are started from rest, which leads to the minimum next to it."""
COARSEST_VERTICES = 10_000
"""So are coarser meshes below this."""
TOLERANCE = 1e-2
"""of the stop rule on coarse meshes: a more exact start saves less than it costs"""
MAX_ITERATIONS = 40
"""More of them come no nearer to the end of the fine mesh: the minima of both differ by more."""

_ORTHONORMALIZATIONS = 4
_LEAST_DETERMINANT = 0.9  # less was no average of similar rotations


def coarse_stylization(fine):
    """Return the Stylization of a coarser mesh whose end `prolongate` takes to it, or None.

    None for small meshes, for the plain iteration, for one that has been started from elsewhere
    than rest, and where there is no coarser mesh.
    """
    if fine.is_started or not fine.options.is_accelerated:
        return None
    count = fine.rest.topology.largest_component  # many small parts are no slower than one of them
    least = COARSEST_VERTICES if fine.is_coarse else LEAST_VERTICES
    if count < least or fine.setup.coarse is None:
        return None
    return fine.coarser()


def prolongate(coarse, fine):
    """Start a new Stylization from the current state of a coarser one."""
    positions, R = coarse.placed()
    fine.start_from(*_prolongate(fine.rest, positions, _smoothed(fine.rest, R)))


def preview_on_fine(positions, R, rest):
    """Return approximate rotations and positions of a finer mesh, from placed (k,3) and (k,3,3)."""
    return _prolongate(rest, positions, R[rest.coarse.cluster])


def _prolongate(rest, positions, R):
    """Return R (n,3,3), and the vertices rotated about those that they were merged into."""
    cluster = rest.coarse.cluster
    offset = rest.V - rest.coarse.rest.input_positions[cluster]
    return R, positions[cluster] + np.einsum("nij,nj->ni", R, offset)


def _smoothed(rest, R):
    """Return rotations (n,3,3): those of the coarser mesh (k,3,3), averaged over neighbors twice.

    Clusters would leave a step at each of their borders.
    """
    cluster, counts = rest.coarse.cluster, np.diff(rest.matrices.indptr)
    neighbors = rest.matrices.matrix(np.repeat(1.0 / counts, counts))
    of_clusters = (neighbors.data, cluster[neighbors.indices], neighbors.indptr)
    average = neighbors @ (sp.csr_matrix(of_clusters, shape=(len(counts), len(R))) @ columns(R).T)
    average = orthonormalize(average.reshape(-1, 3, 3), _ORTHONORMALIZATIONS)
    entries = columns(average)
    determinant = dot(*entries[:3], *cross(*entries[3:6], *entries[6:]))
    others = np.flatnonzero(determinant <= _LEAST_DETERMINANT)
    average[others] = R[cluster[others]]
    return average
