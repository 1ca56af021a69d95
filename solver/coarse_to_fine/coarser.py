# SPDX-License-Identifier: GPL-3.0-or-later
"""The style and the pose of a mesh on the coarser one, whose vertices are means of clusters."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..aliases import FloatArray
from ..iteration.pose import Pose
from ..iteration.setup import Setup
from ..styles.solved_style import SolvedStyle, solved_style
from ..styles.style import Style
from ..surface.details import unit


def coarser_style(style: SolvedStyle, setup: Setup) -> SolvedStyle:
    """Return a style of the n vertices of a setup for those of its coarser one.

    Nothing may turn as a whole there, see `start.py`. Limbs have been followed already.
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
