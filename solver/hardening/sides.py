# SPDX-License-Identifier: GPL-3.0-or-later
"""Which side of the form each triangle belongs to.

In the frame of its limb, a triangle f faces side k at the cost 1 - m_f.d_k, where m_f is its normal
without details in the soft shape. Alone, each would choose the nearest side, with frayed borders
where the shape lies between two. So each also follows its neighbors, in the mean field of a Potts
model with the temperature T and the weight w (Koller and Friedman, "Probabilistic Graphical
Models", 2009, 11.5),

    p_f ~ exp(-(1 - m_f.d - w sum_g a_fg p_g) / T)

where a_fg are the shares of the neighbors g in the border of f. Labels count in the frame of each
triangle, so that a side follows a limb where it bends. In the end, labels change one beside the
other for as long as that lowers the sum of all, or teeth would be left along a border: no vertex of
them can move onto its line without a triangle that vanishes.

A side whose triangles face its direction on average, or nearly so, faces exactly there. One that
leans, as on a horn or a chin, keeps its own direction from `LEANING` on.
"""

from functools import reduce

import numpy as np
import scipy.sparse as sp

from ..algebra import blocks, smoothstep, sums_by_group
from ..mesh.components import components
from ..styles.forms import cube
from ..surface.details import unit

TEMPERATURE = 0.15
WEIGHT = 1.35
ROUNDS = 12
"""few labels change after them, but for some that alternate: the last two count"""
MOST_CHANGES = 40
"""of labels one beside the other, after them"""
LEAST_GAIN = 1e-4
"""in units of the costs, of such a change"""
CURVED = np.cos(np.radians(20.0))
"""sides at a smaller angle than this are those of a round form, which stays as it is"""
NARROWEST = 0.05
"""of the size of a body; to a side that is narrower, next to nothing draws: walls of a pillar whose
weights are 0 keep their outline"""
LEANING = np.cos(np.radians(20.0)), np.cos(np.radians(10.0))
"""of the angles from which on a side keeps its direction, and up to which it is put straight"""
STEADY = 0.3
"""by how much the side that a triangle had in the frame before costs less"""
CLEAR = 0.08
"""the same for a shape that is only seen for a moment, while a setting is dragged"""
SAME = np.cos(np.radians(25.0))
"""of the greatest angle between a side and that which it follows, of another form"""

TIES = 1e-3 * np.array([1.0, 2.0, 3.0])
"""by axis: of sides that cost the same, mirror images take mirror images, whatever the rounding"""

COPLANAR = np.cos(np.radians(0.5))
"""between the normals of triangles in one plane"""
SHARP = np.cos(np.radians(10.0))
SQUARE, STILL_SQUARE = 1.0 - np.cos(np.radians([6.0, 20.0]))
"""what a plane, as a ledge, costs at most at rest, and softly, to be a side of its own,..."""
FIRM = 0.45
"""...that follows its neighbors so much less: what they all are would else cost less"""
LARGE = 0.002
"""of the area of all: what lies in a plane stands out of a curve if it is larger, or if half of the
edges around turn by more than the angle of `SHARP`"""

NO_SIDE = -1
_LEAST_AREA = 1e-30
NEVER = 9.0
"""more than any direction costs"""


def sides_of(
    graph, normals, frames, forms, form_of, *, is_free, whole=None, before=None, steady=STEADY
):
    """Return the side of each triangle, and which way it faces.

    Parameters
    ----------
    graph : FaceGraph
    normals : (m,3) array
        Of the soft shape, without details.
    frames : (m,3,3) array
        Rotations into the frame of the form.
    forms : sequence of Polytope
        Empty for the cube.
    form_of : (m,) int array
    is_free : (m,) bool array
        Triangles that belong to no side.
    whole : (m,) int array, optional
        The face of the artist's mesh that each one is a piece of. Pieces have one side, so that no
        face is folded across the border of two.
    before : (m,3) array, optional
        What the triangles faced in the frame of an animation before, as `facing`: another form has
        other sides, of which the nearest follows.
    steady : float
        By how much that costs less.

    Returns
    -------
    side : (m,) int array
        Number of a direction of the form, or `NO_SIDE`.
    facing : (m,3) array
        The direction of that side in the frame of the form; 0 for `NO_SIDE`.
    directions : (m,3) array
        Unit normals that the triangles of a side face.
    """
    parted = [_flat_and_round(form) for form in forms or [cube()]]
    local = np.einsum("mij,mj->mi", frames, normals)
    costs = _costs(local, parted, form_of)
    if before is not None:
        _keep_near(costs, before, parted, form_of, steady)
    is_followed = (form_of[graph.one] == form_of[graph.other]) & ~is_free[graph.one]
    is_followed &= ~is_free[graph.other]
    group = _groups(graph, whole, form_of)
    at_rest = _costs(np.einsum("mij,mj->mi", frames, graph.normals), parted, form_of)
    is_square = (at_rest.min(axis=1) < SQUARE) & (costs.min(axis=1) < STILL_SQUARE)
    side = _of_groups(graph, costs, is_followed, group, is_square)
    side[is_free | (side == costs.shape[1] - 1)] = NO_SIDE
    facing = np.zeros_like(local)
    for number, (flat, _) in enumerate(parted):
        rows = (form_of == number) & (side >= 0)
        facing[rows] = flat[side[rows]]
    leaning = _leaning(graph, local, side, facing, form_of)
    return side, facing, np.einsum("mji,mj->mi", frames, leaning)


def _keep_near(costs, before, forms, form_of, steady):
    """Let the side cost less that is next to what a triangle faced before (m,3)."""
    for number, (flat, _) in enumerate(forms):
        if not len(flat):
            continue
        rows = np.flatnonzero((form_of == number) & before.any(axis=1))
        cosines = before[rows] @ flat.T
        nearest = cosines.argmax(axis=1)
        is_near = cosines.max(axis=1) > SAME
        costs[rows[is_near], nearest[is_near]] -= steady


def _groups(graph, whole, form_of):
    """Return the group (m,) of each triangle, of one side: what is flat is not bent.

    Connected triangles that lie in one plane are a group, or the pieces of a face.
    """
    one, other = graph.normals[graph.one], graph.normals[graph.other]
    cosines = np.einsum("kj,kj->k", one, other)
    count, flat = graph.regions(cosines > COPLANAR)
    # in a dense mesh, a round side is a chain of triangles that are nearly in one plane
    stands_out = _stand_out(graph, cosines < SHARP, flat, count)
    is_plane = (_are_planes(graph, flat, count) & stands_out)[flat]
    faces = np.arange(len(form_of)) if whole is None else whole
    group = np.where(is_plane, flat, count + faces)
    cut = np.flatnonzero(_are_cut(group, faces))
    if len(cut):  # by the border of a plane
        nodes = int(group.max()) + 1
        pairs = np.stack([group[cut], nodes + faces[cut]], axis=1)
        total = nodes + int(faces.max()) + 1
        group = components(pairs, total)[1][group]
    return np.unique(group * (form_of.max() + 1) + form_of, return_inverse=True)[1].ravel()


def _are_cut(group, faces):
    """Return which triangles (m,) are pieces of faces of which others are in another group."""
    least, most = np.full(faces.max() + 1, group.max()), np.zeros(faces.max() + 1, np.intp)
    np.minimum.at(least, faces, group)
    np.maximum.at(most, faces, group)
    return (least != most)[faces]


def _stand_out(graph, is_sharp, part, count):
    """Return which parts (count,) are large, or have sharp edges around: no facet of a curve."""
    one, other = part[graph.one], part[graph.other]
    signed = graph.length * np.where(is_sharp, 1.0, -1.0) * (one != other)
    around = np.bincount(one, signed, count) + np.bincount(other, signed, count)
    areas = np.bincount(part, graph.areas, count)
    return (around >= 0.0) | (areas > LARGE * graph.areas.sum())


def _are_planes(graph, part, count):
    """Return which parts (count,) of the triangles (m,) lie in one plane each."""
    weighted = graph.areas[:, None] * graph.normals
    mean = unit(sums_by_group(weighted, part, count))
    worst = np.ones(count)
    np.minimum.at(worst, part, np.einsum("mj,mj->m", graph.normals, mean[part]))
    return worst > COPLANAR


def _of_groups(graph, costs, is_followed, group, is_square):
    """Return the likeliest label (m,) of each triangle, the same for all of a group.

    `is_square`: (m,) bool. What is so all over is a side of its own.
    """
    count = group.max() + 1
    weights = graph.areas + _LEAST_AREA
    gather = sp.csr_matrix((weights, (group, np.arange(len(group)))), shape=(count, len(group)))
    area = np.asarray(gather.sum(axis=1))
    one, other = group[graph.one], group[graph.other]
    shares = _shares(one, other, graph.length * (is_followed & (one != other)), count)
    costs = np.float32((gather @ costs) / area)
    is_own = np.bincount(group, ~is_square, count) == 0.0
    shares = sp.csr_matrix(sp.diags(np.where(is_own, np.float32(FIRM), np.float32(1.0))) @ shares)
    return settled_labels(costs, shares)[group]


def _flat_and_round(form):
    """Return the directions (k,3) of a form's sides, and those of its round part."""
    cosines = form.normals @ form.normals.T
    np.fill_diagonal(cosines, -1.0)
    is_flat = (cosines.max(axis=1) < CURVED) & (_widths(form) > NARROWEST * form.radius)
    return form.normals[is_flat], form.normals[~is_flat]


def _widths(form):
    """Return the width (k,) of each side of a body: how much its normal is drawn to it."""
    found = []
    for is_on in form.incidence.T:
        corners = form.vertices[is_on] - form.vertices[is_on].mean(axis=0)
        axes = np.linalg.svd(corners, full_matrices=False)[2]
        found.append(np.ptp(corners @ axes[1]))
    return np.array(found)


def _costs(local, forms, form_of):
    """Return what it costs (m,k+1) to face each side; the last column is that of a round part."""
    width = max(len(flat) for flat, _ in forms)
    costs = np.full((len(local), width + 1), NEVER, np.float32)
    for number, (flat, curved) in enumerate(forms):
        rows = np.flatnonzero(form_of == number)
        costs[rows, : len(flat)] = 1.0 - local[rows] @ flat.T + np.abs(flat) @ TIES
        if len(curved):
            costs[rows, -1] = 1.0 - (local[rows] @ curved.T).max(axis=1)
    return costs


def border_shares(graph, is_followed):
    """Return the shares (m,m) of the neighbors that a triangle follows, by pairs (k,) that do."""
    return _shares(graph.one, graph.other, graph.length * is_followed, len(graph.areas))


def _shares(one, other, length, count):
    ends = np.concatenate([one, other]), np.concatenate([other, one])
    lengths = sp.csr_matrix((np.tile(length, 2), ends), shape=(count, count))
    total = np.bincount(ends[0], np.tile(length, 2), count)
    shares = sp.diags(1.0 / np.where(total > 0.0, total, 1.0)) @ lengths
    return sp.csr_matrix(shares, dtype=np.float32)


def settled_labels(costs, shares):
    """Return the likeliest label (m,) of each triangle, without teeth along the borders.

    `costs`: (m,k) float32. `shares`: of `border_shares`.
    """
    p, before = _likely(-costs), 0.0
    for _ in range(ROUNDS):
        gains = shares @ p
        gains *= WEIGHT
        gains -= costs
        p, before = _likely(gains), p
    return _without_teeth((p + before).argmax(axis=1), costs, shares)


def _without_teeth(label, costs, shares):
    """Return labels (m,) changed until no change of a single one lowers the cost of all.

    Neighbors never change at once: two rows of teeth would change places again and again.
    """
    label, rows = label.copy(), np.arange(len(label))
    gain = np.zeros(len(label), np.float32)
    for _ in range(MOST_CHANGES):
        near = shares[rows]
        start = np.repeat(np.arange(len(rows)), np.diff(near.indptr))
        is_border = (label[rows][start] != label[near.indices]) & (near.data > 0.0)
        rows = rows[np.unique(start[is_border])]
        near, at = shares[rows], np.arange(len(rows))
        of_label = np.eye(costs.shape[1], dtype=np.float32)[label[near.indices]]
        ends = sp.csr_matrix((near.data, np.arange(near.nnz), near.indptr), (len(rows), near.nnz))
        total = costs[rows] - WEIGHT * (ends @ of_label)
        best = total.argmin(axis=1)
        gain[rows] = total[at, label[rows]] - total[at, best]
        near.data = np.where(near.data > 0.0, gain[near.indices], 0.0)
        is_most = gain[rows] > np.maximum(near.max(axis=1).toarray().ravel(), LEAST_GAIN)
        if not is_most.any():
            break
        changed, gain[rows] = rows[is_most], 0.0
        label[changed] = best[is_most]
        rows = np.unique(np.concatenate([rows, shares[changed].indices]))  # others have no border
    return label


def _likely(gains):
    """Return probabilities (m,k) by gains, in place of these."""
    for part in blocks(len(gains)):
        some = gains[part]
        some -= reduce(np.maximum, some.T)[:, None]  # a third of the time of `max`
        some /= TEMPERATURE
        np.exp(some, out=some)
        some /= some.sum(axis=1, keepdims=True)
    return gains


def _leaning(graph, local, side, faced, form_of):
    """Return what the triangles of a side face (m,3): less straight the more it leans."""
    one, other = graph.one, graph.other
    is_same = (side[one] == side[other]) & (form_of[one] == form_of[other]) & (side[one] >= 0)
    count, region = graph.regions(is_same)
    weighted = graph.areas[:, None] * local
    mean = unit(sums_by_group(weighted, region, count))[region]
    return np.where(side[:, None] >= 0, straightened(mean, faced), 0.0)


def straightened(mean, faced):
    """Return unit normals between means (m,3) and what they face (m,3), which is kept if near."""
    t = smoothstep(np.einsum("mj,mj->m", mean, faced), *LEANING[::-1])[:, None]
    return np.where(t > 0.0, unit(t * mean + (1.0 - t) * faced), faced)
