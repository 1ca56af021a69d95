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

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from ..algebra import columns, cross, dot
from ..aliases import FloatArray
from ..iteration.pose import Pose
from ..iteration.setup import Setup
from ..rotation_fit import orthonormalize
from ..styles.solved_style import SolvedStyle, solved_style
from ..styles.style import Style
from ..surface.details import unit

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


def coarser_style(style: SolvedStyle, setup: Setup) -> SolvedStyle:
    """Return a style of the n vertices of a setup for those of its coarser one.

    Nothing may turn as a whole there. Limbs have been followed already.
    """
    rest, coarse = setup.rest, setup.coarse
    assert rest.coarse is not None and coarse is not None
    cluster = rest.coarse.cluster
    areas = rest.areas + 1e-300
    is_pinned = _is_pinned(setup)
    free = areas * (1.0 - is_pinned) + 1e-300
    _, first = np.unique(cluster, return_index=True)
    normals = None  # those of the coarser mesh
    if rest.options.detail:
        normals = unit(_means(cluster, style.normals, areas))
    of_clusters = Style(
        _means(cluster, style.lam, free),
        style.Q[first] if len(style.Q) > 1 else style.Q[0],
        style.forms or None,
        form_of=style.form_of[first] if style.forms else None,
    )
    found = solved_style(of_clusters, coarse, keep_rotation=True, normals=normals)
    return replace(found, cubeness=_means(cluster, style.cubeness, free))


def coarser_pose(setup: Setup, U: FloatArray, hold_matrices: Sequence[FloatArray]) -> Pose:
    """Return the pose of the coarser setup, whose units are those of the unit box.

    `setup`: of the finer mesh. `U`: (n,3), positions in the unit box, where pins have reached their
    targets. `hold_matrices`: sequence of (4,4), as of the `Pose` of the finer mesh.
    """
    rest, coarse = setup.rest, setup.coarse
    assert rest.coarse is not None and coarse is not None
    moved = _means(rest.coarse.cluster, U - rest.V, _is_pinned(setup))
    targets = rest.coarse.rest.input_positions + moved
    if coarse.hold_fields is None:
        return Pose(targets=targets)
    into = np.diag([rest.box.size, rest.box.size, rest.box.size, 1.0])
    into[:3, 3] = rest.box.origin
    back = np.linalg.inv(into)
    return Pose(
        targets=targets,
        hold_matrices=[back @ np.asarray(matrix) @ into for matrix in hold_matrices],
    )


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


def _is_pinned(setup):
    is_pinned = np.zeros(len(setup.rest.V))
    is_pinned[setup.pinned] = 1.0
    return is_pinned


def _means(cluster, values, weights):
    """Return the weighted means of values (n,...) in each cluster (k,...), 0 without weights."""
    total = np.bincount(cluster, weights)
    sums = [np.bincount(cluster, weights * column) for column in values.reshape(len(values), -1).T]
    means = np.stack([one / np.where(total > 0.0, total, 1.0) for one in sums], axis=1)
    return means.reshape(-1, *values.shape[1:])
